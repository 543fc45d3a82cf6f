#include "app/sandbox/document.h"

#include "app/data_files.h"
#include "app/panels/dialogs.h"
#include "app/sandbox/app.h"
#include "core/notation/preset_io.h"

namespace tyglab {
namespace {

Preset on_cpu(Preset preset) {
  preset.engine = EngineKind::cpu;
  return preset;
}

void say_fallback(App& app, const char* reason) {
  app.messages.warning(std::string(reason) + " The CPU runs it instead.");
}

void load_texture(App& app) {
  app.redraw_cloth = true;
  if (const auto problem = app.renderer->set_texture(texture_file(app.preset().texture))) app.messages.error(*problem);
}

/// The middle of the cloth, so that there is something to read at once.
std::optional<Pins::Site> first_pick(const App& app) {
  const Lattice& lattice = app.simulation->lattice();
  return Pins::Site{lattice.rows / 2, lattice.columns / 2};
}

void begin(App& app) {
  app.history.clear();
  app.picked = first_pick(app);
  app.tool = Tool{};
  app.ui.plots.forces.clear(), app.ui.plots.height.clear();
  app.ui.slider = SliderState{};
  app.ui.constants_to_top = true;
  app.pacing.forget_cost(), app.pacing.restart_measure();
  app.wants_framing = true;
}

}  // namespace

void make_simulation(App& app, const Preset& preset) {
  try {
    app.simulation = std::make_unique<Simulation>(preset, app.threads);
  } catch (const EngineError& error) {
    if (preset.engine == EngineKind::cpu) throw;
    say_fallback(app, error.what());
    app.simulation = std::make_unique<Simulation>(on_cpu(preset), app.threads);
  }
}

void take_document(App& app, const Preset& preset) {
  const auto take = [&](const Preset& which) {
    app.simulation->apply(edit::Change{which});
    app.simulation->apply(edit::Restart{});
  };
  try {
    take(preset);
  } catch (const EngineError& error) {
    if (preset.engine == EngineKind::cpu) throw;
    take(on_cpu(preset));
    say_fallback(app, error.what());
  }
  app.document.saved = preset;
  load_texture(app);
  begin(app);
}

void open_document(App& app, const std::filesystem::path& file, bool shipped) {
  try {
    const Preset preset = load_preset(file);
    take_document(app, preset);
    app.document.label = file.stem().string();
    app.document.file = shipped ? std::filesystem::path() : file;
  } catch (const std::bad_alloc&) {
    app.messages.error("There is not enough memory for " + file.string() + ". The old cloth stays.");
  } catch (const std::exception& error) {
    app.messages.error(error.what());
  }
}

void save_document(App& app) {
  if (app.document.file.empty()) return open_dialog(app, Dialog::Kind::save);
  save_document_as(app, app.document.file, app.preset().name);
}

bool save_document_as(App& app, const std::filesystem::path& file, const std::string& name) {
  Preset preset = app.preset();
  preset.name = name;
  try {
    if (const std::string wrong = check_preset(preset); !wrong.empty()) throw PresetError(wrong);
    std::error_code ignored;
    if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), ignored);
    save_preset(preset, file);
  } catch (const std::exception& error) {
    show_save_problem(app, file, name, error.what());
    return false;
  }
  app.simulation->apply(edit::Change{preset});
  app.document = {preset, file.stem().string(), file};
  app.messages.note("Saved " + file.string());
  return true;
}

}  // namespace tyglab
