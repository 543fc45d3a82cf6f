// The strip below the viewport: what the mouse does here, and what the cloth is.
#include <cmath>
#include <cstdio>

#include "app/panels/panels.h"
#include "app/panels/symbol.h"
#include "app/panels/widgets.h"

namespace tyglab {
namespace {

struct Hint {
  const char *what, *does;
};

/// The hints that fit, most useful first.
void hints(App& app, ImDrawList& draw, ImVec2 at, float end, std::initializer_list<Hint> list) {
  const Tokens& c = app.theme.colors;
  const ImFont& font = *app.fonts.small;
  float x = at.x;
  for (const Hint& hint : list) {
    const float what = text_width(font, hint.what), does = text_width(font, hint.does), gap = app.theme.px(6);
    if (x + what + gap + does > end) return;
    draw_text(draw, font, {x, at.y}, c.text, hint.what);
    draw_text(draw, font, {x + what + gap, at.y}, c.quiet, hint.does);
    x += what + gap + does + app.theme.px(20);
  }
}

}  // namespace

void status_bar(App& app, const Region& region) {
  const Tokens& c = app.theme.colors;
  if (!begin_region("status", region, c.panel, {0, 0})) return end_region();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImFont& font = *app.fonts.small;
  const float y = std::round(region.at.y + (region.size.y - font.FontSize) / 2), margin = app.theme.px(16);
  char facts[256] = "";
  const Lattice& lattice = app.simulation->lattice();
  if (app.engine_search.in_work()) {
    std::snprintf(facts, sizeof facts, "Measuring the engines …");
  } else if (app.building.programs()) {
    std::snprintf(facts, sizeof facts, "Building the device's program …");
  } else if (const auto next = app.building.lattice()) {
    std::snprintf(facts, sizeof facts, "Building %d × %d …", next->rows, next->columns);
  } else if (app.preset().kind == Kind::cloth) {
    const int torn = app.simulation->tears().torn_count();
    int n = std::snprintf(facts, sizeof facts, "%d × %d particles", lattice.rows, lattice.columns);
    if (app.view.every > 1)
      n += std::snprintf(facts + n, sizeof facts - std::size_t(n), ", one in %d × %d drawn", app.view.every,
                         app.view.every);
    if (torn > 0)
      n += std::snprintf(facts + n, sizeof facts - std::size_t(n), " · %d spring%s torn", torn, torn == 1 ? "" : "s");
    if (const std::string without = app.effects.words(); !without.empty())
      n += std::snprintf(facts + n, sizeof facts - std::size_t(n), " · drawn without %s", without.c_str());
    if (app.asleep()) std::snprintf(facts + n, sizeof facts - std::size_t(n), " · at rest: asleep until touched");
  } else {
    std::snprintf(facts, sizeof facts, "one weight");
  }
  const std::string shown = fitted(font, facts, region.size.x - 2 * margin);
  const float facts_x = region.at.x + region.size.x - margin - text_width(font, shown);
  draw_text(draw, font, {facts_x, y}, c.quiet, shown);
  const ImVec2 at{region.at.x + margin, y};
  const float end = facts_x - app.theme.px(16);
  if (app.preset().kind == Kind::cloth) {
    hints(app, draw, at, end,
          {{"Right drag", "grabs"},
           {"Left drag", app.settings.handling.cut_along_path ? "cuts what it crosses" : "cuts"},
           {"Middle drag", "orbits"},
           {"Right click", "picks"},
           {"Right double-click", "pins"},
           {"Wheel", "zooms"},
           {"F", "frames"},
           {"F1", "help"}});
  } else {
    hints(app, draw, at, end, {{"Middle drag", "orbits"}, {"Wheel", "zooms"}, {"F", "frames"}, {"F1", "help"}});
  }
  end_region();
}

}  // namespace tyglab
