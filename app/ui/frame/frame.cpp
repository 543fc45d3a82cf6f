#include "app/ui/frame/frame.h"

#include <imgui.h>

#include <algorithm>
#include <utility>

#include "app/ui/frame/panels.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/state/ui.h"
#include "core/output/obj.h"

namespace tyglab {
namespace {

constexpr double gesture_end = 0.6;  // s without a change
constexpr float text_scale_least = 0.5f, text_scale_most = 6;
// Of the window's height: read from the last row of a lecture hall.
constexpr float presented_axis_text = 0.025f, presented_text = 0.02f;
constexpr float tallest_presented = 0.75f;  // of the width: a window that is taller has text as if it were that

/// The least scale of text in presentation mode.
float presented_scale(ImVec2 window) {
  return std::ceil(presented_text * std::min(window.y, tallest_presented * window.x)) / small_text_at_1;
}

/// Overlaid copies have the colors of their curves.
void color_copies(Ui& ui) {
  for (std::size_t n = 0; n < ui.session.copies.lockstep.size(); ++n) {
    const ImVec4 c = ImGui::ColorConvertU32ToFloat4(cloth_style(ui.theme.colors, ui.session, int(n)).color);
    const glm::vec3 color{c.x, c.y, c.z};
    if (std::exchange(ui.scene.ghost_colors[n], color) != color) ui.scene.redraw = true;
  }
}

}  // namespace

void follow_session(Ui& ui) {
  ui.scene.follow(), ui.tools.follow(), ui.follow();
}

bool take_look(Ui& ui, float content_scale) {
  if (ui.input.scale_changed) ui.scale_changed = true;
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  const float axis_text = ui.presenting ? std::ceil(presented_axis_text * window.y) : 0;
  const float least_scale = ui.presenting ? presented_scale(window) : 0;
  if (std::exchange(ui.theme.axis_text, axis_text) != axis_text) ui.scale_changed = true;
  if (std::exchange(ui.theme.least_scale, least_scale) != least_scale) ui.scale_changed = true;
  if (!ui.scale_changed) return false;
  ui.scale_changed = false;
  const Look& look = tyglab::look(ui.settings.theme);
  ui.theme.colors = look.tokens();
  ui.scene.view.palette = look.tokens == light_tokens ? light_palette : Palette{};
  // In presentation mode the audience sits far away, whatever the theme.
  const float magnified = ui.presenting ? tyglab::look("projector").magnified : look.magnified;
  const float scale = content_scale * float(ui.settings.ui_scale) * magnified;
  ui.theme.display = content_scale;
  ui.theme.scale = std::clamp(std::max(scale, least_scale), text_scale_least, text_scale_most);
  apply_style(ui.theme);
  ui.scene.scale = ui.theme.scale;
  return true;
}

void act_on_events(Ui& ui, double elapsed, double frame_time) {
  handle_keys(ui);
  apply_requests(ui.session);
  follow_session(ui);
  ui.run_actions();
  follow_session(ui);
  handle_pointer(ui.tools);
  ui.session.wants = layout_wants(ui, ImGui::GetIO().DisplaySize);
  ui.session.behind_page = ui.dialog.kind == Dialog::Kind::start;
  SessionInput input = ui.tools.session_input();
  input.dragging = ui.slider.dragged != 0;
  input.frame_time = frame_time;
  ui.session.update(elapsed, input);
  follow_session(ui);
  color_copies(ui);
}

std::optional<double> direct_film(Ui& ui) {
  if (!ui.film) return std::nullopt;
  FilmOrder& film = *ui.film;
  Session& session = ui.session;
  if (film.frame == film.count || session.simulation->divergence()) {
    ui.messages.note("Exported " + std::to_string(film.frame) + (film.frame == 1 ? " image" : " images") + " to " +
                     film.folder.string() + ", " + std::to_string(FilmOrder::fps) + " per second of playback.");
    ui.film.reset();
    return std::nullopt;
  }
  if (!session.pacing.playing || session.background_steps.busy() || session.rebuild.busy()) return 0;
  const double t = session.simulation->time(), dt = session.preset().dt;
  if (film.frame == 0 || t > film.next_t + 1) film.next_t = t;  // or it has been brought elsewhere
  if (t < film.next_t - dt / 2 && !session.asleep()) {
    film.shown = true;
    return (film.next_t - t) / session.pacing.aim();
  }
  // The user sees how far the film is, and can press what is on the screen.
  if (!film.shown) return film.shown = true, 0;
  film.shown = false;
  ui.picture = {film.folder / frame_name(session.document.label, film.frame, film.count, "png"), false};
  ++film.frame, film.next_t += session.pacing.aim() / FilmOrder::fps;
  return 0;
}

void draw_panels(Ui& ui) {
  if (ui.bare()) gui::keep_pressed();  // what is over the cloth is not drawn, and must not lose its press
  SliderState& slider = ui.slider;
  slider.order = 0;
  slider.focused_seen = false;
  ui.hover_seen = false;
  ui.tooltip_before = std::exchange(ui.tooltip, std::nullopt);
  if (std::exchange(ui.pointer_before, ui.input.at) != ui.input.at) ui.keys_since_move = false;
  if (!ui.input.keys.empty()) ui.keys_since_move = true;
  ui.covered = ui.help;
  ui.methods.open = false;  // until it is drawn
  draw_layout(ui, ImGui::GetIO().DisplaySize);
  // A slider that is no longer drawn (folded, hidden) gives its keys back; so does one when the cloth is pressed.
  if (!slider.focused_seen || ui.tools.tool.kind != Tool::Kind::none) slider.focused = 0, slider.focused_order = -1;
  slider.wanted_order = -1;
  slider.keys.clear();
  if (slider.typing == 0 || !ui.input.unread) slider.commit = slider.cancel = false;
  ui.close_lists = false;
  if (!ui.hover_seen) ui.hovered = 0, ui.hover_used = false;
}

void end_gestures(Ui& ui) {
  const bool quiet = !ImGui::IsAnyItemActive() && ui.tools.tool.kind == Tool::Kind::none;
  if (quiet && ui.now - ui.session.last_change > gesture_end) ui.session.history.end_gesture();
}

}  // namespace tyglab
