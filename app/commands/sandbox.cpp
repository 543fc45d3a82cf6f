#include "app/commands/sandbox.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <cstdlib>
#include <iostream>
#include <memory>

#include "app/commands/headless.h"
#include "app/commands/preset_argument.h"
#include "app/sandbox/sandbox.h"

namespace tyglab {
namespace {

constexpr auto default_preset = "hanging";

struct Options {
  PresetArgument preset;
  int frames = 0;
  std::string screenshot, time_report, session_report;
};

/// Whether a window can be opened. Without a display's name GLFW is not asked: its libraries complain on stderr.
bool has_display() {
  const bool named = std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
  return named && glfwInit() == GLFW_TRUE;
}

int open_sandbox(const Options& options) {
  for (const std::string& file : {options.screenshot, options.time_report, options.session_report})
    if (!file.empty()) require_writable(file);
  const ResolvedPreset scene = options.preset.resolve(default_preset);
  SandboxOptions sandbox;
  sandbox.preset = scene.preset;
  sandbox.preset_label = scene.source.label;
  if (scene.source.file.parent_path() != find_preset(default_preset).file.parent_path())
    sandbox.preset_path = scene.source.file;
  sandbox.explicit_preset = options.preset.typed();
  sandbox.frames = options.frames;
  sandbox.screenshot = options.screenshot;
  sandbox.time_report = options.time_report;
  sandbox.session_report = options.session_report;
  if (has_display()) return run_sandbox(sandbox);
  std::cerr << "There is no display here, so Tyglab works without a window: it simulates and draws '"
            << scene.source.label << "' into the folder tyglab-out.\n";
  if (!options.session_report.empty())
    std::cerr << "--session-report tells what goes on in a window, so it is not written.\n";
  return run_headless(sandbox);
}

}  // namespace

void add_sandbox_command(CLI::App& program, Action& action) {
  auto options = std::make_shared<Options>();
  options->preset.add_to(program, false);
  program.add_option("--frames", options->frames, "End after N frames")
      ->type_name("N")
      ->check(between(1, 1'000'000'000));
  program.add_option("--screenshot", options->screenshot, "Write the last frame as a picture")->type_name("F.png");
  program.add_option("--time-report", options->time_report, "Write what a frame costs, by part, as JSON")
      ->type_name("F.json");
  program
      .add_option("--session-report", options->session_report,
                  "Write what goes on in the window, about ten times a second, as JSON (docs/session-report.md)")
      ->type_name("F.json");
  program.callback([options, &action, &program] {
    if (program.get_subcommands().empty()) {
      action = [options] { return open_sandbox(*options); };
      return;
    }
    for (const CLI::Option* option : program.get_options())
      if (option->count() > 0)
        throw CLI::ValidationError(option->get_name(), "stands before the command; put it after its name");
  });
}

}  // namespace tyglab
