#include "app/session/requests.h"

#include <algorithm>

#include "app/base/numbers.h"
#include "app/session/document.h"
#include "app/tools/wind_arrow.h"
#include "app/ui/app.h"
#include "app/ui/cards/cards.h"
#include "app/ui/frame/dialogs.h"
#include "app/ui/frame/exports.h"
#include "app/ui/frame/palette.h"
#include "app/ui/frame/tour.h"
#include "core/cloth/start.h"
#include "core/engines/opencl/opencl_devices.h"
#include "core/integrators/scheme.h"

namespace tyglab {
namespace {

/// Above this many particles a frame may take seconds, so the user is asked first.
constexpr double large_cloth = 1e6;

void restart(App& app) {
  if (!apply_edit(app, edit::Restart{})) return;
  app.ui.plots.forces.clear(), app.ui.plots.height.clear();
  app.pacing.restart_measure();
}

constexpr double rewinds_s = 1;

/// Goes a second back; the plots forget what has not happened. False where there is nothing to go back to.
bool rewind(App& app) {
  const double t = app.simulation->time();
  if (app.building.holds_present() || app.rewind.before(*app.simulation, t, rewinds_s) == nullptr) return false;
  app.rewind.go_back(*app.simulation, t, rewinds_s);
  copies_resume(app);
  if (!app.copies.lockstep.empty())
    app.messages.note("The copies have no past of their own: they go on from here too.");
  app.tool.kind = Tool::Kind::none;
  app.ui.plots.forces.clear(), app.ui.plots.height.clear();
  app.pacing.restart_measure();
  return true;
}

/// Takes constants that stood before. An automatic dt stays so only if it is the one that would be chosen for them.
bool take_back(App& app, const Preset& preset) {
  if (app.auto_dt && preset.dt != AutoStep::choose(preset)) app.auto_dt.reset();
  return apply_edit(app, edit::Change{preset});
}

void take_from_history(App& app, bool backwards) {
  const auto preset = backwards ? app.history.undo(app.requested_preset()) : app.history.redo(app.requested_preset());
  if (!preset) {
    app.messages.note(backwards ? "There is nothing to undo." : "There is nothing to redo.");
    return;
  }
  History kept = app.history;
  Preset next = *preset;
  next.mode = app.requested_preset().mode;  // the view is not a change to undo
  take_back(app, next);
  app.history = std::move(kept);
}

void toggle_auto(App& app) {
  if (app.auto_dt) return app.auto_dt.reset();
  Preset next = app.requested_preset();
  const auto dt = AutoStep::choose(next);
  if (!dt) {
    app.messages.error(next.integrator + " has no stable dt with these constants. Take another method, or more k_d.");
    return;
  }
  next.dt = *dt;
  if (next == app.requested_preset() || apply_edit(app, edit::Change{next})) app.auto_dt.emplace();
}

/// dt follows the other constants while it is automatic; who sets it by hand takes it over.
void follow_constants(App& app, Preset& next) {
  if (!app.auto_dt) return;
  const auto dt = AutoStep::choose(next);
  if (next.dt != app.requested_preset().dt || !dt) {
    app.auto_dt.reset();
    app.messages.note(dt ? "dt is set by hand again."
                         : next.integrator + " has no stable dt: dt is set by hand again.");
    return;
  }
  app.auto_dt->begin();
  Preset as = app.requested_preset();
  as.mode = next.mode, as.texture = next.texture, as.name = next.name, as.description = next.description;
  if (as != next) next.dt = *dt;  // what is only seen changes no limit, and a halved dt stays
}

/// Another method that no OpenCL device runs brings the CPU engine with it. Returns what is to be said of that.
std::string take_engine_along(const App& app, Preset& next) {
  if (next.engine == EngineKind::cpu || next.integrator == app.requested_preset().integrator) return {};
  const Scheme& method = scheme(next.integrator);
  if (runs_on_opencl(method)) return {};
  next.engine = EngineKind::cpu;
  return std::string(method.title) + " runs on the CPU engine alone, so that was taken.";
}

void toggle_cut_path(App& app) {
  bool& along = app.settings.handling.cut_along_path;
  along = !along;
  app.messages.note(along ? "A left drag cuts every spring that its path crosses."
                          : "A left drag cuts the springs upwards of the particles near it, as in the report.");
}

void toggle_slow_hand(App& app) {
  bool& slow = app.settings.handling.slow_hand;
  slow = !slow;
  app.messages.note(slow ? "While you grab or cut, time goes at a quarter of its speed."
                         : "Time goes at its speed while you grab or cut.");
}

void open_export(App& app, ExportSource source) {
  app.ui.dialog.source = source;
  open_dialog(app, Dialog::Kind::write_export);
}

void reset_everything(App& app) {
  app.auto_dt.reset();
  take_back(app, app.document.saved);
  restart(app);
  app.wants_framing = true;
}

void single_step(App& app) {
  app.pacing.playing = false;
  if (app.building.holds_present()) return;
  move_hand(app, 1);
  app.steps_made += app.simulation->advance(1).steps;
  copies_follow(app, 0);
}

void change_text_size(App& app, double factor) {
  const double scale = factor == 0 ? 1 : app.settings.ui_scale * factor;
  app.settings.ui_scale = std::clamp(scale, 0.5, 3.0);
  app.scale_changed = true;
}

/// Dark, light, projector, and again.
void next_theme(App& app) {
  const auto all = looks();
  const auto now = std::size_t(&look(app.settings.theme) - all.data());
  const Look& next = all[(now + 1) % all.size()];
  app.settings.theme = next.name;
  app.scale_changed = app.redraw_cloth = true;
}

/// Opens the card that shows it, where it is measured from the present moment on.
void show_convergence(App& app) {
  show_card(app, card_name::accuracy);
  app.convergence.drop();
  app.convergence.shown = true;
}

/// All effects however long they take, or as many as the machine draws in time.
void toggle_effects(App& app) {
  const bool all = app.effects.mode != Effects::Mode::all;
  app.effects.mode = all ? Effects::Mode::all : Effects::Mode::automatic;
  app.settings.all_effects = all;
}

/// Remembered for the next session.
void color_by(App& app, std::optional<ParticleField> field) {
  app.colors.choose(field);
  app.settings.color = field ? info(*field).name : "";
}

void apply(App& app, const request::Do& what) {
  switch (what.command) {
    case Command::restart:
      return restart(app);
    case Command::reset_constants:
      take_back(app, app.document.saved);
      return;
    case Command::reset_everything:
      return reset_everything(app);
    case Command::undo_and_restart:
      return take_from_history(app, true), restart(app);
    case Command::rewind:
      app.pacing.playing &= !app.simulation->divergence();
      if (!rewind(app)) app.messages.note("There is nothing earlier to go back to.");
      return;
    case Command::toggle_auto:
      return toggle_auto(app);
    case Command::choose_engine:
      return app.engine_search.begin(app);
    case Command::toggle_play:
      app.pacing.playing = !app.pacing.playing, app.pacing.restart_measure();
      return;
    case Command::step:
      return single_step(app);
    case Command::undo:
      return take_from_history(app, true);
    case Command::redo:
      return take_from_history(app, false);
    case Command::frame_cloth:
      app.wants_framing = true;
      return;
    case Command::open_dialog:
      return open_dialog(app, Dialog::Kind::open);
    case Command::save:
      return save_document(app);
    case Command::save_as:
      return open_dialog(app, Dialog::Kind::save);
    case Command::load_texture_dialog:
      return open_dialog(app, Dialog::Kind::texture);
    case Command::export_forces:
      return open_export(app, ExportSource::forces);
    case Command::export_height:
      return open_export(app, ExportSource::height);
    case Command::toggle_help:
      app.ui.help = !app.ui.help;
      return;
    case Command::open_palette:
      return open_palette(app);
    case Command::choose_lab:
      return open_palette(app, true);
    case Command::leave_lab:
      return leave_lab(app);
    case Command::start_tour:
      return start_tour(app);
    case Command::toggle_panels:
      app.ui.panels = !app.ui.panels;
      return;
    case Command::toggle_map:
      return toggle_card(app, card_name::map, &Layout::map, app.ui.map_shown);
    case Command::toggle_inside:
      return toggle_card(app, card_name::step, &Layout::inside, app.ui.inside_shown);
    case Command::show_forces:
      return show_card(app, card_name::forces);
    case Command::show_height:
      return show_card(app, card_name::height);
    case Command::show_distances:
      return show_card(app, card_name::distances);
    case Command::show_copies:
      return show_card(app, card_name::copies);
    case Command::show_stability:
      return show_card(app, card_name::stability);
    case Command::show_accuracy:
      return show_card(app, card_name::accuracy);
    case Command::show_energy:
      return show_card(app, card_name::energy);
    case Command::show_performance:
      return show_card(app, card_name::performance);
    case Command::toggle_cut_path:
      return toggle_cut_path(app);
    case Command::toggle_wind_arrow:
      app.ui.wind_arrow = !wind_arrow_shown(app);
      return;
    case Command::toggle_slow_hand:
      return toggle_slow_hand(app);
    case Command::export_map:
      return open_export(app, ExportSource::map);
    case Command::export_map_picture:
      return open_export(app, ExportSource::map_picture);
    case Command::export_copies:
      return open_export(app, ExportSource::copies);
    case Command::export_values:
      return open_export(app, ExportSource::values);
    case Command::export_mesh:
      if (app.preset().kind != Kind::cloth) return app.messages.note("An OBJ holds cloth, and this is one weight.");
      return open_export(app, ExportSource::mesh);
    case Command::export_state:
      return open_export(app, ExportSource::state);
    case Command::export_convergence:
      return open_export(app, ExportSource::convergence);
    case Command::measure_convergence:
      return show_convergence(app);
    case Command::toggle_effects:
      return toggle_effects(app);
    case Command::save_picture:
      return open_dialog(app, Dialog::Kind::picture);
    case Command::next_color:
      return color_by(app, next_field(app));
    case Command::full_screen:
      app.toggle_full_screen = true;
      return;
    case Command::larger_text:
      return change_text_size(app, 1.1);
    case Command::smaller_text:
      return change_text_size(app, 1 / 1.1);
    case Command::normal_text:
      return change_text_size(app, 0);
    case Command::next_theme:
      return next_theme(app);
    case Command::quit:
      app.request(request::Quit{});
      return;
  }
}

void apply(App& app, const request::Apply& what) {
  if (const auto* change = std::get_if<edit::Change>(&what.edit); change != nullptr && !what.confirmed) {
    const double count = particles(change->preset), now = particles(app.requested_preset());
    if (count > large_cloth && count > 1.001 * now) {
      request::Apply agreed = what;
      agreed.confirmed = true;
      const std::string size = std::to_string(change->preset.rows) + " × " + std::to_string(change->preset.columns);
      ask(app, Dialog::Kind::large_cloth,
          size + " is " + short_number(count / 1e6, 3) +
              " million particles. A frame may then take seconds. Build it all the same?",
          std::move(agreed));
      return;
    }
  }
  Edit edit = what.edit;
  std::string note;
  if (auto* change = std::get_if<edit::Change>(&edit)) {
    note = take_engine_along(app, change->preset);
    follow_constants(app, change->preset);
  }
  if (apply_edit(app, edit, what.gesture) && !note.empty()) app.messages.note(std::move(note));
  app.ui.last_change = app.ui.now;
}

void apply(App& app, const request::Retry& what) {
  const bool back = rewind(app);
  if (take_back(app, what.preset) && !back) restart(app);
}

void apply(App& app, const request::Open& what) {
  if (!what.confirmed && unsaved(app)) {
    request::Open agreed = what;
    agreed.confirmed = true;
    ask(app, Dialog::Kind::unsaved, "The changes of " + app.preset().name + " have not been saved.", std::move(agreed));
    return;
  }
  open_document(app, what.file, what.shipped, what.settings);
}

bool apply(App& app, const request::SavePreset& what) {
  return save_document_as(app, what.file, what.name);
}

void apply(App& app, const request::WriteExport& what) {
  try {
    export_of(what.source).write(app, what.file);
    app.messages.note("Wrote " + what.file.string());
  } catch (const std::runtime_error& error) {
    app.messages.error(error.what());
  }
}

void apply(App& app, const request::LoadTexture& what) {
  Preset next = app.requested_preset();
  next.texture = what.name;
  apply_edit(app, edit::Change{next});
}

void apply(App& app, const request::AddCopy& what) {
  add_copy(app, what.differences, what.as_reference);
}

void apply(App& app, const request::RemoveCopy& what) {
  remove_copy(app, what.index);
}

void apply(App& app, const request::ColorBy& what) {
  color_by(app, what.field);
}

/// Taken where the frame is drawn.
void apply(App& app, const request::SavePicture& what) {
  app.picture = what;
}

void apply(App& app, const request::Quit& what) {
  if (!what.confirmed && !app.scripted && unsaved(app)) {
    ask(app, Dialog::Kind::unsaved, "The changes of " + app.preset().name + " have not been saved.",
        request::Quit{.confirmed = true});
    return;
  }
  app.quit = true;
}

}  // namespace

bool unsaved(const App& app) {
  Preset saved = app.document.saved;
  saved.mode = app.requested_preset().mode;
  return !(saved == app.requested_preset());  // what is still being built would be lost as well
}

bool changed_since_divergence(const App& app) {
  if (!app.simulation->divergence()) return false;
  return !same_model(app.simulation->diverged_preset(), app.preset());
}

bool same_model(Preset a, const Preset& b) {
  a.mode = b.mode, a.texture = b.texture, a.name = b.name, a.description = b.description;
  a.engine = b.engine, a.device = b.device, a.precision = b.precision;
  return a == b;
}

void watch_dt(App& app) {
  const auto dt = app.auto_dt->look(app.preset(), app.simulation->time(), *app.simulation->ledger());
  if (!dt) return;
  Preset next = app.preset();
  next.dt = *dt;
  apply_edit(app, edit::Change{next});
  app.messages.note(next.integrator + " was making energy: dt is halved to " + short_number(*dt) + " s.");
}

void apply_requests(App& app) {
  // What these requests ask for in turn (a dialog, quitting) is applied in the next frame.
  const std::vector<Request> requests = std::move(app.requests);
  app.requests.clear();
  for (const Request& request : requests) {
    // What was to follow a saving (another preset, the end) does not where the saving failed: nothing may be lost.
    if (const auto* save = std::get_if<request::SavePreset>(&request)) {
      if (!apply(app, *save)) return;
      continue;
    }
    std::visit([&](const auto& what) { apply(app, what); }, request);
  }
}

}  // namespace tyglab
