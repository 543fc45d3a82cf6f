#include "app/session/document.h"

#include "app/base/data_files.h"
#include "app/ui/app.h"
#include "app/ui/frame/dialogs.h"
#include "core/io/files.h"
#include "core/io/preset_io.h"
#include "core/model/readable.h"

namespace tyglab {
namespace {

Preset on_cpu(Preset preset) {
  preset.engine = EngineKind::cpu;
  return preset;
}

void take_picture(App& app, const FoundPicture& picture) {
  app.redraw_cloth = true;
  if (const auto* why = std::get_if<std::string>(&picture)) return app.messages.error(*why);
  if (const auto problem = app.renderer->set_texture(std::get<ClothPicture>(picture))) app.messages.error(*problem);
}

/// The middle of the cloth, so that there is something to read at once.
std::optional<Pins::Site> first_pick(const App& app) {
  const Lattice& lattice = app.simulation->lattice();
  return Pins::Site{lattice.rows / 2, lattice.columns / 2};
}

}  // namespace

FoundPicture find_picture(const Preset& preset) {
  try {
    return read_picture(texture_file(preset.texture));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

void begin_document(App& app, const Document& document, const FoundPicture& picture) {
  app.document = document;
  take_picture(app, picture);
  app.history.clear(), app.rewind.clear(), app.figure.clear(), app.auto_dt.reset();
  app.picked = first_pick(app);
  app.tool = Tool{};
  app.ui.plots.forces.clear(), app.ui.plots.height.clear();
  app.ui.slider = SliderState{};
  app.ui.wind_arrow.reset();
  app.ui.constants_to_top = true;
  app.pacing.forget_cost(), app.pacing.restart_measure();
  app.wants_framing = true;
}

std::unique_ptr<Simulation> make_simulation(const Preset& preset, int threads, std::string& fallback) {
  try {
    return std::make_unique<Simulation>(preset, threads);
  } catch (const EngineError& error) {
    if (preset.engine == EngineKind::cpu) throw;
    fallback = sentence(error.what()) + " So the CPU runs it.";
    return std::make_unique<Simulation>(on_cpu(preset), threads);
  }
}

void take_built(App& app, std::unique_ptr<Simulation> simulation, const BuildOrder& order) {
  const Preset before = app.preset();
  swap_in(app, std::move(simulation));
  if (order.document) return begin_document(app, *order.document, find_picture(app.preset()));
  follow_up(app, before);
  if (!order.fresh) return;
  app.ui.plots.forces.clear(), app.ui.plots.height.clear();
  app.pacing.restart_measure();
}

void open_document(App& app, const std::filesystem::path& file, bool shipped,
                   const std::vector<std::string>& settings) {
  try {
    const Preset preset = with_settings(load_preset(file), settings);
    const Document document{preset, file.stem().string(), shipped ? std::filesystem::path() : file};
    if (takes_long(app, preset) && preset.engine == EngineKind::cpu)
      return app.building.order(app, {preset, true, false, document}, app.history);
    std::string fallback;
    auto simulation = make_simulation(preset, app.threads, fallback);
    if (!fallback.empty()) app.messages.warning(fallback);
    app.building.drop();
    take_built(app, std::move(simulation), {preset, true, false, document});
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
    // The program's own folder is made where it is missing; nobody else's.
    std::error_code ignored;
    const std::filesystem::path folder = file.parent_path();
    if (folder == user_preset_folder()) std::filesystem::create_directories(folder, ignored);
    if (!folder.empty() && !std::filesystem::is_directory(folder, ignored))
      throw OutputError("The folder " + folder.string() + " is not there; make it first, or choose another.");
    save_preset(preset, file);
  } catch (const std::exception& error) {
    show_save_problem(app, file, name, error.what());
    return false;
  }
  app.building.rename(name);
  if (!app.building.holds_present()) apply_to_all(app, edit::Change{preset});
  if (app.labs.opened == app.document.label) app.labs.opened = file.stem().string();  // it is the lab's cloth still
  app.document = {preset, file.stem().string(), file};
  app.messages.note("Saved " + file.string());
  return true;
}

}  // namespace tyglab
