#include "app/ui/frame/panels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "app/base/text.h"
#include "app/ui/kit/widgets.h"

namespace tyglab {
namespace {

struct Stop {
  const char *title, *text, *for_touch;
  Tour::Place (*place)(const Ui&);
};

Tour::Place cloth_place(const Ui& ui) {
  return {ui.viewport.box.lo, ui.viewport.box.hi};
}
Tour::Place constants_place(const Ui& ui) {
  const auto& box = ui.viewport.box;
  return {{0, box.lo.y}, {box.lo.x, ImGui::GetIO().DisplaySize.y}};
}
Tour::Place transport_place(const Ui& ui) {
  return ui.tour.transport;
}
Tour::Place plots_place(const Ui& ui) {
  const auto& box = ui.viewport.box;
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  return {{box.hi.x, box.lo.y}, {window.x, window.y}};
}
Tour::Place labs_place(const Ui& ui) {
  return ui.tour.labs;
}

constexpr std::array<Stop, 5> stops{
    {{"Grab the cloth",
      "Drag with the right button: the particle under the pointer follows your hand. Drag with the left button to cut "
      "the cloth. Ctrl and the left button orbit the view, and the wheel zooms.",
      "One finger on the cloth grabs it, and two turn and zoom the view. The menu switches one finger to cutting, and "
      "has Undo.",
      cloth_place},
     {"The constants",
      "Every constant of the model has a slider; double-click its number to type one. The strip under a slider shows "
      "where the chosen method is stable in any shape of the cloth (green), where stability depends on the shape "
      "(amber, dashed), and where the method is unstable in every shape (red, hatched).",
      "Every constant of the model has a slider; tap its number to type one. The strip under a slider shows where the "
      "chosen method is stable in any shape of the cloth (green), where stability depends on the shape (amber, "
      "dashed), and where the method is unstable in every shape (red, hatched).",
      constants_place},
     {"Run, step, restart",
      "Space runs and pauses. → makes one step of dt, and R restarts with the present constants. When a motion "
      "explodes, a banner says why and what to do.",
      "The triangle runs and pauses, the arrow beside it makes one step of dt, and the round arrow restarts with the "
      "present constants. When a motion explodes, a banner says why and what to do.",
      transport_place},
     {"What happens inside",
      "Curves show the forces on the picked particle; a right click picks another one. Below are cards for copies with "
      "other settings, stability, accuracy, energy and cost; click a heading to open one. M maps the stable values of "
      "k_s and dt, and I shows a step in formulas.",
      "Curves show the forces on the picked particle; a tap picks another one. Below are cards for copies with other "
      "settings, stability, accuracy, energy and cost; tap a heading to open one. The menu has a map of the stable "
      "values of k_s and dt, and a step in formulas.",
      plots_place},
     {"Labs",
      "A lab asks you to predict, lets you experiment, and checks the result. Begin with Hooke's law. Ctrl+P finds "
      "everything by name, and F1 lists the keys and restarts this tour.",
      "A lab asks you to predict, lets you experiment, and checks the result. Begin with Hooke's law. The menu finds "
      "everything by name, and its help restarts this tour.",
      labs_place}}};

bool visible(const Tour::Place& place) {
  return place.hi.x > place.lo.x + 4 && place.hi.y > place.lo.y + 4;
}

void outline(const Ui& ui, const Tour::Place& place) {
  const float inset = ui.theme.px(2), out = std::max(2.f, ui.theme.px(2));
  ImGui::GetForegroundDrawList()->AddRect({place.lo.x + inset, place.lo.y + inset},
                                          {place.hi.x - inset, place.hi.y - inset}, ui.theme.colors.accent,
                                          ui.theme.px(6), 0, out);
}

/// Beside the place: to its right or left where there is room, else below it, else within it.
ImVec2 beside(const Ui& ui, const Tour::Place& place, ImVec2 size) {
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  const float gap = ui.theme.px(14);
  const glm::vec2 middle = (place.lo + place.hi) / 2.f;
  const bool tall = place.hi.y - place.lo.y > window.y / 2;
  ImVec2 at{middle.x - size.x / 2, place.hi.y + gap};
  if (tall && place.hi.x + gap + size.x < window.x) {
    at = {place.hi.x + gap, middle.y - size.y / 2};
  } else if (tall && place.lo.x - gap - size.x > 0) {
    at = {place.lo.x - gap - size.x, middle.y - size.y / 2};
  }
  // The cloth's own card keeps to its lower edge, so that the cloth is seen.
  if (place.lo == ui.viewport.box.lo) at = {middle.x - size.x / 2, place.hi.y - size.y - 2 * gap};
  const auto inside = [gap](float x, float most) { return std::round(std::max(std::min(x, most - gap), gap)); };
  return {inside(at.x, window.x - size.x), inside(at.y, window.y - size.y)};
}

void end_tour(Ui& ui) {
  ui.tour.card = -1;
  ui.settings.tour_seen = true;
}

void go_to(Ui& ui, int card) {
  if (card >= int(stops.size())) return end_tour(ui);
  ui.tour.card = std::max(card, 0);
}

void tour_contents(Ui& ui) {
  const Tokens& c = ui.theme.colors;
  const int card = ui.tour.card;
  const Stop& stop = stops[std::size_t(card)];
  ImGui::PushFont(ui.fonts.brand);
  wrapped(ui, stop.title, c.text);
  ImGui::PopFont();
  wrapped(ui, ui.input.by_touch ? stop.for_touch : stop.text, c.text);
  const std::string paused = "The motion is paused: Space runs it.";
  if (card == 0 && !ui.session.pacing.playing) wrapped(ui, ui.input.by_touch ? for_fingers(paused) : paused, c.text);
  ImGui::Dummy({0, ui.theme.px(2)});
  const bool last = card + 1 == int(stops.size());
  if (text_button(ui, last ? "Done" : "Next", true)) go_to(ui, card + 1);
  ImGui::SameLine();
  if (card > 0 && text_button(ui, "Back")) go_to(ui, card - 1);
  if (card > 0) ImGui::SameLine();
  if (!last && text_button(ui, "Skip the tour")) end_tour(ui);
  if (!last) ImGui::SameLine();
  char place[32];
  std::snprintf(place, sizeof place, "%d of %d", card + 1, int(stops.size()));
  const ImVec2 at = ImGui::GetCursorScreenPos();
  draw_on_baseline(*ImGui::GetWindowDrawList(), *ui.fonts.text,
                   {at.x + ui.theme.px(4), baseline_at(ui.fonts, at.y + ui.theme.px(15))}, c.quiet, place);
  ImGui::Dummy({text_width(*ui.fonts.text, place), ui.theme.px(30)});
}

}  // namespace

void start_tour(Ui& ui) {
  ui.tour.card = 0;
  ui.panels = ui.settings.layout.left = ui.settings.layout.right = true;
}

void tour_card(Ui& ui) {
  Tour& tour = ui.tour;
  if (std::exchange(tour.leave, false) && tour.card >= 0) end_tour(ui);
  if (std::exchange(tour.next, false) && tour.card >= 0) go_to(ui, tour.card + 1);
  if (tour.card < 0) return;
  const Tour::Place place = stops[std::size_t(tour.card)].place(ui);
  if (visible(place)) outline(ui, place);
  const float width = std::min(ui.theme.px(380), ImGui::GetIO().DisplaySize.x - ui.theme.px(28));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(ui.theme.px(20), ui.theme.px(16)));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, ui.theme.px(8));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(ui.theme.px(8), ui.theme.px(8)));
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ui.theme.colors.panel);
  ImGui::SetNextWindowSize({width, 0});
  if (ImGui::Begin("tour", nullptr,
                   ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                       ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                       ImGuiWindowFlags_NoScrollbar)) {
    ImGui::PushTextWrapPos(0);
    tour_contents(ui);
    ImGui::PopTextWrapPos();
    const ImVec2 size = ImGui::GetWindowSize(), at = beside(ui, place, size);
    ImGui::SetWindowPos(at);
    if (ImGui::IsWindowAppearing()) ui.draw_by = ui.now;
    cover_viewport(ui, at, {at.x + size.x, at.y + size.y});
  }
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(4);
}

}  // namespace tyglab
