#include "tests/bench/session_report.h"
#include "app/ui/cards/cards.h"

#include <imgui.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "app/tools/tools.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/state/ui.h"
#include "core/io/output_file.h"
#include "core/io/preset_io.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::chrono::milliseconds period{90};
constexpr int samples = 5;  ///< rows and columns of particles that are reported, corners included

Json vector(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

/// Pixels in the window, or null behind the camera.
Json on_screen(const Ui& ui, const glm::dvec3& x) {
  const auto at = ui.scene.camera.project(x, ui.viewport.size());
  if (!at) return nullptr;
  return {at->x + ui.viewport.box.lo.x, at->y + ui.viewport.box.lo.y};
}

Json site(const std::optional<Pins::Site>& site) {
  return site ? Json{site->i, site->j} : Json(nullptr);
}

Json particle(const Ui& ui, int i, int j) {
  const glm::dvec3 x = ui.session.simulation->position(i, j);
  return {
      {"i", i}, {"j", j}, {"x", vector(x)}, {"at", on_screen(ui, x)}, {"pinned", ui.session.simulation->pinned(i, j)}};
}

std::set<int> sample_of(int count) {
  std::set<int> indices;
  for (int k = 0; k < samples; ++k) indices.insert(k * (count - 1) / (samples - 1));
  return indices;
}

Json particles(const Ui& ui) {
  Json list = Json::array();
  const Lattice& lattice = ui.session.simulation->lattice();
  for (const int i : sample_of(lattice.rows))
    for (const int j : sample_of(lattice.columns)) list.push_back(particle(ui, i, j));
  return list;
}

Json bodies(const Ui& ui) {
  Json list = Json::array();
  for (const Body& body : ui.session.preset().bodies)
    list.push_back({{"shape", name_of(body.shape)}, {"c", vector(body.c)}, {"at", on_screen(ui, body.c)}});
  return list;
}

Json held(const Ui& ui) {
  const auto held = ui.session.simulation->held();
  if (!held) return nullptr;
  Json json = particle(ui, held->i, held->j);
  json["force_N"] = vector(ui.session.simulation->hand_force());
  return json;
}

Json divergence(const Ui& ui) {
  const auto& d = ui.session.simulation->divergence();
  if (!d) return nullptr;
  return {{"t", d->t},         {"step", d->step},         {"i", d->i},
          {"j", d->j},         {"quantity", d->quantity}, {"value", d->value},
          {"cause", d->cause}, {"remedy", d->advice},     {"constants_changed", changed_since_divergence(ui.session)}};
}

/// What the gauge under dt shows; infinity cannot be said in JSON.
Json dt_over_limit(const Ui& ui) {
  const auto& limits = ui.session.studies.stability.limits();
  return limits && limits->any > 0 && std::isfinite(limits->any) ? Json(ui.session.preset().dt / limits->any)
                                                                 : Json(nullptr);
}

/// The ledger; null while none is kept.
Json energy(const Ui& ui) {
  const auto ledger = ui.session.simulation->ledger();
  if (!ledger) return nullptr;
  Json json = Json::object();
  for (const EnergyRow& row : energy_rows(*ledger, ui.session.preset())) json[std::string(row.name)] = row.joule;
  json["share"] = ledger->share();
  return json;
}

/// What the accuracy card knows; null while it is closed.
Json accuracy(const Ui& ui) {
  const auto study = ui.session.studies.accuracy.study();
  if (!study) return nullptr;
  Json json = {{"seconds", study->reference.seconds}, {"points", study->points.size()}, {"done", study->done}};
  const auto& present = study->present;
  json["error_rms_m"] = present && std::isfinite(present->error_rms_m) ? Json(present->error_rms_m) : Json(nullptr);
  return json;
}

/// What is known of the order of convergence; null while nothing is.
Json convergence(const Ui& ui) {
  const auto study = ui.session.studies.convergence.study();
  if (!study) return nullptr;
  const auto order = measured_order(*study);
  return {{"points", study->points.size()},
          {"t", study->t},
          {"order", order ? Json(order->order) : Json(nullptr)},
          {"done", study->done}};
}

/// The current lab; null without one.
Json lab(const Ui& ui) {
  if (!ui.session.labs.run) return nullptr;
  const LabRun& run = *ui.session.labs.run;
  const StepRecord& record = run.record();
  Json checks = Json::array();
  for (const CheckState state : record.checks) checks.push_back(state == CheckState::holds);
  return {{"label", run.lab.label},        {"step", run.step}, {"steps", run.lab.steps.size()},
          {"predicted", record.predicted}, {"checks", checks}, {"done", record.done},
          {"right", record.right}};
}

/// The copies in lockstep; a distance is reported where the card measures it.
Json copies(const Ui& ui) {
  Json list = Json::array();
  const Copies& copies = ui.session.copies;
  for (int n = 0; n < int(copies.lockstep.size()); ++n) {
    const Simulation& cloth = cloth_of(ui.session, n);
    Json copy = {{"name", settings_of_cloth(ui.session, n)}, {"t", cloth.time()}, {"steps", cloth.steps()}};
    const double apart = copies.distance.empty() ? NAN : copies.distance.column(std::size_t(n + 1)).back();
    copy["distance"] = std::isfinite(apart) ? Json(apart) : Json(nullptr);
    copy["diverged"] = cloth.divergence().has_value();
    copy["torn_springs"] = cloth.tears().torn_count();
    const auto held = cloth.held();
    copy["held"] = held ? Json{held->i, held->j} : Json(nullptr);
    list.push_back(copy);
  }
  return list;
}

/// What colors the cloth, and where its scale ends; null where nothing does.
Json colors(const Ui& ui) {
  const FieldColors* shown = shown_colors(ui.scene);
  if (shown == nullptr) return nullptr;
  const auto& marked = ui.scene.colors.under_pointer;
  return {{"field", info(shown->field).name},
          {"top", shown->top()},
          {"fixed", shown->fixed.has_value()},
          {"marked", marked ? Json(*marked) : Json(nullptr)}};
}

/// The step that is written out; null where none is.
Json inside(const Ui& ui) {
  const StepTrace* trace = ui.session.inspector.shown();
  if (trace == nullptr) return nullptr;
  const auto& stencils = trace->stages.front().stencils;
  return {{"site", {trace->i, trace->j}},
          {"evaluations", trace->stages.size()},
          {"springs",
           std::count_if(stencils.begin(), stencils.end(), [](const StencilForce& s) { return s.force->conserves; })},
          {"x", vector(trace->x_after)}};
}

int pinned_count(const Ui& ui) {
  const Lattice& lattice = ui.session.simulation->lattice();
  int count = 0;
  for (int i = 0; i < lattice.rows; ++i)
    for (int j = 0; j < lattice.columns; ++j) count += ui.session.simulation->pinned(i, j);
  return count;
}

/// The wind and its arrow; `tip` in pixels of the window, null where none is shown.
Json wind(const Ui& ui) {
  Json json = {{"W", vector(ui.session.preset().W)}, {"now", vector(ui.session.simulation->wind())}, {"tip", nullptr}};
  if (wind_arrow_shown(ui.tools)) json["tip"] = on_screen(ui, wind_arrow(ui.tools, requested_wind(ui.tools)).tip);
  return json;
}

Json handling(const Ui& ui) {
  const ToolSettings& handling = ui.settings.handling;
  return {{"cut_along_path", handling.cut_along_path},
          {"slow_hand", handling.slow_hand},
          {"arrows", handling.arrows},
          {"arrows_shown", ui.arrows}};
}

std::string_view name_of(Tool::Kind kind) {
  static constexpr std::string_view names[] = {"none", "orbit", "pan", "right", "grab", "cut", "body", "wind"};
  return names[std::size_t(kind)];
}

std::string_view name_of(Dialog::Kind kind) {
  static constexpr std::string_view names[] = {"none",    "start", "open",        "save",    "write_export", "texture",
                                               "picture", "film",  "course_page", "unsaved", "large_cloth"};
  return names[std::size_t(kind)];
}

void add_simulation(Json& json, const Ui& ui) {
  const Simulation& simulation = *ui.session.simulation;
  json["t"] = simulation.time();
  json["steps"] = simulation.steps();
  json["paused"] = !ui.session.pacing.playing;
  json["asleep"] = ui.session.asleep();
  json["speed"] = ui.session.pacing.speed;
  json["aim"] = ui.session.pacing.aim();
  json["wind"] = wind(ui);
  json["divergence"] = divergence(ui);
  json["dt_over_limit"] = dt_over_limit(ui);
  json["auto_dt"] = ui.session.auto_dt.has_value();
  json["energy"] = energy(ui);
  json["accuracy"] = accuracy(ui);
  json["convergence"] = convergence(ui);
  json["copies"] = copies(ui);
  const auto map = ui.session.studies.map.findings();
  json["map_cells"] = map ? Json(map->cells.size()) : Json(nullptr);
  json["copies_reference"] = ui.session.copies.reference;
  const auto next = ui.session.rebuild.lattice();
  json["building"] = next ? Json{next->rows, next->columns} : Json(nullptr);
  json["frames_while_building"] = ui.session.rebuild.frames_beside();
  json["label"] = ui.session.document.label;
  json["file"] = ui.session.document.file.string();
  json["unsaved"] = unsaved(ui.session);
  json["preset"] = Json::parse(preset_to_json(ui.session.preset()));
  json["torn_springs"] = simulation.tears().torn_count();
  json["pinned"] = pinned_count(ui);
  json["picked"] = site(ui.session.picked);
  json["picked_x"] =
      ui.session.picked ? vector(simulation.position(ui.session.picked->i, ui.session.picked->j)) : Json(nullptr);
  json["inside"] = inside(ui);
  json["held"] = held(ui);
  json["view"] = ui.session.preset().mode;
  json["colors"] = colors(ui);
  json["effects_left_out"] = ui.scene.effects.left_out();
}

void add_window(Json& json, const Ui& ui) {
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  const glm::vec2 at = ui.viewport.box.lo, size = ui.viewport.whole();
  json["window"] = {window.x, window.y};
  json["viewport"] = {at.x, at.y, size.x, size.y};
  json["pictures"] = {ui.viewport.columns, ui.viewport.rows};
  json["pointer"] = {ui.input.at.x, ui.input.at.y};
  json["tool"] = name_of(ui.tools.tool.kind);
  json["camera"] = {
      {"yaw", ui.scene.camera.yaw}, {"pitch", ui.scene.camera.pitch}, {"distance", ui.scene.camera.distance}};
  json["view_buttons"] = ui.viewport.buttons;
  json["tabs"] = ui.plots.cards;
  json["tab"] = ui.plots.tab;
  json["handling"] = handling(ui);
  json["theme"] = ui.settings.theme;
  const SliderState& slider = ui.slider;
  const bool starts =
      slider.typing_starts || ui.dialog.refused || ui.dialog.selecting || ui.lab_field.again;  // takes no keys yet
  json["typing"] = !starts && (slider.typing != 0 || gui::typing_text());
  json["dialog"] = name_of(ui.dialog.kind);
  json["problem"] = ui.dialog.problem;
  json["palette"] = ui.palette.open;
  json["tour"] = ui.tour.card;
  json["lab"] = lab(ui);
  Json messages = Json::array();
  for (const Message& message : ui.session.messages.list()) messages.push_back(message.text);
  json["messages"] = messages;
  Json marks = Json::object();
  for (const OverlayLayout::Mark& mark : ui.placing.marks()) {
    const glm::vec2 lo = mark.box.lo, extent = mark.box.hi - lo;
    marks[mark.name] = {lo.x, lo.y, extent.x, extent.y};
  }
  json["marks"] = marks;
}

}  // namespace

std::string SessionReport::json(const Ui& ui, bool ended) const {
  Json json;
  json["tyglab_session"] = 1;
  json["frames"] = frames_;
  json["events"] = events_;
  json["ended"] = ended;
  add_simulation(json, ui);
  add_window(json, ui);
  json["particles"] = particles(ui);
  json["bodies"] = bodies(ui);
  Json controls = Json::object();
  for (const auto& [name, box] : places_.shown()) {
    const glm::vec2 extent = box.hi - box.lo;
    controls[name] = {box.lo.x, box.lo.y, extent.x, extent.y};
  }
  json["controls"] = controls;
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

void SessionReport::end_frame(Ui& ui) {
  places_.end_frame();
  ++frames_;
  events_ += std::ssize(ui.input.keys);
  for (const PointerEvent& event : ui.input.pointer) events_ += event.type != PointerEvent::Type::move;
  if (failed_ || Clock::now() - written_ < period) return;
  try {
    write_atomically(file_, json(ui, false));
    written_ = Clock::now();
  } catch (const OutputError& error) {
    failed_ = true;
    ui.session.messages.error(std::string(error.what()) + ". The session report ends here.");
  }
}

void SessionReport::finish(const Ui& ui) {
  if (failed_) throw OutputError(file_.string() + ": the session report could not be written completely.");
  write_atomically(file_, json(ui, true));
}

}  // namespace tyglab
