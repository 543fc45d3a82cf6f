#include "tests/fuzz/run_outputs.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/cloth/state.h"
#include "core/engines/motion_limit.h"
#include "core/forces/force.h"
#include "tests/fuzz/csv_reader.h"

namespace tyglab::fuzz {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::json;
using Problem = std::optional<Finding>;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// Sentences: each line begins with the program's name, ends as a sentence does, and is about no fault of the program.
Problem sentences_finding(const fs::path& folder) {
  for (const std::string& line : lines_of(file_text(folder / "stderr.txt"))) {
    const bool ends = !line.empty() && (line.back() == '.' || line.back() == ':');
    if (!line.starts_with("tyglab: ") || !ends) return Finding{"sentence", "stderr has: " + line};
    for (const char* word : {"Internal error", " nan", "-nan", "std::", "terminate"})
      if (line.find(word) != std::string::npos) return Finding{"sentence", "stderr has: " + line};
  }
  const std::string out = file_text(folder / "stdout.txt");
  if (lines_of(out).size() > 1) return Finding{"sentence", "stdout has more than a line: " + out};
  return {};
}

Problem table_finding(const fs::path& file, bool may_be_empty, CsvTable& table) {
  std::string problem;
  table = read_csv(file_text(file), problem);
  if (!may_be_empty)
    for (const auto& row : table.rows)
      if (std::find(row.begin(), row.end(), std::nullopt) != row.end()) problem = "a cell is empty";
  if (problem.empty()) return {};
  return Finding{"table", file.filename().string() + ": " + problem};
}

/// A point cache has all the frames that its head promises, and no number that is not finite.
Problem cache_finding(const fs::path& file) {
  const std::string bytes = file_text(file);
  constexpr std::size_t head = 32;
  const auto number = [&](std::size_t at) {
    std::int32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
  };
  if (bytes.size() < head || !bytes.starts_with("POINTCACHE2")) return Finding{"cache", "it has no head"};
  const double points = number(16), frames = number(28);
  if (double(bytes.size()) != double(head) + 12 * points * frames)
    return Finding{"cache", "its length is not its frames'"};
  for (std::size_t at = head; at < bytes.size(); at += 4) {
    float value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    if (!std::isfinite(value)) return Finding{"cache", "it holds a number that is not finite"};
  }
  return {};
}

Problem meshes_finding(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder))
    for (const std::string& line : lines_of(file_text(entry.path())))
      if (!line.starts_with("#") && (line.find("nan") != line.npos || line.find("inf") != line.npos))
        return Finding{"mesh", entry.path().filename().string() + ": " + line};
  return {};
}

/// Speeds and places of a run that did not diverge are ones that the scene can have given, with some room for what
/// files hold other than the engine (docs/model.md, "How fast and how far").
Problem motion_finding(const RunCase& one, std::int64_t steps, const CsvTable& state) {
  constexpr double room = 2;
  Preset preset = one.preset;
  preset.W *= 1 + preset.gust;
  const Lattice lattice = lattice_of(preset);
  const State start = start_state(one.preset);
  double begun = 0, far = 0;
  for (std::size_t n = 0; n < start.v.x.size(); ++n) {
    begun += std::pow(start.v.x[n], 2) + std::pow(start.v.y[n], 2) + std::pow(start.v.z[n], 2);
    far = std::max({far, std::abs(start.x.x[n]), std::abs(start.x.y[n]), std::abs(start.x.z[n])});
  }
  // All springs as long as the start makes the longest; bodies push as far as they are large.
  double springs = 0, pushed = 0;
  if (preset.kind == Kind::one_weight) {
    springs = preset.k / preset.m * preset.offset * preset.offset;
  } else {
    for (const Direction& direction : directions) {
      const double longer = (preset.initial_stretch - 1) * direction.rest * preset.L;
      springs += spring_constant(preset, direction) * longer * longer;
    }
    // A flat cloth that has rest curvatures.
    springs += preset.B * std::pow(2 * (std::abs(preset.kappa_warp) + std::abs(preset.kappa_weft)) * preset.L, 2) *
               std::pow(std::max(preset.initial_stretch, 1.0), 2);
    springs *= double(lattice.size()) / preset.m;
    for (const Body& body : preset.bodies) {
      const bool plane = body.shape == Body::Shape::plane;
      const double wide = 2 * body.r + body.length + glm::length(body.size);
      pushed += std::sqrt(double(lattice.size())) * (plane ? 2 * far + glm::length(body.c) + std::abs(body.y) : wide);
    }
  }
  MotionLimit limit;
  limit.set_scene(preset, lattice, false, {});
  limit.begin({begun + springs, far, pushed});
  limit.pass(double(steps) * preset.dt);
  double squared = 0, away = 0;
  for (const auto& row : state.rows) {
    for (int c = 2; c < 5; ++c) away = std::max(away, std::abs(*row[std::size_t(c)]));
    for (int c = 5; c < 8; ++c) squared += std::pow(*row[std::size_t(c)], 2);
  }
  // Particles of a cloth that has parted have at least a quarter of a mass.
  const double light = state.rows.size() > start.v.x.size() ? 4 : 1;
  if (squared > room * light * limit.most_squared())
    return Finding{"motion", "it is done, and faster than anything can make it"};
  if (away > room * limit.farthest()) return Finding{"motion", "it is done, and farther away than it can fly"};
  return {};
}

Problem status_finding(const RunCase& one, int code, const Json& summary) {
  const std::string status = summary["status"];
  const int meant = status == "done" ? 0 : status == "diverged" ? 4 : status == "interrupted" ? 130 : -1;
  // A signal that arrives after the summary is written ends the program before it returns its own code.
  if (one.interrupt_after && code == 130 && meant == 4) return {};
  if (code != meant) return Finding{"status", "exit code " + std::to_string(code) + ", and the summary says " + status};
  if (summary["diverged"].is_null() == (code == 4))
    return Finding{"status", "a divergence is not told, or told without one"};
  if (code == 0 && summary["steps"] != one.steps) return Finding{"status", "it is done without all of its steps"};
  return {};
}

Problem files_finding(const RunCase& one, const fs::path& folder, const Json& summary) {
  CsvTable table;
  for (const std::string& output : one.outputs) {
    const fs::path file = folder / (output + (output == "obj" ? "" : output == "pc2" ? ".pc2" : ".csv"));
    if (!fs::exists(file)) return Finding{"file", file.filename().string() + " is missing"};
    Problem problem = output == "obj"   ? meshes_finding(file)
                      : output == "pc2" ? cache_finding(file)
                                        : table_finding(file, true, table);
    if (problem) return problem;
  }
  if (auto problem = table_finding(folder / "state.csv", false, table)) return problem;
  if (double(table.rows.size()) != double(summary["particles"]))
    return Finding{"file", "the state does not have all particles"};
  if (summary["status"] != "done") return {};
  return motion_finding(one, summary["steps"], table);
}

}  // namespace

Problem outputs_finding(const RunCase& one, int code, const fs::path& folder) {
  if (code != 0 && code != 4 && !(code == 130 && one.interrupt_after))
    return Finding{"exit code", "exit code " + std::to_string(code) + ": " + file_text(folder / "stderr.txt")};
  if (auto problem = sentences_finding(folder)) return problem;
  // An interrupt before the first step leaves nothing to be written.
  if (code == 130 && !fs::exists(folder / "summary.json")) return {};
  const Json summary = Json::parse(file_text(folder / "summary.json"), nullptr, false);
  if (summary.is_discarded()) return Finding{"summary", "the summary is no JSON"};
  if (auto problem = status_finding(one, code, summary)) return problem;
  if (code == 130) return {};
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".incomplete")
      return Finding{"file", entry.path().filename().string() + " is left"};
  return files_finding(one, folder, summary);
}

}  // namespace tyglab::fuzz
