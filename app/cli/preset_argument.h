// The argument PRESET and the options that accompany it in every command.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/base/files.h"
#include "app/cli/outputs.h"
#include "core/io/preset_io.h"
#include "core/model/preset.h"

namespace tyglab {

struct EngineChoice;
struct Experiment;
struct ToleranceChoice;

/// The engines that a command supports.
enum class Engines { all, cpu };

/// A preset with the command line's settings.
struct ResolvedPreset {
  Preset preset;
  PresetSource source;
  int threads = 1;       ///< of the CPU engine, at most
  bool auto_dt = false;  ///< --dt auto: dt is the one that AutoStep chose, and is to be watched
  std::shared_ptr<const ToleranceChoice> choice = {};      ///< --tolerance: what was chosen, and why; null: not asked
  std::shared_ptr<const EngineChoice> engine_choice = {};  ///< --engine auto, likewise
  std::shared_ptr<const Experiment> experiment = {};       ///< to be repeated, from `preset` on; null: a preset alone
  bool as_recorded = false;                                ///< with its own start

  /// The files that no output may replace.
  std::vector<Input> inputs() const;
};

/// Prints a line on stderr if the preset's texture is missing or cannot be read, which a command without pictures would
/// not notice.
void warn_of_texture(const Preset& preset);

/// PRESET, --set, --integrator, --dt, --tolerance, --engine, --precision and --threads as typed.
struct PresetArgument {
  std::string preset;
  std::vector<std::string> settings;
  std::string integrator, dt, engine, precision;
  std::optional<double> tolerance;  ///< m
  int threads = 0;                  ///< 0: as many as there are processors
  Engines engines = Engines::all;   ///< of the command
  std::string command_name;         ///< "run", "bench convergence"; empty: the program itself

  /// Adds the argument and its options to a command. It must outlive the parsing. `engines_there`: where only the CPU
  /// engine is used, another that is typed is refused, and a preset that names one runs on the CPU engine, which is
  /// said.
  void add_to(CLI::App& command, bool required, Engines engines_there = Engines::all);
  /// Reads the preset (`fallback` where none was typed) and applies the settings: --set
  /// first, then the options of their own. Throws PresetError for the file, UsageError for a setting. `commands`: words
  /// that might have been meant in place of the preset. A tolerance is tried on the first `seconds` of the motion,
  /// where they are known, and what is chosen, as of --engine auto, is said on stderr.
  ResolvedPreset resolve(const std::string& fallback = {}, const std::vector<std::string>& commands = {},
                         std::optional<double> seconds = {}) const;
  /// Whether the command line contains any part of the scene.
  bool typed() const;

 private:
  std::vector<Setting> all_settings() const;
  bool sets(std::string_view key) const;
  void check_engine() const;
  void keep_to_cpu(Preset& scene) const;
  void add_engine(CLI::App& command);
  void choose_dt(ResolvedPreset& resolved) const;
  void choose_engine(ResolvedPreset& resolved) const;
  void refuse_other_steps() const;
  /// The command line with another tolerance, for the user to type.
  std::string with_tolerance(double other, std::optional<double> seconds) const;
  void choose_by_tolerance(ResolvedPreset& resolved, std::optional<double> seconds) const;
};

}  // namespace tyglab
