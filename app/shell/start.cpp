#include "app/shell/start.h"

#include "core/io/files.h"

namespace tyglab {
namespace {

Settings settings_for(const SandboxOptions& options, App& app) {
  std::string problem;
  if (options.frames > 0) return {};
  Settings settings = load_settings(problem);
  if (!problem.empty()) {
    app.messages.warning(problem);
    return settings;
  }
  try {
    save_settings(settings);  // now, while there is somebody to read that it does not work
  } catch (const OutputError& error) {
    app.messages.warning(std::string(error.what()) +
                         ". This session's settings will not be remembered. Make the folder writable, or name another "
                         "one in TYGLAB_CONFIG_DIR.");
  }
  return settings;
}

}  // namespace

App start_app(const SandboxOptions& options) {
  App app;
  app.scripted = options.frames > 0;
  app.threads = options.threads;
  app.settings = settings_for(options, app);
  // A scripted window is as large as the screen allows, so that a virtual screen sets the size of its picture.
  if (app.scripted) app.settings.width = 2560, app.settings.height = 1440;
  app.ui.plots.log = app.settings.plot_log;
  const bool all = app.scripted || app.settings.all_effects;  // the same frames come on every machine
  app.effects.mode = options.effects.value_or(all ? Effects::Mode::all : Effects::Mode::automatic);
  app.colors.choose(options.color ? options.color : field_called(app.settings.color));
  if (options.color)
    if (const std::string why = why_not_colored(app, *options.color); !why.empty())
      app.messages.note("The cloth is not coloured yet. " + why);
  app.costs.started(StartPart::settings);
  if (!options.session_report.empty()) app.report = std::make_unique<SessionReport>(options.session_report);
  return app;
}

}  // namespace tyglab
