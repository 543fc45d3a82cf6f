#include "app/cli/commands/commands.h"

#include <cctype>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/base/experiment_file.h"
#include "app/base/files.h"
#include "app/cli/outputs.h"
#include "app/cli/preset_argument.h"
#include "app/cli/stepping.h"
#include "app/process/interrupt.h"
#include "app/process/program_run.h"
#include "core/analysis/area.h"
#include "core/analysis/pierced.h"
#include "core/analysis/self_crossings.h"
#include "core/analysis/settings_search.h"
#include "core/analysis/tolerance.h"
#include "core/integrators/scheme.h"
#include "core/io/output_file.h"
#include "core/io/preset_io.h"
#include "core/io/terminal.h"
#include "core/model/notation.h"
#include "core/model/words.h"
#include "core/output/obj.h"
#include "core/output/series_csv.h"
#include "core/output/state_csv.h"
#include "core/theory/advice.h"
#include "tyglab_version.h"

namespace tyglab {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

struct RunOptions {
  PresetArgument preset;
  Length length;
  std::string state, values, series, ledger, obj, pc2, json, record;
  std::optional<double> fps;
  std::optional<std::int64_t> series_every;
  bool material = false;
  double step_limit_ms = 0;  ///< 0: none

  /// All but --obj, which names a folder.
  std::vector<Output> outputs() const {
    return {{"--state", state},   {"--values", values},       {"--series", series}, {"--ledger", ledger},
            {"--pc2", pc2, true}, {"--record", record, true}, {"--json", json}};
  }
  bool wants_frames() const { return !obj.empty() || !pc2.empty(); }

  /// An option that would do nothing is a mistake of whoever typed it. Throws UsageError.
  void check_combination() const {
    const bool rows = !series.empty() || !ledger.empty();
    if (material && obj.empty()) throw UsageError("--mtl: writes the material of --obj; add --obj DIR");
    if (series_every && !rows)
      throw UsageError("--series-every: sets how often --series and --ledger write a row; add --series F.csv");
    if (fps && !wants_frames() && !(rows && !series_every))
      throw UsageError(
          rows ? "--fps: --series-every sets the rows of --series and --ledger, and there are no frames; leave one of "
                 "the two options out"
               : "--fps: sets the frames of --obj, --pc2, --series and --ledger; add one of these");
  }
};

/// The files of a run. Each is right as far as it goes, however the run ends, and replaces an older one only if whole.
class Outputs {
 public:
  Outputs(const RunOptions& options, const ResolvedPreset& scene, std::int64_t steps)
      : options_(options), scene_(scene), plan_(options.fps, scene.preset.dt, steps) {
    for (const Output& output : options.outputs())
      if (!options.obj.empty() && is_frame(output.file))
        throw UsageError(output.option + ": --obj writes frames in that folder under such names; use another name");
    check_outputs(options.outputs(), scene.inputs());
    for (const Output& output : options.outputs())
      if (!options.obj.empty() && !output.file.empty() && same_file(output.file, options.obj))
        throw UsageError(output.option + " and --obj: both go to " + output_name(output.file) +
                         "; use a different name for one of them");
    if (options.obj.empty()) return;
    if (scene.preset.kind == Kind::one_weight)
      throw UsageError("--obj needs a cloth, and " + in_one_line(scene.source.label) +
                       " is a mass on a spring; --series writes its motion");
    make_output_folder("--obj", options.obj);
  }

  /// Opens what is written as the run goes.
  void open(const Simulation& simulation) {
    const Preset& preset = simulation.preset();
    if (!options_.series.empty())
      series_ = std::make_unique<SeriesCsv>(options_.series, series_columns(preset.kind), preset_hash(preset));
    if (!options_.ledger.empty())
      ledger_ = std::make_unique<SeriesCsv>(options_.ledger, ledger_columns(), preset_hash(preset));
    if (options_.material) write_material(preset);
    if (!options_.pc2.empty()) cache_ = std::make_unique<PointCache>(options_.pc2, simulation.lattice().sites().size());
  }

  /// The next step at which something is to be written.
  std::int64_t next_step() const {
    std::int64_t next = std::numeric_limits<std::int64_t>::max();
    if (options_.wants_frames() && frame_ < plan_.count()) next = plan_.step_of(frame_);
    if (series_ || ledger_) next = std::min(next, next_row());
    return next;
  }

  void follow(const Timeline& timeline) { plan_.follow(timeline); }

  /// Writes what is due at the present step.
  void write_due(Simulation& simulation) {
    const std::int64_t step = simulation.past().steps();
    if (options_.wants_frames() && frame_ < plan_.count() && step == plan_.step_of(frame_)) {
      const VectorField<double>& x = simulation.read().x;
      if (cache_) cache_->add(x);
      if (!options_.obj.empty()) {
        std::optional<InterruptExit> at_once;
        if (takes_long_to_show(simulation)) at_once.emplace();
        write_obj(fs::path(options_.obj) / frame_name(scene_.source.label, frame_, plan_.count(), "obj"),
                  simulation.tears(), x,
                  {simulation.preset().name, static_cast<int>(frame_), simulation.time(), plan_.fps(), material_});
      }
      ++frame_;
    }
    if ((series_ || ledger_) && step == next_row()) {
      if (series_) series_->add(simulation.time(), series_values(simulation));
      if (ledger_) ledger_->add(simulation.time(), ledger_values(*simulation.ledger()));
      ++row_;
    }
  }

  /// Ends what was written as the run went, and writes the state as it ended. Returns what was written: kind, path, and
  /// frames where there are several.
  Json finish(Simulation& simulation, bool interrupted) {
    Json files = Json::array();
    const auto add = [&](const char* kind, const fs::path& path) -> Json& {
      return files.emplace_back(Json{{"kind", kind}, {"path", path.string()}});
    };
    // First what holds the work of the whole run.
    const Reach history = interrupted ? Reach::cut_short : Reach::whole;
    if (series_) series_->end(history), add("series", series_->path())["rows"] = row_;
    if (ledger_) ledger_->end(history), add("ledger", ledger_->path())["rows"] = row_;
    if (cache_) cache_->end(history), add("pc2", cache_->path())["frames"] = frame_;
    if (!options_.obj.empty()) {
      add("obj", options_.obj)["frames"] = frame_;
      if (!interrupted) warn_of_older_frames({options_.obj, scene_.source.label, "obj", plan_.count(), frame_});
    }
    const bool slow = takes_long_to_show(simulation);
    if (slow && interrupted) return files;
    std::optional<InterruptExit> at_once;
    if (slow) at_once.emplace();
    const Reach moment = interrupted ? Reach::stopped : Reach::whole;
    if (!options_.state.empty()) add("state", write_output(options_.state, state_csv(simulation), moment));
    if (!options_.values.empty()) add("values", write_output(options_.values, values_csv(simulation, nullptr), moment));
    if (!options_.record.empty())
      add("experiment", save_experiment(experiment_of(simulation), options_.record, moment));
    return files;
  }

 private:
  /// The material, and its image, beside the frames.
  void write_material(const Preset& preset) {
    std::string name = scene_.source.label, image;  // without what would end a name in these files
    for (char& c : name)
      if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_' && c != '-') c = '_';
    if (const fs::path file = texture_file(preset.texture); !preset.texture.empty() && fs::is_regular_file(file)) {
      constexpr std::uintmax_t most_bytes = 1 << 28;
      image = name + file.extension().string();
      write_atomically(fs::path(options_.obj) / image, read_input(file, "texture", most_bytes));
    }
    material_ = name + ".mtl";
    write_atomically(fs::path(options_.obj) / material_, material_text(image));
  }

  /// Whether an output has the name that a frame of --obj may get.
  bool is_frame(const std::string& output) const {
    const fs::path file(output);
    std::error_code ignored;
    const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
    if (fs::weakly_canonical(folder, ignored) != fs::weakly_canonical(options_.obj, ignored)) return false;
    return is_frame_name(file.filename().string(), scene_.source.label, "obj");
  }

  std::int64_t next_row() const { return options_.series_every ? row_ * *options_.series_every : plan_.step_of(row_); }

  const RunOptions& options_;
  const ResolvedPreset& scene_;
  FramePlan plan_;
  std::unique_ptr<SeriesCsv> series_, ledger_;
  std::unique_ptr<PointCache> cache_;
  std::string material_;    ///< its file's name in the folder of --obj; empty: none
  std::int64_t frame_ = 0;  ///< frames written
  std::int64_t row_ = 0;    ///< rows written
};

/// JSON has no word for inf and nan: null.
Json finite_json(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

Json divergence_json(const std::optional<Divergence>& divergence) {
  if (!divergence) return nullptr;
  const Divergence& d = *divergence;
  return {{"t", d.t},         {"step", d.step},         {"i", d.i},
          {"j", d.j},         {"quantity", d.quantity}, {"value", finite_json(d.value)},
          {"cause", d.cause}, {"remedy", d.advice}};
}

/// What the steps did at the end, and what they skipped.
Json features_json(const Engine& engine) {
  Json json = Json::object();
  for (const auto& [name, on] : engine.features()) json[std::string(name)] = on;
  return json;
}

/// What a method that solves equations did; null for others.
Json solves_json(const Simulation& simulation) {
  if (!solves_equations(scheme(simulation.preset().integrator))) return nullptr;
  const SolveCounts counts = simulation.engine().solves();
  return {{"newton_steps", counts.newton},
          {"linear_steps", counts.linear},
          {"force_evaluations", counts.force_evaluations},
          {"unconverged", counts.unconverged},
          {"unconverged_by_rounding", counts.rounded},
          {"ended_early", counts.ended_early},
          {"longest_limited_s", counts.longest_limited},
          {"worst_residual", finite_json(counts.worst_residual)}};
}

/// The ledger at the end, J; null where none was kept.
Json energy_json(const Simulation& simulation) {
  const auto ledger = simulation.ledger();
  if (!ledger) return nullptr;
  Json json = Json::object();
  const std::vector<double> values = ledger_values(*ledger);
  std::size_t n = 0;
  for (const SeriesColumn& column : ledger_columns())
    json[column.unit.empty() ? column.name : column.name + "_" + column.unit] = values[n++];
  return json;
}

/// What --tolerance chose, and what else reached the error, cheapest first; null where it was not asked for.
Json choice_json(const ToleranceChoice* choice) {
  if (!choice) return nullptr;
  Json reached = Json::array();
  for (const ErrorPoint& point : choice->reached)
    reached.push_back({{"integrator", point.integrator},
                       {"precision", name_of(point.precision)},
                       {"dt", point.dt},
                       {"tolerance_m", point.tolerance > 0 ? Json(point.tolerance) : Json()},
                       {"error_rms_m", point.error_rms_m},
                       {"told", point.resolved},
                       {"processor_seconds_per_second", point.cost}});
  return {{"tried_s", choice->seconds}, {"agreement_rms_m", choice->agreement_rms_m}, {"reached", std::move(reached)}};
}

/// What --engine auto chose, and why; null where it was not asked.
Json engine_choice_json(const EngineChoice* choice) {
  if (!choice) return nullptr;
  Json times = Json::array();
  for (const EngineTime& time : choice->times)
    times.push_back({{"engine", name_of(time.engine)},
                     {"device", time.device < 0 ? Json(nullptr) : Json(time.device)},
                     {"name", time.name},
                     {"ns_per_particle_step", time.ns > 0 ? Json(time.ns) : Json(nullptr)}});
  return {{"why", choice->why}, {"measured_now", choice->measured}, {"times", std::move(times)}};
}

/// What a method that chooses its own steps did; null for others.
Json inner_steps_json(const Simulation& simulation) {
  if (!chooses_steps(scheme(simulation.preset().integrator))) return nullptr;
  const InnerSteps inner = simulation.engine().inner_steps();
  return {{"accepted", inner.accepted},
          {"rejected", inner.rejected},
          {"by_stability", inner.by_stability},
          {"by_accuracy", inner.by_accuracy},
          {"by_dt", inner.by_dt},
          {"too_short", inner.too_short},
          {"below_digits", inner.below_digits},
          {"force_evaluations", inner.force_evaluations}};
}

/// What the end of a run is looked at for: what its last state tells of it.
struct EndFindings {
  double excess = 0;                   ///< of energy (Simulation::excess)
  std::optional<Crossings> crossings;  ///< none after a divergence, and in haste
  std::optional<double> area;          ///< m²; none in haste
};

EndFindings findings_at_end(Simulation& simulation, bool in_haste) {
  EndFindings findings;
  if (in_haste) return findings;
  findings.excess = simulation.excess(), findings.area = cloth_area(simulation);
  CrossingLimits limits;
  limits.tested = 30'000'000;  // seconds
  if (!simulation.divergence()) findings.crossings = self_crossings(simulation, limits);
  return findings;
}

Json crossings_json(const std::optional<Crossings>& crossings) {
  return crossings && crossings->complete ? Json(crossings->pairs) : Json();
}

/// How the repetition of an experiment compared with it; null where none was repeated.
Json repetition_json(const Playback* playback) {
  if (playback == nullptr) return nullptr;
  const Playback::Comparison& found = playback->comparison();
  return {{"recorded_steps", playback->recording().steps()},
          {"repeats", playback->recording().repeats()},
          {"compared", found.compared},
          {"equal_until", found.equal_until},
          {"differs_at", found.differs_at ? Json(*found.differs_at) : Json()},
          {"apart_m", found.looked_at > 0 ? finite_json(found.apart) : Json()}};
}

/// What a run did, for programs.
Json summary(Simulation& simulation, const ResolvedPreset& scene, const std::string& status, double wall_seconds,
             double ns_per_particle_step, const EndFindings& end, const Playback* playback, Json files) {
  const Preset& preset = simulation.preset();
  return {{"version", TYGLAB_VERSION},
          {"preset", scene.source.label},
          {"preset_hash", preset_hash(preset)},
          {"status", status},
          {"engine", name_of(preset.engine)},
          {"engine_name", simulation.engine().name()},
          {"threads", simulation.engine().threads()},
          {"precision", name_of(preset.precision)},
          {"integrator", preset.integrator},
          {"rows", simulation.lattice().sites().rows},
          {"columns", simulation.lattice().columns},
          {"dt", preset.dt},
          {"steps", simulation.steps()},
          {"t", simulation.time()},
          {"seconds", wall_seconds},
          {"ns_per_particle_step", ns_per_particle_step},
          {"bytes_per_particle", double(simulation.engine().bytes()) / simulation.lattice().size()},
          {"features", features_json(simulation.engine())},
          {"solves", solves_json(simulation)},
          {"inner_steps", inner_steps_json(simulation)},
          {"tolerance_choice", choice_json(scene.choice.get())},
          {"engine_choice", engine_choice_json(scene.engine_choice.get())},
          {"torn", simulation.tears().torn_count()},
          {"particles", simulation.tears().particles()},
          {"area", end.area ? finite_json(*end.area) : Json()},
          {"left_inside", simulation.left_inside()},
          {"held_back", simulation.engine().held_back()},
          {"energy", energy_json(simulation)},
          {"energy_over_given", finite_json(end.excess)},
          {"diverged", divergence_json(simulation.divergence())},
          {"repetition", repetition_json(playback)},
          {"files", std::move(files)},
          {"crossings", crossings_json(end.crossings)}};
}

std::string number(double value, int digits) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.*g", digits, value);
  return text.data();
}

/// The closing sentence. `also`: the name of the summary itself, where it was written.
std::string closing(const Json& summary, const std::string& also) {
  const std::string label = in_one_line(summary["preset"].get<std::string>());
  std::string text = label + ": " + counted(summary["steps"], "step") + " to t = " + number(summary["t"], 6) +
                     " s, computed in " + number(summary["seconds"], 3) + " s";
  if (summary["steps"] > 0) text += " (" + number(summary["ns_per_particle_step"], 3) + " ns per particle and step)";
  text += ".";
  const auto named = [](const Json& file) {
    const std::string name = output_name(file["path"].get<std::string>());
    return file.contains("frames") ? name + " (" + counted(file["frames"], "frame") + ")" : name;
  };
  std::vector<std::string> names;
  for (const Json& file : summary["files"]) names.push_back(named(file));
  if (!also.empty()) names.push_back(also);
  if (names.empty())
    return text + " No files were written; --state, --values, --series, --ledger, --obj and --pc2 write them.";
  return text + " Wrote " + joined(names) + ".";
}

/// Whether steps of these can end early.
void check_step_limit(const Preset& preset) {
  if (preset.engine != EngineKind::cpu)
    throw UsageError("--step-limit: only the CPU engine has solves that can end early; use --engine cpu");
  if (preset.kind == Kind::one_weight)
    throw UsageError("--step-limit: a mass on a spring is solved at once; leave the option out");
  const Scheme& method = scheme(preset.integrator);
  if (can_end_early(method)) return;
  throw UsageError("--step-limit: " +
                   (is_implicit(method)
                        ? "a step of " + preset.integrator + " amplifies the part that it leaves unsolved"
                        : "a step of " + preset.integrator + " always does the same work") +
                   "; use implicit_euler, projective_dynamics or vbd, or leave the option out");
}

int run(const RunOptions& options) {
  options.check_combination();
  check_record(options.record);
  const ResolvedPreset scene = options.preset.resolve({}, {}, options.length.seconds.value_or(4));
  warn_of_texture(scene.preset);
  if (options.step_limit_ms > 0) check_step_limit(scene.preset);
  const RunLength length = length_of(options.length, scene.preset, scene.experiment.get());
  options.length.warn_if_too_short(scene.preset.dt);
  Outputs outputs(options, scene, length.of_first_dt);
  run_programs_once(scene.preset, !options.ledger.empty());  // that time is none of the steps'
  Simulation simulation(scene.preset, scene.threads);
  simulation.limit_steps(options.step_limit_ms / 1000);
  if (!options.ledger.empty()) simulation.enable_ledger(true);
  if (!options.record.empty()) simulation.keep_hashes(true);
  outputs.open(simulation);
  std::optional<Playback> playback;
  if (scene.experiment) playback.emplace(scene.experiment->recording);

  const InterruptGuard guard;
  const auto start = std::chrono::steady_clock::now();
  Stepper stepper(simulation, length.steps, scene.source.label, scene.auto_dt, playback ? &*playback : nullptr);
  bool going = true;
  do {
    outputs.write_due(simulation);
    going = stepper.advance_to(std::min(stepper.end(), outputs.next_step()));
    if (stepper.changed()) outputs.follow(stepper.timeline()), going = true;
  } while (going && stepper.made() < stepper.end());
  if (going) outputs.write_due(simulation);
  const double wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

  const bool diverged = simulation.divergence().has_value();
  const double particle_steps = double(stepper.made()) * simulation.tears().particles();
  const bool in_haste = stepper.interrupted() && takes_long_to_show(simulation);
  const EndFindings end = findings_at_end(simulation, in_haste);
  const Json report = summary(simulation, scene,
                              diverged                ? "diverged"
                              : stepper.interrupted() ? "interrupted"
                                                      : "done",
                              wall_seconds, particle_steps > 0 ? stepper.seconds() * 1e9 / particle_steps : 0, end,
                              playback ? &*playback : nullptr, outputs.finish(simulation, stepper.interrupted()));
  std::string summary_name;
  if (!options.json.empty())
    summary_name = output_name(
        write_output(options.json, json_text(report), stepper.interrupted() ? Reach::stopped : Reach::whole));

  people(options.outputs()) << closing(report, summary_name) << std::endl;
  if (playback)
    people(options.outputs()) << "Repeated " << in_one_line(scene.source.label)
                              << ".tyglab: " << comparison_in_words(*playback, *scene.experiment, scene.as_recorded)
                              << std::endl;
  if (in_haste)
    end_interrupted(options.state.empty() && options.values.empty()
                        ? ""
                        : "The last state was left out, since a cloth of this size takes long to write.");
  if (diverged)
    std::cerr << "tyglab: " << in_one_line(scene.source.label) << ' ' << simulation.divergence()->in_words() << '\n';
  if (const std::string excess = energy_in_excess(end.excess, simulation.preset()); !excess.empty())
    std::cerr << "tyglab: " << excess << '\n';
  if (const std::string missed = solves_missed(simulation.engine().solves(), simulation.steps(), simulation.preset());
      !missed.empty())
    std::cerr << "tyglab: " << missed << '\n';
  if (const std::string missed = tolerance_missed(scene.preset, simulation.engine().inner_steps()); !missed.empty())
    std::cerr << "tyglab: " << missed << '\n';
  if (simulation.left_inside() > 0)
    std::cerr << "tyglab: " << counted(simulation.left_inside(), "particle")
              << " left inside a body, since bodies overlap; move them apart.\n";
  if (const std::string pierced = in_haste ? "" : pierced_in_words(simulation); !pierced.empty())
    std::cerr << "tyglab: " << pierced << '\n';
  if (const std::string crossings = end.crossings ? crossings_in_words(*end.crossings) : ""; !crossings.empty())
    std::cerr << "tyglab: " << crossings << '\n';
  if (stepper.interrupted())
    std::cerr
        << "tyglab: Interrupted; what was written so far has whole rows and frames, and no older file was replaced.\n";
  return diverged ? exit_diverged : stepper.interrupted() ? exit_interrupted : exit_done;
}

}  // namespace

void add_run_command(CLI::App& program, Action& action) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* command = program.add_subcommand("run", "Simulate without a window and write files");
  options->preset.add_to(*command, true);
  options->length.add_to(*command, true);
  add_output(*command, "--state", options->state, "Write the last state: i,j,x,y,z,vx,vy,vz of every particle (CSV)")
      ->type_name("F.csv");
  add_output(*command, "--values", options->values,
             "Write the quantities that can color the cloth: tension, strain, speed and kinetic energy of every "
             "particle (CSV)")
      ->type_name("F.csv");
  add_output(*command, "--series", options->series,
             "Write a time series (CSV): t in s, energy, heights, sums and largest values of the forces;\n"
             "units are in the header. One row per frame of --fps")
      ->type_name("F.csv");
  add_output(*command, "--ledger", options->ledger,
             "Write the energy ledger (CSV), J: the cloth's energy, the work of damping, contact, tearing, wind and\n"
             "hand, and what the integrator added or removed. Rows as of --series; every step is examined, which\n"
             "multiplies the time of a step")
      ->type_name("F.csv");
  command->add_option("--series-every", options->series_every, "One row every N steps instead")
      ->type_name("N")
      ->transform(whole_number_between(1, 1'000'000'000'000));
  add_output(*command, "--obj", options->obj, "Write a mesh per frame: DIR/PRESET_0000.obj, …")->type_name("DIR");
  command->add_flag("--mtl", options->material, "Write the cloth's material and texture beside the meshes");
  add_output(*command, "--pc2", options->pc2, "Write a point cache of all frames")->type_name("F.pc2");
  command
      ->add_option(
          "--step-limit", options->step_limit_ms,
          "End a step of implicit Euler, projective dynamics or vertex block descent after this real time, and\n"
          "keep its current result; the motion then differs from run to run. The final message reports how\n"
          "many steps ended early, and their residual")
      ->type_name("MS")
      ->transform(number_between(0.01, 1e6, "ms"));
  command->add_option("--fps", options->fps, "Frames per second of simulated time (default 25)")
      ->type_name("F")
      ->transform(number_between(1e-6, 1e7, "frames per second"));
  add_output(
      *command, "--record", options->record,
      "Write the run as an experiment: its preset, its events, and checks of the positions. `tyglab run F.tyglab`\n"
      "repeats it and compares the positions; the sandbox opens it")
      ->type_name("F.tyglab");
  add_output(*command, "--json", options->json, "Write a summary for programs")->type_name("F.json");
  command->footer(
      "Example: tyglab run denim --seconds 2 --set k_s=500 --state denim.csv --obj frames --fps 25\n"
      "- in place of F is standard output; messages then go to stderr.\n"
      "An older file is replaced only by a complete one; an incomplete output is kept as F.incomplete.\n"
      "Exit codes: 0 done, 2 wrong command line, 3 wrong preset, 4 diverged, 5 no such engine, 6 not writable, "
      "130 interrupted.");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace tyglab
