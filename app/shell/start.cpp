#include "app/shell/start.h"

#include "app/base/files.h"
#include "app/platform/platform.h"
#include "app/process/program_run.h"
#include "app/session/document.h"
#include "core/engines/opencl/opencl_devices.h"
#include "core/io/output_file.h"

namespace tyglab {

Settings settings_for(const SandboxOptions& options, Messages& messages) {
  std::string problem;
  if (options.frames > 0) return {};
  Settings settings = load_settings(problem);
  if (!problem.empty()) {
    messages.warning(problem);
    return settings;
  }
  try {
    save_settings(settings, settings);  // now, while there is somebody to read that it does not work
  } catch (const OutputError& error) {
    messages.warning(std::string(error.what()) +
                     ". The settings of this session will not be remembered. Make the folder writable, or name another "
                     "one in TYGLAB_CONFIG_DIR.");
  }
  return settings;
}

void take_options(const SandboxOptions& options, Ui& ui) {
  Session& session = ui.session;
  Scene& scene = ui.scene;
  session.scripted = options.frames > 0;
  session.threads = options.threads;
  session.labs.progress = ui.settings.labs;
  if (!ui.settings.tour_seen && prefers_light()) ui.settings.theme = "light";
  if (prefers_little_motion()) session.pacing.playing = false;
  // A scripted window is as large as the screen allows, so that a virtual screen sets the size of its picture.
  if (session.scripted) ui.settings.width = 2560, ui.settings.height = 1440;
  ui.plots.log = ui.settings.plot_log;
  const bool all = session.scripted || ui.settings.all_effects;  // the same frames come on every machine
  scene.effects.mode = options.effects.value_or(all ? Effects::Mode::all : Effects::Mode::automatic);
  scene.colors.choose(options.color ? options.color : field_called(ui.settings.color));
  if (options.color)
    if (const std::string why = why_not_colored(scene, *options.color); !why.empty())
      session.messages.note("The cloth is not colored yet. " + why);
}

void remember_session(Ui& ui) {
  const Session& session = ui.session;
  Settings& settings = ui.settings;
  settings.labs = session.labs.progress;
  settings.plot_log = ui.plots.log;
  // Of a lab nothing is kept but the progress; the experiment before it is.
  if (session.labs.run && !session.labs.kept.empty()) {
    const KeptExperiment& kept = session.labs.kept.back();
    settings.session = LastSession{kept.constants, kept.document.saved, kept.document.label, kept.document.file};
    return;
  }
  // Who quit with unsaved changes has said that they may go; a session that was interrupted brings them back.
  Preset last = session.quit ? session.document.saved : session.requested_preset();
  last.mode = session.preset().mode;
  const Document& document = session.document;
  settings.session = LastSession{std::move(last), document.saved, document.label, document.file};
}

FoundPicture find_picture(const std::string& texture) {
  try {
    return read_picture(texture_file(texture));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

InitialScene build_initial_scene(const Preset& preset, int threads, bool whole) {
  InitialScene scene;
  scene.picture_file = stamp_of(texture_file(preset.texture));
  scene.picture = find_picture(preset.texture);
  if (!whole && preset.engine != EngineKind::cpu) {
    Preset shown = preset;
    shown.engine = EngineKind::cpu;
    scene.simulation = make_simulation(shown, threads, scene.fallback);
    return scene;
  }
  const bool needs_window = preset.engine == EngineKind::opencl && opencl_offers_gl_sharing(preset.device);
  if (!needs_window) {
    scene.simulation = make_simulation(preset, threads, scene.fallback);
    run_programs_once(scene.simulation->preset(), false);  // the first frames do not wait
  }
  return scene;
}

}  // namespace tyglab
