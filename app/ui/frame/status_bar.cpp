// The strip below the viewport: the present actions of the mouse, and the size of the cloth.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "app/session/motion.h"
#include "app/ui/frame/panels.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"
#include "core/theory/advice.h"

namespace tyglab {
namespace {

struct Hint {
  const char *what, *does;
};

/// What the pointer and keys do here, most useful first.
std::vector<Hint> hints_of(const Ui& ui) {
  const bool cloth = ui.session.preset().kind == Kind::cloth;
  if (ui.input.by_touch) {
    if (!cloth) return {{"Two fingers", "turn and zoom"}};
    return {{"One finger", ui.tools.finger_cuts ? "cuts" : "grabs"}, {"Two", "turn and zoom"}};
  }
  if (!cloth) return {{"Middle drag", "orbits"}, {"Wheel", "zooms"}, {"F", "frames"}, {"F1", "help"}};
  return {{"Right drag", "grabs"},
          {"Left drag", ui.settings.handling.cut_along_path ? "cuts what it crosses" : "cuts"},
          {"Middle or Ctrl+left drag", "orbits"},
          {"Right click", "picks"},
          {"Right double-click", "pins"},
          {"Wheel", "zooms"},
          {"F", "frames"},
          {"F1", "help"}};
}

/// Of a hint and what parts it from the next, px.
float hint_width(const Ui& ui, const Hint& hint) {
  const ImFont& font = *ui.fonts.small;
  return text_width(font, hint.what) + ui.theme.px(6) + text_width(font, hint.does) + ui.theme.px(20);
}

/// What the first two, without which nothing can be done with a cloth, take at least, px.
float room_for_hints(const Ui& ui, const std::vector<Hint>& hints) {
  float room = 0;
  for (std::size_t n = 0; n < std::min<std::size_t>(2, hints.size()); ++n) room += hint_width(ui, hints[n]);
  return room;
}

/// Those that fit.
void draw_hints(Ui& ui, ImDrawList& draw, ImVec2 at, float end, const std::vector<Hint>& hints) {
  const Tokens& c = ui.theme.colors;
  const ImFont& font = *ui.fonts.small;
  float x = at.x;
  for (const Hint& hint : hints) {
    const float next = x + hint_width(ui, hint);
    if (next - ui.theme.px(20) > end) return;
    draw_text(draw, font, {x, at.y}, c.text, hint.what);
    draw_text(draw, font, {x + text_width(font, hint.what) + ui.theme.px(6), at.y}, c.quiet, hint.does);
    x = next;
  }
}

/// What is running, or what the cloth is: the most important first.
std::vector<std::string> facts_of(const Ui& ui) {
  if (ui.session.studies.engine.busy()) return {"Measuring the engines …"};
  if (ui.session.rebuild.programs()) return {"Building the device program …"};
  const auto size = [](const Lattice& l) { return std::to_string(l.rows) + " × " + std::to_string(l.columns); };
  if (const auto next = ui.session.rebuild.lattice()) return {"Building " + size(*next) + " …"};
  if (ui.session.preset().kind != Kind::cloth) return {"mass on a spring"};
  std::vector<std::string> facts{size(ui.session.simulation->lattice().sites()) + " particles"};
  const std::string every = std::to_string(ui.scene.view.every);
  if (ui.scene.view.every > 1) facts.front() += ", one particle in " + every + " × " + every + " drawn";
  if (!ui.session.simulation->tears().untorn()) facts.push_back(tears_in_words(ui.session.simulation->tears()));
  if (const SolveCounts solves = ui.session.simulation->engine().solves(); solves.unconverged > 0)
    facts.push_back(unsolved(solves, ui.session.simulation->steps(), ui.session.preset()));
  if (ui.session.asleep()) facts.emplace_back("at rest: wakes when touched");
  if (const std::string without = ui.scene.effects.words(); !without.empty()) facts.push_back("without " + without);
  return facts;
}

/// The first ones in a line.
std::string first_of(const std::vector<std::string>& facts, std::size_t count) {
  std::string text;
  for (std::size_t k = 0; k < count; ++k) text += (k > 0 ? " · " : "") + facts[k];
  return text;
}

/// As many of the facts as have room, at the right; the pointer asks for all. Returns where they begin.
float draw_facts(Ui& ui, ImDrawList& draw, ImVec2 right, float room) {
  const ImFont& font = *ui.fonts.small;
  const std::vector<std::string> facts = facts_of(ui);
  const std::string all = first_of(facts, facts.size());
  std::string shown = all;
  for (std::size_t count = facts.size() - 1; count > 0 && text_width(font, shown) > room; --count)
    shown = first_of(facts, count) + " · …";
  // The number of particles alone is known by its form.
  if (text_width(font, shown) > room) shown = shown.substr(0, shown.find(" particles"));
  shown = fitted(font, shown, room);
  const float x = right.x - text_width(font, shown);
  draw_text(draw, font, {x, right.y}, ui.theme.colors.quiet, shown);
  ImGui::SetCursorScreenPos({x, right.y});
  gui::press_area("facts", {std::max(right.x - x, 1.f), font.FontSize});
  report_control(ui, "facts");
  if (shown != all) tooltip(ui, gui::item_id(), all);
  return x;
}

}  // namespace

void status_bar(Ui& ui, const Region& region) {
  const Tokens& c = ui.theme.colors;
  if (!begin_region("status", region, c.panel, {0, 0})) return end_region();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float margin = ui.theme.px(16);
  const float y = std::round(region.at.y + (region.size.y - ui.fonts.small->FontSize) / 2);
  const std::vector<Hint> hints = hints_of(ui);
  constexpr float least_facts = 60;  // at scale 1: the beginning of the first, whose whole is a tooltip
  const float whole = region.size.x - 2 * margin;
  const float room = std::max(whole - room_for_hints(ui, hints), ui.theme.px(least_facts));
  const float facts_x = draw_facts(ui, draw, {region.at.x + region.size.x - margin, y}, room);
  draw_hints(ui, draw, {region.at.x + margin, y}, facts_x - ui.theme.px(16), hints);
  end_region();
}

}  // namespace tyglab
