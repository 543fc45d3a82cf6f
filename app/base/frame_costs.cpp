#include "app/base/frame_costs.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/base/settings.h"
#include "tyglab_version.h"

namespace tyglab {
namespace {

constexpr double smoothing = 0.05;     // of a mean over about the last twenty frames
constexpr double least_recent = 1e-4;  // ms; a part that fell below it has stopped

}  // namespace

void FrameCosts::started(StartPart part) {
  started_s_[std::size_t(part)] = program_age_s();
}

void FrameCosts::add_copied(VertexPath path, std::size_t bytes, const std::string& why, std::size_t read) {
  vertex_path_ = path, why_copied_ = why;
  copied_now_ = copied_now_.value_or(0) + bytes;
  read_now_ += read;
}

void FrameCosts::end_frame() {
  ++frames_;
  for (std::size_t k = 0; k < part_names.size(); ++k) {
    const double ms = 1e3 * now_[k].wall_s;
    recent_ms_[k] = frames_ == 1 ? ms : recent_ms_[k] + smoothing * (ms - recent_ms_[k]);
    if (recent_ms_[k] < least_recent) recent_ms_[k] = 0;
    counts_[k] += now_[k].wall_s > 0;
    sum_[k].wall_s += now_[k].wall_s, sum_[k].cpu_s += now_[k].cpu_s;
  }
  now_ = {};
  if (copied_now_) {
    last_copied_ = *copied_now_, copied_ += *copied_now_, read_ += read_now_, ++moved_;
    recent_read_ += smoothing * (double(read_now_) - recent_read_);
  }
  copied_now_.reset(), read_now_ = 0;
}

std::string FrameCosts::json(int width, int height, const std::string& engine, const std::string& preset) const {
  nlohmann::ordered_json report;
  report["version"] = TYGLAB_VERSION;
  report["preset"] = preset;
  report["engine"] = engine;
  report["width"] = width;
  report["height"] = height;
  report["frames"] = frames_;
  report["steps"] = steps_;
  const double per_frame = frames_ > 0 ? 1e3 / double(frames_) : 0;
  nlohmann::ordered_json means, cpu, counts;
  for (std::size_t k = 0; k < part_names.size(); ++k) {
    const std::string name(part_names[k]);
    means[name] = per_frame * sum_[k].wall_s;
    cpu[name] = per_frame * sum_[k].cpu_s;
    counts[name] = counts_[k];
  }
  report["mean_ms_per_frame"] = means;
  report["mean_cpu_ms_per_frame"] = cpu;
  const auto of = [&](Part part) { return per_frame * sum_[std::size_t(part)].cpu_s; };
  // The shadow is drawn in draw_cloth, which counts it too.
  report["own_cpu_ms_per_frame"] =
      of(Part::frame) - of(Part::simulate) - of(Part::draw_cloth) - of(Part::ui_draw) - of(Part::swap);
  report["times_run"] = counts;
  const double per_moved = moved_ > 0 ? 1 / double(moved_) : 0;
  report["positions_come_by"] = std::string(name_of(vertex_path_));
  if (!why_copied_.empty()) report["copied_because"] = why_copied_;
  report["copied_bytes_per_frame"] = per_moved * double(copied_);
  report["read_bytes_per_frame"] = per_moved * double(read_);
  nlohmann::ordered_json start;
  double before = 0;
  for (std::size_t k = 0; k < start_names.size(); ++k) {
    if (started_s_[k] == 0) continue;  // a run without a window has no such part
    start[std::string(start_names[k])] = 1e3 * (started_s_[k] - before);
    before = started_s_[k];
  }
  start["in_all"] = 1e3 * before;
  report["start_ms"] = start;
  return report.dump(2, ' ', false, decltype(report)::error_handler_t::replace) + "\n";  // names as they are on disk
}

}  // namespace tyglab
