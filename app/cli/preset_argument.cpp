#include "app/cli/preset_argument.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <iostream>
#include <system_error>

#include "app/base/experiment_file.h"
#include "app/base/files.h"
#include "app/base/image.h"
#include "app/base/text.h"
#include "app/cli/command_line.h"
#include "core/analysis/machine.h"
#include "core/analysis/settings_search.h"
#include "core/analysis/tolerance.h"
#include "core/energy/auto_step.h"
#include "core/integrators/scheme.h"
#include "core/io/preset_io.h"
#include "core/io/terminal.h"
#include "core/model/notation.h"
#include "core/model/words.h"

namespace tyglab {
namespace fs = std::filesystem;

void warn_of_texture(const Preset& preset) {
  const fs::path picture = texture_file(preset.texture);
  const auto warn = [](const std::string& what) { std::cerr << "tyglab: view.texture: " << in_one_line(what) << '\n'; };
  std::error_code error;
  if (!fs::is_regular_file(picture, error))
    return warn("there is no image '" + preset.texture +
                "', so the cloth would be drawn without one; check the name and the folder.");
  if (is_shipped_texture(preset.texture)) return;
  try {
    read_image(picture);
  } catch (const std::runtime_error& problem) {
    warn("the cloth would be drawn without its image: " + std::string(problem.what()));
  }
}

namespace {

constexpr std::string_view automatic = "auto";

/// N of opencl:N; none where the text is not that.
std::optional<int> device_number(std::string_view engine) {
  constexpr std::string_view before = "opencl:";
  if (!engine.starts_with(before)) return {};
  const char *first = engine.data() + before.size(), *last = engine.data() + engine.size();
  int number = -1;
  const auto [end, error] = std::from_chars(first, last, number);
  if (error != std::errc() || end != last || number < 0) return {};
  return number;
}

/// A word as it is typed in a shell: in quotes where it holds what a shell would not take as it is.
std::string in_shell(const std::string& word) {
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./=+-,:";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char letter : word) quoted += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return quoted + "'";
}

}  // namespace

void PresetArgument::add_engine(CLI::App& command) {
  if (engines == Engines::cpu) {
    command.add_option("--engine", engine, "cpu, the only engine for this command")
        ->type_name("cpu")
        ->check(not_empty());
    return;
  }
  command
      .add_option("--engine", engine,
                  "Engine: cpu; opencl, on the first GPU or else the first OpenCL device;\n"
                  "opencl:N, on the device with that number in `tyglab devices`; plain: the reference,\n"
                  "loops in double, slow; or auto: the fastest in short runs of this scene, whose times\n"
                  "are cached")
      ->type_name("cpu|opencl[:N]|plain|auto")
      ->check(not_empty());
}

void PresetArgument::add_to(CLI::App& command, bool required, Engines engines_there) {
  engines = engines_there;
  for (const CLI::App* each = &command; each->get_parent() != nullptr; each = each->get_parent())
    command_name = each->get_name() + (command_name.empty() ? "" : " ") + command_name;
  command
      .add_option(
          "PRESET", preset,
          "A shipped preset's name (`tyglab presets` lists them), a preset file, an experiment (F.tyglab), or a\n"
          "link that the page or `Copy link` made: 'https://…" +
              std::string(example_link) + "' or its end from # on")
      ->required(required)
      ->check(not_empty());
  command
      .add_option("--set", settings,
                  "Set a constant by the key of the preset file: --set k_s=500 --set \"W=[0,0,0.02]\"\n"
                  "--set \"bodies[0].r=0.3\". Can be repeated")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->allow_extra_args(false)
      ->take_all();
  command.add_option("--integrator", integrator, "Numerical method: " + joined(integrator_names()))
      ->type_name("NAME")
      ->check(not_empty());
  command
      .add_option("--dt", dt,
                  "Time step, s; or auto: 0.8 of the worst-case limit, where linear theory finds any shape of the\n"
                  "cloth stable, halved while the energy ledger finds that the integrator adds energy")
      ->type_name("S|auto")
      ->check(not_empty());
  command
      .add_option(
          "--tolerance", tolerance,
          "Choose --integrator, --dt and, if float is too coarse, --precision double, so that the error of positions "
          "in\n"
          "the first second is at most M (m, root mean square). Short trial runs of the scene take a few seconds, at\n"
          "most about half a minute on an idle machine; Ctrl-C ends them. If this accuracy cannot be guaranteed, "
          "which\n"
          "is common with contact, nothing is run, and the message names the tightest possible tolerance. A method or\n"
          "a precision given as an option is kept")
      ->type_name("M")
      ->transform(number_between(1e-12, 1, "m"));
  add_engine(command);
  command.add_option("--precision", precision, "Floating-point numbers of 32 or 64 bits")
      ->type_name("float|double")
      ->check(not_empty());
  command
      .add_option(
          "--threads", threads,
          "Largest number of threads of the CPU engine, 1 to 256: fewer are used for cloths too small for them and "
          "while other programs are using the CPUs (default: one per CPU). The result is identical to "
          "the last bit")
      ->type_name("N")
      ->transform(whole_number_between(1, 256));
}

std::vector<Setting> PresetArgument::all_settings() const {
  std::vector<Setting> all;
  for (const std::string& text : settings) all.push_back(parse_setting(text));
  const auto add = [&](const std::string& key, const std::string& value) {
    if (value.empty()) return;
    if (sets(key)) throw UsageError("--" + key + " and --set " + key + "=…: leave one of the two out");
    all.push_back({"--" + key + " " + value, key, value});
  };
  add("integrator", integrator);
  if (dt != automatic) add("dt", dt);
  if (engine != automatic) add("engine", engine.substr(0, engine.find(':')));
  add("precision", precision);
  return all;
}

bool PresetArgument::typed() const {
  const auto typed = {&preset, &integrator, &dt, &engine, &precision};
  return !settings.empty() || tolerance ||
         std::any_of(typed.begin(), typed.end(), [](auto* text) { return !text->empty(); });
}

bool PresetArgument::sets(std::string_view key) const {
  return std::any_of(settings.begin(), settings.end(), [&](const std::string& text) {
    const std::string typed = parse_setting(text).key;
    return typed == key || typed == "solver." + std::string(key);
  });
}

void PresetArgument::check_engine() const {
  constexpr std::array<std::string_view, 4> known{"cpu", "opencl", "plain", automatic};
  if (engine.empty()) return;
  if (engines == Engines::cpu) {
    if (engine == "cpu") return;
    throw UsageError("--engine " + engine + ": this command runs only on the CPU engine; omit --engine");
  }
  if (std::find(known.begin(), known.end(), engine) != known.end() || device_number(engine)) return;
  throw UsageError("--engine " + engine +
                   ": allowed are cpu, opencl, opencl:N, plain and auto; `tyglab devices` lists each device's N" +
                   (engine == "gpu" || engine == "cuda"
                        ? "; did you mean opencl?"
                        : did_you_mean(std::string_view(engine).substr(0, engine.find(':')), known, "")));
}

void PresetArgument::keep_to_cpu(Preset& scene) const {
  if (scene.engine == EngineKind::cpu) return;
  const std::string name(name_of(scene.engine));
  if (sets("engine")) throw UsageError("--set engine=" + name + ": this command runs only on the CPU engine; omit it");
  std::cerr << "tyglab: the preset asks for the engine " << name
            << ", but this command runs only on the CPU engine, which is used instead.\n";
  scene.engine = EngineKind::cpu;
}

/// Where a method has no stable dt.
std::string stable_alternative(Preset preset) {
  const bool verlet = preset.integrator != "verlet" && (preset.integrator = "verlet", AutoStep::choose(preset));
  return verlet
             ? "another --integrator (verlet is stable), or more damping with --set k_d=…"
             : "--integrator implicit_euler, which is stable at every dt, softer springs, less damping or a larger m";
}

void PresetArgument::choose_dt(ResolvedPreset& resolved) const {
  const auto chosen = AutoStep::choose(resolved.preset);
  if (!chosen)
    throw UsageError("--dt auto: " + resolved.preset.integrator +
                     " has no stable dt with these constants that is allowed (1e-7 s or more); use " +
                     stable_alternative(resolved.preset) + ".");
  resolved.preset.dt = *chosen;
  std::cerr << "tyglab: --dt auto chose " << short_number(*chosen) << " s for "
            << scheme(resolved.preset.integrator).title << ".\n";
}

void PresetArgument::choose_engine(ResolvedPreset& resolved) const {
  if (sets("engine")) throw UsageError("--engine auto: chooses the engine itself; omit --set engine");
  resolved.engine_choice = std::make_shared<EngineChoice>(tyglab::choose_engine(resolved.preset, resolved.threads));
  resolved.preset.engine = resolved.engine_choice->engine, resolved.preset.device = resolved.engine_choice->device;
  std::cerr << "tyglab: --engine auto chose " << resolved.engine_choice->why << ".\n";
}

std::string PresetArgument::with_tolerance(double other, std::optional<double> seconds) const {
  std::string line = "tyglab";
  for (const std::string& word : {command_name, preset.empty() ? preset : in_shell(preset)})
    if (!word.empty()) line += " " + word;
  for (const std::string& text : settings) line += " --set " + in_shell(text);
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) line += std::string(" ") + option + " " + value;
  };
  add("--integrator", integrator), add("--engine", engine), add("--precision", precision);
  if (seconds) add("--seconds", shortest_number(*seconds));
  return line + " --tolerance " + short_number(other, 2);
}

void PresetArgument::choose_by_tolerance(ResolvedPreset& resolved, std::optional<double> seconds) const {
  if (!dt.empty() || sets("dt")) throw UsageError("--tolerance: chooses dt itself; omit --dt and --set dt");
  constexpr double longest = 1;  // s of motion
  const double shown = seconds.value_or(0);
  SettingsGoal goal{.tolerance = *tolerance, .seconds = shown > 0 ? std::min(shown, longest) : longest};
  goal.keeps = {!integrator.empty() || sets("integrator"), !precision.empty() || sets("precision")};
  Progress progress("trying methods and dt");
  try {
    ToleranceChoice choice = choose_for_tolerance(
        resolved.preset, goal, [] { return false; },
        [&](const SettingsSearch& search) { progress.update(search.part_done()); });
    // Whole steps are to end at the time asked for: with a dt that is no longer the error is no larger.
    if (shown > 0 && choice.chosen.tolerance == 0)
      choice.preset.dt = std::max(shown / std::ceil(shown / choice.preset.dt - 1e-9), least_dt);
    resolved.choice = std::make_shared<ToleranceChoice>(std::move(choice));
  } catch (const ToleranceError& error) {
    throw UsageError(std::string("--tolerance: ") + error.what() +
                     (error.tightest ? ": " + with_tolerance(*error.tightest, seconds) : "") + ".");
  } catch (const std::runtime_error& error) {
    throw UsageError(std::string("--tolerance: ") + error.what());
  }
  progress.clear();
  resolved.preset = resolved.choice->preset;
  std::cerr << "tyglab: --tolerance chose " << resolved.choice->words(*tolerance) << '\n';
}

/// A recording names steps, so that others would make its events at other times.
void PresetArgument::refuse_other_steps() const {
  const std::string why = ": an experiment is repeated step by step, so its dt stays; leave the option out";
  if (!dt.empty()) throw UsageError("--dt" + why);
  if (sets("dt")) throw UsageError("--set dt=…" + why);
  if (tolerance) throw UsageError("--tolerance" + why);
}

std::vector<Input> ResolvedPreset::inputs() const {
  return {{"the preset", source.file},
          {"the texture", preset.texture.empty() ? fs::path() : texture_file(preset.texture)}};
}

ResolvedPreset PresetArgument::resolve(const std::string& fallback, const std::vector<std::string>& commands,
                                       std::optional<double> seconds) const {
  check_engine();
  ResolvedPreset resolved;
  const std::optional<LinkedPreset> link = is_link(preset) ? std::optional(read_link(preset)) : std::nullopt;
  resolved.source = find_preset(link ? link->name : preset.empty() ? fallback : preset, commands);
  std::shared_ptr<Experiment> experiment;
  if (!link && is_experiment(resolved.source.file)) {
    refuse_other_steps();
    experiment = std::make_shared<Experiment>(load_experiment(resolved.source.file));
  }
  const Preset read = link         ? linked_preset(*link)
                      : experiment ? experiment->recording.start()
                                   : read_preset(resolved.source.file);
  try {
    resolved.preset = with_parsed_settings(read, all_settings());
    if (resolved.preset.texture != read.texture) resolved.preset.texture = chosen_texture(resolved.preset.texture);
  } catch (const PresetError& error) {
    throw UsageError(error.what());
  }
  if (const auto number = device_number(engine)) resolved.preset.device = *number;
  if (engines == Engines::cpu) keep_to_cpu(resolved.preset);
  resolved.auto_dt = dt == automatic;
  if (tolerance) choose_by_tolerance(resolved, seconds);
  if (resolved.auto_dt) choose_dt(resolved);
  resolved.threads = threads > 0 ? threads : processors();
  if (engine == automatic) choose_engine(resolved);
  if (experiment) {
    resolved.as_recorded = resolved.preset == read;
    experiment->recording = experiment->recording.beginning_with(resolved.preset);
    resolved.experiment = std::move(experiment);
  }
  return resolved;
}

}  // namespace tyglab
