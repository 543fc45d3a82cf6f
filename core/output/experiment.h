// An experiment as text: a recording (core/recording.h), and with what it was made. docs/presets.md has the format.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/playback.h"
#include "core/recording.h"

namespace tyglab {

struct Experiment {
  Recording recording;
  std::string version;    ///< of the program
  std::string made_with;  ///< the engine in words, with its precision and instruction set
  double seconds = 0;     ///< of simulated time
  Preset largest{};       ///< of all constants in it those with the most particles
};

/// What a simulation has done so far. Without pictures that are not the program's own: a file names no other file.
Experiment experiment_of(const Simulation& simulation);
/// The same of a recording whose beginning, or all of it, the simulation has made.
Experiment experiment_of(const Recording& recording, const Simulation& simulation);

inline constexpr int experiment_version = 1;
inline constexpr std::size_t longest_mark = 1000;  // bytes

std::string experiment_text(const Experiment& experiment);
/// Reads and checks all of it; `source` names it in errors. Throws PresetError.
Experiment parse_experiment(std::string_view text, std::string_view source);

/// How the positions of a repetition compare with the recorded ones, a sentence without its capital. `own_start`: it
/// began with the recorded constants.
std::string comparison_in_words(const Playback& playback, const Experiment& experiment, bool own_start = true);

}  // namespace tyglab
