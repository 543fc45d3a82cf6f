#include "app/ui/frame/tour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "app/ui/kit/symbol.h"
#include "app/ui/kit/widgets.h"

namespace tyglab {
namespace {

struct Stop {
  const char *title, *text;
  Tour::Place (*place)(const App&);
};

Tour::Place cloth_place(const App& app) {
  return {app.viewport.box.lo, app.viewport.box.hi};
}
Tour::Place constants_place(const App& app) {
  const auto& box = app.viewport.box;
  return {{0, box.lo.y}, {box.lo.x, ImGui::GetIO().DisplaySize.y}};
}
Tour::Place transport_place(const App& app) {
  return app.ui.tour.transport;
}
Tour::Place plots_place(const App& app) {
  const auto& box = app.viewport.box;
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  return {{box.hi.x, box.lo.y}, {window.x, window.y}};
}
Tour::Place labs_place(const App& app) {
  return app.ui.tour.labs;
}

constexpr std::array<Stop, 5> stops{
    {{"Take the cloth in hand",
      "Drag with the right button: the particle under the pointer follows your hand. Drag with the left button: the "
      "cloth is cut. Ctrl and the left button turn the view, the wheel zooms.",
      cloth_place},
     {"The constants",
      "Every constant of the model has a slider; double-click its number to type one. The strip under a slider says "
      "where the chosen method is stable: green is safe, amber near the limit, red and hatched unstable.",
      constants_place},
     {"Run, step, restart",
      "Space runs and pauses. → makes one step of dt, R begins again with the constants as they are. When a motion "
      "explodes, a banner says why and what to do.",
      transport_place},
     {"What happens inside",
      "The forces on the picked particle, as curves; a right click picks another one. Below wait cards for copies "
      "with other settings, stability, accuracy, energy and cost: a click on a heading opens it. M maps which k_s and "
      "dt are stable, I writes out a step.",
      plots_place},
     {"Labs",
      "A lab asks you to predict, lets you try, and looks whether it is so. Begin with Hooke's law. Ctrl+P finds "
      "everything by its name, and F1 lists the keys; this tour is there too.",
      labs_place}}};

bool visible(const Tour::Place& place) {
  return place.hi.x > place.lo.x + 4 && place.hi.y > place.lo.y + 4;
}

void outline(const App& app, const Tour::Place& place) {
  const float inset = app.theme.px(2), out = std::max(2.f, app.theme.px(2));
  ImGui::GetForegroundDrawList()->AddRect({place.lo.x + inset, place.lo.y + inset},
                                          {place.hi.x - inset, place.hi.y - inset}, app.theme.colors.accent,
                                          app.theme.px(6), 0, out);
}

/// Beside the place: to its right or left where there is room, else below it, else within it.
ImVec2 beside(const App& app, const Tour::Place& place, ImVec2 size) {
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  const float gap = app.theme.px(14);
  const glm::vec2 middle = (place.lo + place.hi) / 2.f;
  const bool tall = place.hi.y - place.lo.y > window.y / 2;
  ImVec2 at{middle.x - size.x / 2, place.hi.y + gap};
  if (tall && place.hi.x + gap + size.x < window.x) {
    at = {place.hi.x + gap, middle.y - size.y / 2};
  } else if (tall && place.lo.x - gap - size.x > 0) {
    at = {place.lo.x - gap - size.x, middle.y - size.y / 2};
  }
  // The cloth's own card keeps to its lower edge, so that the cloth is seen.
  if (place.lo == app.viewport.box.lo) at = {middle.x - size.x / 2, place.hi.y - size.y - 2 * gap};
  const auto inside = [gap](float x, float most) { return std::round(std::max(std::min(x, most - gap), gap)); };
  return {inside(at.x, window.x - size.x), inside(at.y, window.y - size.y)};
}

void end_tour(App& app) {
  app.ui.tour.card = -1;
  app.settings.tour_seen = true;
}

void go_to(App& app, int card) {
  if (card >= int(stops.size())) return end_tour(app);
  app.ui.tour.card = std::max(card, 0);
}

void tour_contents(App& app) {
  const Tokens& c = app.theme.colors;
  const int card = app.ui.tour.card;
  const Stop& stop = stops[std::size_t(card)];
  ImGui::PushFont(app.fonts.brand);
  wrapped(app, stop.title, c.text);
  ImGui::PopFont();
  wrapped(app, stop.text, c.text);
  ImGui::Dummy({0, app.theme.px(2)});
  const bool last = card + 1 == int(stops.size());
  if (text_button(app, last ? "Done" : "Next", true)) go_to(app, card + 1);
  ImGui::SameLine();
  if (card > 0 && text_button(app, "Back")) go_to(app, card - 1);
  if (card > 0) ImGui::SameLine();
  if (!last && text_button(app, "Skip the tour")) end_tour(app);
  if (!last) ImGui::SameLine();
  char place[32];
  std::snprintf(place, sizeof place, "%d of %d", card + 1, int(stops.size()));
  const ImVec2 at = ImGui::GetCursorScreenPos();
  draw_on_baseline(*ImGui::GetWindowDrawList(), *app.fonts.text,
                   {at.x + app.theme.px(4), baseline_at(app.fonts, at.y + app.theme.px(15))}, c.quiet, place);
  ImGui::Dummy({text_width(*app.fonts.text, place), app.theme.px(30)});
}

}  // namespace

void start_tour(App& app) {
  app.ui.tour.card = 0;
  app.ui.panels = app.settings.layout.left = app.settings.layout.right = true;
}

void tour_card(App& app) {
  Tour& tour = app.ui.tour;
  if (std::exchange(tour.leave, false) && tour.card >= 0) end_tour(app);
  if (std::exchange(tour.next, false) && tour.card >= 0) go_to(app, tour.card + 1);
  if (tour.card < 0) return;
  const Tour::Place place = stops[std::size_t(tour.card)].place(app);
  if (visible(place)) outline(app, place);
  const float width = std::min(app.theme.px(380), ImGui::GetIO().DisplaySize.x - app.theme.px(28));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(app.theme.px(20), app.theme.px(16)));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, app.theme.px(8));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(app.theme.px(8), app.theme.px(8)));
  ImGui::PushStyleColor(ImGuiCol_WindowBg, app.theme.colors.panel);
  ImGui::SetNextWindowSize({width, 0});
  if (ImGui::Begin("tour", nullptr,
                   ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                       ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                       ImGuiWindowFlags_NoScrollbar)) {
    ImGui::PushTextWrapPos(0);
    tour_contents(app);
    ImGui::PopTextWrapPos();
    const ImVec2 size = ImGui::GetWindowSize(), at = beside(app, place, size);
    ImGui::SetWindowPos(at);
    if (ImGui::IsWindowAppearing()) app.ui.draw_by = app.ui.now;
    cover_viewport(app, at, {at.x + size.x, at.y + size.y});
  }
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(4);
}

}  // namespace tyglab
