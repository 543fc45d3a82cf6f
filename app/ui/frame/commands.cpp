#include "app/ui/frame/commands.h"

#include <imgui.h>
#include <algorithm>
#include <stdexcept>

#include "app/base/glfw_keys.h"
#include "app/session/document.h"
#include "app/session/motion.h"
#include "app/tools/wind_arrow.h"
#include "app/ui/cards/cards.h"
#include "app/ui/frame/dialogs.h"
#include "app/ui/frame/palette.h"
#include "app/ui/frame/panels.h"
#include "app/ui/frame/tour.h"
#include "core/model/notation.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

constexpr int control = GLFW_MOD_CONTROL, shift = GLFW_MOD_SHIFT;

template <void (*action)(Session&)>
void of_session(Ui& ui) {
  action(ui.session);
}
template <bool Ui::*flag>
void toggle(Ui& ui) {
  ui.*flag = !(ui.*flag);
}
template <Dialog::Kind kind>
void dialog(Ui& ui) {
  open_dialog(ui, kind);
}
template <const char* const& name>
void show(Ui& ui) {
  show_card(ui, name);
}
/// Of a card that is not always there: brings it into sight, or closes it where it is in sight already, which is where
/// what it wants is wanted.
template <const char* const& name, bool Layout::*there, bool Wants::*wants>
void toggle_card(Ui& ui) {
  bool& open = ui.settings.layout.*there;
  open = !(open && layout_wants(ui, ImGui::GetIO().DisplaySize).*wants);
  if (open) show_card(ui, name);
}

void toggle_play(Ui& ui) {
  Pacing& pacing = ui.session.pacing;
  pacing.playing = !pacing.playing;
  pacing.restart_measure();
}

std::string nothing_moves(const Ui& ui) {
  if (!ui.session.simulation->divergence() || ui.session.copies.lockstep.alive()) return "";
  return "The simulation has diverged: restart it (R), rewind it (←), or choose a way out in the banner.";
}

void step_once(Ui& ui) {
  single_step(ui.session, ui.tools.session_input().hand);
}

std::string nothing_earlier(const Ui& ui) {
  const Simulation& simulation = *ui.session.simulation;
  const bool there = ui.session.rewind.before(simulation, simulation.time(), 1) != nullptr;
  return there && !ui.session.rebuild.holds_present() ? "" : "There is no earlier state to rewind to.";
}

void rewind_a_second(Ui& ui) {
  ui.session.pacing.playing &= !ui.session.simulation->divergence();
  rewind_and_say_what_stays(ui.session);
}

std::string no_replay(const Ui& ui) {
  return nothing_to_replay(ui.session);
}

void replay_slowly(Ui& ui) {
  if (ui.session.preset().kind == Kind::cloth) ui.color_by(ParticleField::strain);
  ui.session.request(request::Replay{});
}

void frame_cloth(Ui& ui) {
  ui.scene.wants_framing = true;
}

std::string palette_is_open(const Ui& ui) {
  return ui.palette.open ? "The command palette is open." : "";
}

void find_command(Ui& ui) {
  open_palette(ui);
}

void choose_lab(Ui& ui) {
  open_palette(ui, true);
}

std::string no_lab(const Ui& ui) {
  return ui.session.labs.run ? "" : "There is no lab in progress.";
}

std::string no_experiment(const Ui& ui) {
  return ui.session.labs.kept.empty() ? "No experiment was changed before a lab." : "";
}

std::string no_weight(const Ui& ui) {
  return ui.session.preset().kind == Kind::one_weight ? "" : "That needs the mass on a spring; this is a cloth.";
}

std::string no_cloth(const Ui& ui) {
  return ui.session.preset().kind == Kind::cloth ? "" : "Only a cloth can be colored; this is a mass on a spring.";
}

std::string no_copies(const Ui& ui) {
  return ui.session.copies.lockstep.empty() ? "There is no copy to measure; add one first." : "";
}

void next_color(Ui& ui) {
  ui.color_by(next_field(ui.scene));
}

/// Opens the card that shows it, where it is measured from the present moment on.
void show_convergence(Ui& ui) {
  show_card(ui, card_name::accuracy);
  ui.session.studies.convergence.drop();
  ui.plots.accuracy = AccuracySide::convergence;
}

/// Opens the card where they are searched for.
void show_settings_finder(Ui& ui) {
  show_card(ui, card_name::accuracy);
  ui.plots.accuracy = AccuracySide::settings;
}

/// All effects however long they take, or as many as the machine draws in time.
void toggle_effects(Ui& ui) {
  Effects& effects = ui.scene.effects;
  const bool all = effects.mode != Effects::Mode::all;
  effects.mode = all ? Effects::Mode::all : Effects::Mode::automatic;
  ui.settings.all_effects = all;
}

void toggle_cut_path(Ui& ui) {
  bool& along = ui.settings.handling.cut_along_path;
  along = !along;
  ui.messages.note(along ? "A left drag cuts every spring that its path crosses."
                         : "A left drag cuts the springs above the particles near it, as in the report.");
}

void toggle_wind_arrow(Ui& ui) {
  ui.tools.wind_arrow = !wind_arrow_shown(ui.tools);
}

void toggle_slow_hand(Ui& ui) {
  bool& slow = ui.settings.handling.slow_hand;
  slow = !slow;
  ui.messages.note(slow ? "Time runs at a quarter of the speed while you grab or cut."
                        : "Time runs at full speed while you grab or cut.");
}

void toggle_full_screen(Ui& ui) {
  ui.toggle_full_screen = true;
}

void save(Ui& ui) {
  const Document& document = ui.session.document;
  if (document.file.empty()) return open_dialog(ui, Dialog::Kind::save);
  save_document_as(ui.session, document.file, ui.session.preset().name);
}

std::string nothing_to_undo(const Ui& ui) {
  return ui.session.history.can_undo() ? "" : "There is nothing to undo.";
}

std::string nothing_to_redo(const Ui& ui) {
  return ui.session.history.can_redo() ? "" : "There is nothing to redo.";
}

void undo(Ui& ui) {
  take_from_history(ui.session, true);
}

void redo(Ui& ui) {
  take_from_history(ui.session, false);
}

void undo_and_restart(Ui& ui) {
  take_from_history(ui.session, true);
  restart(ui.session);
}

std::string nothing_changed(const Ui& ui) {
  return unsaved(ui.session) ? "" : "The constants already are those of the preset.";
}

void reset_constants(Ui& ui) {
  take_back(ui.session, ui.session.document.saved);
}

void reset_all(Ui& ui) {
  reset_everything(ui.session);
  ui.scene.wants_framing = true;
}

void choose_fastest_engine(Ui& ui) {
  ui.session.studies.engine.begin(ui.session.requested_preset(), ui.session.threads);
}

/// "--set k_s=80" for each constant, so that a command line gives the same scene.
void copy_as_options(Ui& ui) {
  const Preset preset = ui.session.requested_preset();
  std::string text;
  const auto add = [&](std::string_view key, const std::string& value) {
    text += (text.empty() ? "--set " : " --set ") + std::string(key) + "=" + value;
  };
  for (const PresetRow& row : notation()) {
    if (row.effect == Effect::view || (row.only_one_kind && row.only != preset.kind)) continue;
    if (const auto* number = std::get_if<double Preset::*>(&row.field)) add(row.key, shortest_number(preset.**number));
    if (const auto* count = std::get_if<int Preset::*>(&row.field)) add(row.key, std::to_string(preset.**count));
    if (const auto* word = std::get_if<std::string Preset::*>(&row.field)) add(row.key, preset.**word);
    if (const auto* vector = std::get_if<glm::dvec3 Preset::*>(&row.field)) {
      const glm::dvec3& v = preset.**vector;
      add(row.key, "[" + shortest_number(v.x) + "," + shortest_number(v.y) + "," + shortest_number(v.z) + "]");
    }
  }
  ImGui::SetClipboardText(text.c_str());
  ui.messages.note("Copied the constants as --set options.");
}

void scale_text(Ui& ui, double scale) {
  ui.settings.ui_scale = std::clamp(scale, 0.5, 3.0);
  ui.scale_changed = true;
}
void larger_text(Ui& ui) {
  scale_text(ui, ui.settings.ui_scale * 1.1);
}
void smaller_text(Ui& ui) {
  scale_text(ui, ui.settings.ui_scale / 1.1);
}
void normal_text(Ui& ui) {
  scale_text(ui, 1);
}

/// Dark, light, projector, and again.
void next_theme(Ui& ui) {
  const auto all = looks();
  const auto now = std::size_t(&look(ui.settings.theme) - all.data());
  ui.settings.theme = all[(now + 1) % all.size()].name;
  ui.scale_changed = ui.scene.redraw = true;
}

void present(Ui& ui) {
  ui.presenting = !ui.presenting;
  ui.panels = true;
}

void request_quit(Ui& ui) {
  ui.session.request(request::Quit{});
}

std::vector<CommandRow> all_rows() {
  std::vector<CommandRow> rows{
      {"toggle_play",
       "Run or pause",
       "Space",
       {{GLFW_KEY_SPACE, 0}},
       "pauses and runs",
       "play stop",
       toggle_play,
       nothing_moves},
      {"step",
       "One step of dt",
       "→ or O",
       {{GLFW_KEY_RIGHT, 0, true}, {GLFW_KEY_O, 0, true}},
       "makes one step of dt",
       "single",
       step_once},
      {"rewind",
       "Rewind a second",
       "←",
       {{GLFW_KEY_LEFT, 0, true}},
       "rewinds one second",
       "back",
       rewind_a_second,
       nothing_earlier},
      {"replay",
       "Replay the last 50 steps slowly",
       "",
       {},
       "",
       "divergence explosion slow motion",
       replay_slowly,
       no_replay},
      {"restart",
       "Restart the motion",
       "R or Backspace",
       {{GLFW_KEY_R, 0}, {GLFW_KEY_BACKSPACE, 0}},
       "restarts the motion and keeps the constants",
       "begin again",
       of_session<restart>},
      {"frame_cloth", "Frame the cloth", "F", {{GLFW_KEY_F, 0}}, "frames the cloth", "camera zoom view", frame_cloth},
      {"open_palette",
       "Find a command…",
       "Ctrl+P",
       {{GLFW_KEY_P, control}},
       "finds commands, presets, labs and constants",
       "",
       find_command,
       palette_is_open},
      {"toggle_help", "Mouse and keys", "F1", {{GLFW_KEY_F1, 0}}, "this help", "help shortcuts", toggle<&Ui::help>},
      {"start_tour", "Take the tour", "", {}, "", "help introduction welcome", start_tour},
      {"choose_lab",
       "Labs…",
       "Ctrl+L",
       {{GLFW_KEY_L, control}},
       "chooses a lab",
       "lessons exercises course",
       choose_lab},
      {"leave_lab", "Leave the lab", "", {}, "", "quit end", of_session<leave_lab>, no_lab},
      {"back_to_experiment",
       "Back to your experiment",
       "",
       {},
       "",
       "lab before unsaved return",
       of_session<back_to_experiment>,
       no_experiment},
      {"toggle_panels", "All panels", "Tab", {{GLFW_KEY_TAB, 0}}, "hides the panels", "show", toggle<&Ui::panels>},
      {"toggle_map",
       "Map of k_s and dt",
       "M",
       {{GLFW_KEY_M, 0}},
       "maps the zones of stability over k_s and dt",
       "stability card",
       toggle_card<card_name::map, &Layout::map, &Wants::map>},
      {"toggle_inside",
       "Inside a step",
       "I",
       {{GLFW_KEY_I, 0}},
       "shows a step of the picked particle in formulas",
       "formula springs particle",
       toggle_card<card_name::step, &Layout::inside, &Wants::step>},
      {"show_forces", "Forces card", "", {}, "", "plot curves particle", show<card_name::forces>},
      {"show_height", "Height card", "", {}, "", "plot curve weight figure", show<card_name::height>, no_weight},
      {"show_copies", "Copies card", "", {}, "", "compare lockstep beside add a copy", show<card_name::copies>},
      {"show_distances",
       "Distances of the copies",
       "",
       {},
       "",
       "plot card compare lockstep apart",
       show<card_name::distances>,
       no_copies},
      {"show_stability", "Stability card", "", {}, "", "growth spectral radius limit dt", show<card_name::stability>},
      {"show_accuracy", "Accuracy card", "", {}, "", "error reference cost", show<card_name::accuracy>},
      {"show_energy", "Energy card", "", {}, "", "ledger work kinetic potential", show<card_name::energy>},
      {"show_performance",
       "Performance card",
       "",
       {},
       "",
       "speed memory frame cost features",
       show<card_name::performance>},
      {"next_color",
       "Next coloring of the cloth",
       "K",
       {{GLFW_KEY_K, 0}},
       "colors the cloth by tension, strain, speed, …",
       "colors heat map",
       next_color,
       no_cloth},
      {"measure_convergence", "Order of convergence", "", {}, "", "accuracy error dt slope measured", show_convergence},
      {"find_settings",
       "Find settings for an error",
       "",
       {},
       "",
       "accuracy tolerance target method integrator dt cheapest fastest",
       show_settings_finder},
      {"toggle_effects",
       "Full quality (may be slow)",
       "",
       {},
       "",
       "all effects shadows smooth edges graphics",
       toggle_effects},
      {"save_picture",
       "Save an image…",
       "Ctrl+Shift+P",
       {{GLFW_KEY_P, control | shift}},
       "saves an image of the cloth",
       "png screenshot picture export",
       dialog<Dialog::Kind::picture>},
      {"toggle_cut_path",
       "Cut along the path, or upward",
       "C",
       {{GLFW_KEY_C, 0}},
       "cuts along the pointer's path, or upward",
       "knife scissors tool mode springs",
       toggle_cut_path},
      {"toggle_wind_arrow",
       "Wind arrow",
       "W",
       {{GLFW_KEY_W, 0}},
       "shows the wind as an arrow to drag",
       "gust blow",
       toggle_wind_arrow},
      {"toggle_slow_hand",
       "Slow motion while you grab or cut, on or off",
       "H",
       {{GLFW_KEY_H, 0}},
       "slow motion while you grab or cut",
       "speed quarter grab",
       toggle_slow_hand},
      {"present",
       "Presentation mode",
       "F5",
       {{GLFW_KEY_F5, 0}},
       "presents: a large cloth, few controls",
       "projector lecture beamer talk",
       present},
      {"full_screen", "Full screen", "F11", {{GLFW_KEY_F11, 0}}, "full screen", "window", toggle_full_screen},
      {"open_dialog",
       "Open…",
       "Ctrl+O",
       {{GLFW_KEY_O, control}},
       "opens a preset",
       "file load",
       dialog<Dialog::Kind::open>},
      {"save", "Save", "Ctrl+S", {{GLFW_KEY_S, control}}, "saves the preset", "file write", save},
      {"save_as",
       "Save as…",
       "Ctrl+Shift+S",
       {{GLFW_KEY_S, control | shift}},
       "saves the preset under another name",
       "file write",
       dialog<Dialog::Kind::save>},
      {"undo", "Undo", "Ctrl+Z", {{GLFW_KEY_Z, control, true}}, "undoes the last action", "", undo, nothing_to_undo},
      {"redo",
       "Redo",
       "Ctrl+Shift+Z",
       {{GLFW_KEY_Z, control | shift, true}, {GLFW_KEY_Y, control, true}},
       "redoes it",
       "",
       redo,
       nothing_to_redo},
      {"undo_and_restart", "Undo and restart", "", {}, "", "", undo_and_restart, nothing_to_undo},
      {"reset_constants",
       "Reset all constants to the preset",
       "Ctrl+R",
       {{GLFW_KEY_R, control}},
       "constants back to the preset",
       "",
       reset_constants,
       nothing_changed},
      {"reset_everything",
       "Reset everything",
       "Ctrl+Shift+R",
       {{GLFW_KEY_R, control | shift}},
       "everything back to the preset",
       "",
       reset_all},
      {"toggle_auto", "dt chosen by the program", "", {}, "", "automatic time step", of_session<toggle_auto_dt>},
      {"choose_engine",
       "Engine chosen by the program",
       "",
       {},
       "",
       "automatic opencl cpu fastest",
       choose_fastest_engine},
      {"load_texture_dialog", "Use image as texture…", "", {}, "", "picture cloth", dialog<Dialog::Kind::texture>}};
  for (CommandRow& row : export_rows()) rows.push_back(std::move(row));
  for (CommandRow& row : std::vector<CommandRow>{
           {"copy_options",
            "Copy the constants as --set options",
            "",
            {},
            "",
            "command line clipboard share export",
            copy_as_options},
           {"larger_text",
            "Larger text",
            "Ctrl++",  // "+" of Swedish keyboards is elsewhere.
            {{GLFW_KEY_EQUAL, control, true},
             {GLFW_KEY_EQUAL, control | shift, true},
             {GLFW_KEY_KP_ADD, control, true},
             {GLFW_KEY_RIGHT_BRACKET, control, true}},
            "larger text",
            "scale size",
            larger_text},
           {"smaller_text",
            "Smaller text",
            "Ctrl+-",
            {{GLFW_KEY_MINUS, control, true}, {GLFW_KEY_KP_SUBTRACT, control, true}, {GLFW_KEY_SLASH, control, true}},
            "smaller text",
            "scale size",
            smaller_text},
           {"normal_text",
            "Normal text",
            "Ctrl+0",
            {{GLFW_KEY_0, control}, {GLFW_KEY_KP_0, control}},
            "normal text",
            "scale size",
            normal_text},
           {"next_theme",
            "Next theme: dark, light, projector",
            "Ctrl+T",
            {{GLFW_KEY_T, control}},
            "dark, light or projector theme",
            "colors look contrast",
            next_theme},
           {"quit", "Quit", "Ctrl+Q", {{GLFW_KEY_Q, control}}, "quits", "end close exit", request_quit}})
    rows.push_back(std::move(row));
  return rows;
}

}  // namespace

std::span<const CommandRow> command_rows() {
  static const std::vector<CommandRow> rows = all_rows();
  return rows;
}

const CommandRow& row_of(std::string_view id) {
  const auto rows = command_rows();
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const CommandRow& r) { return r.id == id; });
  if (row == rows.end()) throw std::logic_error("there is no command " + std::string(id));
  return *row;
}

std::string why_not(const Ui& ui, const CommandRow& row) {
  return row.why_not != nullptr ? row.why_not(ui) : std::string();
}

const char* Ui::keys_of(std::string_view id) const {
  return row_of(id).keys;
}

void Ui::command(std::string_view id) {
  act([&row = row_of(id)](Ui& ui) {
    if (std::string why = why_not(ui, row); !why.empty()) return ui.messages.note(std::move(why));
    if (row.action != nullptr) return row.action(ui);
    ui.dialog.exporting = &row;
    open_dialog(ui, Dialog::Kind::write_export);
  });
}

}  // namespace tyglab
