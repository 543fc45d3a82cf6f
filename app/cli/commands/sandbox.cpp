#include "app/cli/commands/commands.h"

#include <iostream>
#include <memory>

#include "app/cli/command_line.h"
#include "app/cli/film.h"
#include "app/cli/outputs.h"
#include "app/cli/preset_argument.h"
#include "app/platform/platform.h"
#include "app/process/process.h"
#include "app/session/lab_state.h"
#include "app/shell/sandbox.h"
#include "core/io/output_file.h"

namespace tyglab {
namespace {

constexpr auto default_preset = "hanging";
constexpr PictureSize smallest_window{480, 320};

struct Options {
  PresetArgument preset;
  int frames = 0, lab_step = 0;
  std::string screenshot, time_report, session_report, record, color, effects, size, lab;
  bool no_panels = false;

  std::vector<Output> outputs() const {
    return {{"--screenshot", screenshot, true},
            {"--time-report", time_report},
            {"--session-report", session_report},
            {"--record", record}};
  }
};

int open_sandbox(const Options& options, const std::vector<std::string>& commands) {
  leave_own_console();
  if (!options.screenshot.empty() && options.frames == 0)
    throw UsageError("--screenshot: writes the last frame; add --frames N");
  if (is_standard_output(options.session_report))
    throw UsageError("--session-report -: the report is rewritten continuously; name a file");
  const PictureSize size = options.size.empty() ? PictureSize{0, 0} : parse_size(options.size, smallest_window);
  if (!options.lab.empty()) {
    const int steps = int(load_lab(find_lab_file(options.lab)).steps.size());
    if (options.lab_step > steps)
      throw UsageError("--lab-step: " + std::to_string(options.lab_step) + " is not allowed; allowed: 1 to " +
                       std::to_string(steps));
  }
  if (options.lab.empty() && options.lab_step > 0)
    throw UsageError("--lab-step: name the lab, as in --lab 03_stiffness");
  const ResolvedPreset scene = options.preset.resolve(default_preset, commands);
  check_record(options.record);
  const std::vector<Output> outputs = options.outputs();
  check_outputs(outputs, scene.inputs());
  SandboxOptions sandbox;
  sandbox.preset = scene.preset;
  sandbox.preset_label = scene.source.label;
  sandbox.experiment = scene.experiment;
  if (!scene.experiment && scene.source.file.parent_path() != find_preset(default_preset).file.parent_path())
    sandbox.preset_path = scene.source.file;
  sandbox.explicit_preset = options.preset.typed();
  sandbox.threads = scene.threads;
  sandbox.auto_dt = scene.auto_dt;
  sandbox.frames = options.frames;
  sandbox.width = size.width, sandbox.height = size.height;
  sandbox.screenshot = options.screenshot;
  sandbox.time_report = options.time_report;
  sandbox.session_report = options.session_report, sandbox.record = options.record;
  if (options.effects == "auto") sandbox.effects = Effects::Mode::automatic;
  if (options.effects == "all") sandbox.effects = Effects::Mode::all;
  if (options.effects == "few") sandbox.effects = Effects::Mode::few;
  sandbox.color = field_called(options.color);
  sandbox.lab = options.lab, sandbox.lab_step = options.lab_step, sandbox.panels = !options.no_panels;
  if (display_there()) return run_sandbox(sandbox);
  if (scene.experiment || !options.record.empty())
    throw UsageError(
        "There is no display for a window. `tyglab run` and `tyglab render` repeat experiments, and `tyglab run "
        "--record` "
        "writes them");
  if (!options.session_report.empty()) std::cerr << "--session-report describes a window, so no report is written.\n";
  if (!options.lab.empty()) std::cerr << "--lab starts a lab in a window, so it has no effect here.\n";
  return run_headless(sandbox, people(outputs));
}

/// Throws for an option of the window that was typed before a command.
void refuse_before_command(const CLI::App& program) {
  const CLI::App* command = &program;
  std::string words = "tyglab";
  while (!command->get_subcommands().empty()) {
    command = command->get_subcommands().front();
    words += " " + command->get_name();
  }
  for (const CLI::Option* option : program.get_options()) {
    if (option->count() == 0) continue;
    const std::string name = option->get_name();
    throw CLI::ValidationError(name, command->get_option_no_throw(name) != nullptr
                                         ? "comes before the command; put it after the command"
                                         : "belongs to the window, and `" + words + "` does not accept it; omit it");
  }
}

}  // namespace

void add_sandbox_command(CLI::App& program, Action& action) {
  auto options = std::make_shared<Options>();
  options->preset.add_to(program, false);
  program.add_option("--frames", options->frames, "Exit after N frames")
      ->type_name("N")
      ->transform(whole_number_between(1, 1'000'000'000));
  program
      .add_option("--size", options->size,
                  "Size of the window in pixels; default with --frames: the screen's, up to 2560x1440")
      ->type_name("WxH")
      ->check(not_empty());
  add_output(program, "--screenshot", options->screenshot, "Write the last of --frames as an image")
      ->type_name("F.png");
  add_output(program, "--time-report", options->time_report, "Write the time of a frame, by part, as JSON")
      ->type_name("F.json");
  add_output(program, "--session-report", options->session_report,
             "Write the state of the window about ten times per second as JSON (docs/session-report.md)")
      ->type_name("F.json");
  add_output(program, "--record", options->record,
             "Write what was done since the preset was opened as an experiment, when the window closes;\n"
             "`tyglab F.tyglab` repeats it")
      ->type_name("F.tyglab");
  program
      .add_option("--effects", options->effects,
                  "Soft shadows and smooth edges: auto turns off what this machine draws too slowly")
      ->type_name("auto|all|few")
      ->check(CLI::IsMember({"auto", "all", "few"}).description(""));
  add_color_option(program, options->color, true);
  program.add_option("--lab", options->lab, "Start a lab, by its name in `tyglab labs`")
      ->type_name("NAME")
      ->check(not_empty());
  program.add_option("--lab-step", options->lab_step, "Start the lab at step N")
      ->type_name("N")
      ->transform(whole_number_between(1, 1'000));
  program.add_flag("--no-panels", options->no_panels, "Show the cloth alone, as Tab does");
  program.callback([options, &action, &program] {
    if (program.get_subcommands().empty()) {
      action = [options, commands = command_names(program)] { return open_sandbox(*options, commands); };
      return;
    }
    refuse_before_command(program);
  });
}

}  // namespace tyglab
