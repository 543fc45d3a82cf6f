#include "app/sandbox/frame_costs.h"

#include <nlohmann/json.hpp>

namespace tyglab {

std::string FrameCosts::json(int width, int height, const std::string& engine, const std::string& preset) const {
  nlohmann::ordered_json report;
  report["version"] = TYGLAB_VERSION;
  report["preset"] = preset;
  report["engine"] = engine;
  report["width"] = width;
  report["height"] = height;
  report["frames"] = counts_[std::size_t(Part::frame)];
  report["steps"] = steps_;
  nlohmann::ordered_json means, counts;
  for (std::size_t k = 0; k < part_names.size(); ++k) {
    means[std::string(part_names[k])] = mean_ms(Part(k));
    counts[std::string(part_names[k])] = counts_[k];
  }
  report["mean_ms_per_frame"] = means;
  report["times_run"] = counts;
  return report.dump(2) + "\n";
}

}  // namespace tyglab
