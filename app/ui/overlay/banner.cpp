// The banner over the viewport after a divergence, with the decisions that it offers.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "app/base/text.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"
#include "app/ui/overlay/overlay.h"
#include "app/ui/state/ui.h"
#include "core/integrators/scheme.h"
#include "core/model/words.h"
#include "core/theory/advice.h"

namespace tyglab {
namespace {

constexpr float least_banner = 380;  // pixels at scale 1, of the width
constexpr const char* replay_label = "Replay slowly";

float height_of(const ImFont& font, const std::string& lines) {
  return font.CalcTextSizeA(font.FontSize, 1e9f, 0, lines.data(), lines.data() + lines.size()).y;
}

/// dt in parts of the worst-case limit; infinite where no dt is stable.
double over_limit(const Preset& preset) {
  return preset.dt / stable_dt(preset, preset.integrator);
}

/// The constants before the user's last change, if it was one of the model.
std::optional<Preset> before_last_change(const Ui& ui) {
  const HistoryEntry* last = ui.session.history.next(true);
  if (last == nullptr || same_model(last->constants, ui.session.preset())) return std::nullopt;
  return last->constants;
}

/// Whether the linear theory says that a cloth with the former constants stays well, and no worse than now.
bool undo_helps(const Preset& before, const Preset& now) {
  return over_limit(before) <= std::min(1.0, over_limit(now)) && !springs_too_weak(before);
}

const Advice& advice_for(const Preset& then, Ui& ui) {
  Advice& advice = ui.advice;
  const Preset& now = ui.session.preset();
  const std::optional<Preset> before = before_last_change(ui);
  if (advice.then != then || advice.now != now || advice.before != before)
    advice = {.then = then,
              .now = now,
              .before = before,
              .largest_dt = stable_dt(then, then.integrator),
              .springs_too_weak = springs_too_weak(now),
              .suggested_fix = suggested_fix(now),
              .slower = with_advised_dt(now),
              .undo_helps = before && !same_model(*before, then) && undo_helps(*before, now)};
  return advice;
}

/// A way out of a divergence: a button of the banner.
struct Way {
  std::string label, tip;
  const char* keys;
  std::function<void(Ui&)> go;
};

std::string fix_label(const Preset& now, const Preset& fixed) {
  std::string label = fixed.integrator == now.integrator ? "" : "Verlet";
  if (fixed.dt != now.dt) label += (label.empty() ? "" : ", ") + ("dt = " + quantity(fixed.dt, "s"));
  return label;
}

/// Why, and what to do about it: the advice holds for the constants that diverged, and goes with them.
std::string why_and_what_now(const Ui& ui, const Divergence& d) {
  const char* changed = "Constants have changed since then: restart to see their effect.";
  return sentence(d.cause) + " " + (changed_since_divergence(ui.session) ? changed : sentence(d.advice));
}

/// Back to where the cloth was well, with a change that makes it stay so: a smaller dt, Verlet, implicit Euler.
void add_retries(const Ui& ui, const Advice& advice, bool past, std::vector<Way>& ways) {
  const Preset& now = ui.session.preset();
  const std::string from = past ? "One second back, then " : "Restart with ";
  const auto retry = [&](const std::string& label, const Preset& preset, const char* with) {
    ways.push_back({label, from + with, "", [preset](Ui& u) { u.session.request(request::Retry{preset}); }});
  };
  if (advice.suggested_fix && advice.suggested_fix->integrator != now.integrator)
    retry(fix_label(now, *advice.suggested_fix), *advice.suggested_fix, "the settings that linear theory advises");
  if (advice.slower)
    retry("dt = " + quantity(advice.slower->dt, "s"), *advice.slower,
          "dt at 0.9 of the worst-case limit of this method");
  if (is_implicit(scheme(now.integrator))) return;
  Preset implicit = now;
  implicit.integrator = "implicit_euler";
  implicit.engine = EngineKind::cpu;  // no other has it
  retry("Implicit Euler", implicit, "a method with no stability limit in linear theory");
}

/// "Undo k_s and restart", where that is short and says all.
std::string undo_label(const Preset& before, const Preset& now) {
  constexpr std::size_t short_name = 10;
  const std::string key = only_change(before, now);
  return key.empty() || key.size() > short_name ? "Undo and restart" : "Undo " + key + " and restart";
}

/// What is offered, the most helpful first: to take back what the user did, to go back and do what the linear theory
/// advises. Once constants have changed, to try them.
std::vector<Way> ways_out(const Ui& ui, const Advice& advice) {
  std::vector<Way> ways;
  if (advice.undo_helps)
    ways.push_back(
        {undo_label(*advice.before, ui.session.preset()),
         "Undoes the last change (" + change_in_words(*advice.before, ui.session.preset()) + ") and restarts",
         "Ctrl+Z, then R", [](Ui& u) { u.command("undo_and_restart"); }});
  const Way restart{"Restart", "From the start, with the present constants", "R", [](Ui& u) { u.command("restart"); }};
  const bool past = ui.session.rewind.before(*ui.session.simulation, ui.session.simulation->time(), 1) != nullptr;
  const Way rewind{"Rewind 1 s", "One second back, paused", "←", [](Ui& u) { u.command("rewind"); }};
  const bool changed = changed_since_divergence(ui.session);
  // A restart that must end in the same way is not the first thing to try.
  const auto& limits = ui.session.studies.stability.limits();
  const Preset& present = ui.session.preset();
  const bool known = limits && same_model(limits->of, present);
  const bool again = !changed || (known && present.dt > limits->every);
  if (!again) ways.insert(ways.begin(), restart);
  const bool doubtful = known && present.dt > limits->any;
  if ((again || doubtful) && !advice.springs_too_weak) add_retries(ui, advice, past, ways);
  if (nothing_to_replay(ui.session).empty())
    ways.push_back({replay_label,
                    std::string("At most the last 50 steps in a few seconds, colored by strain, with a ring around the "
                                "place that diverges first") +
                        (changed ? ". Restores the constants that diverged" : ""),
                    "", [](Ui& u) { u.command("replay"); }});
  if (past) ways.push_back(rewind);
  if (again) ways.push_back(restart);
  return ways;
}

/// Places the buttons from the left, in as many lines as they need; returns where each begins, relative to the first.
std::vector<ImVec2> flow(const Ui& ui, const std::vector<Way>& ways, float width) {
  const float gap = ui.theme.px(8), line = ui.theme.px(30) + gap;
  std::vector<ImVec2> places;
  ImVec2 at{0, 0};
  for (const Way& way : ways) {
    const float button = text_width(*ui.fonts.text, way.label) + 2 * ImGui::GetStyle().FramePadding.x;
    if (at.x > 0 && at.x + button > width) at = {0, at.y + line};
    places.push_back(at);
    at.x += button + gap;
  }
  return places;
}

void way_buttons(Ui& ui, const std::vector<Way>& ways, const std::vector<ImVec2>& places, ImVec2 lo) {
  for (std::size_t k = 0; k < ways.size(); ++k) {
    ImGui::SetCursorScreenPos({lo.x + places[k].x, lo.y + places[k].y});
    if (text_button(ui, ways[k].label.c_str(), k == 0)) ways[k].go(ui);
    tooltip(ui, gui::item_id(), ways[k].tip, ways[k].keys);
  }
}

constexpr float folded_padding_at_1 = 8;
constexpr float high_for_banner = 320;  // px at scale 1, of the cloth's place: room for a second line

/// The banner on a line or a few: what is said and offered wherever the whole would leave the cloth too little room.
struct FoldedBanner {
  std::string words;
  std::vector<Way> ways;
  std::vector<ImVec2> places;  ///< of their buttons, px from the first one's corner
  bool under = false;          ///< the buttons stand below the words
  glm::vec2 size{0};           ///< px
};

float buttons_width(const Ui& ui, const std::vector<Way>& ways) {
  float sum = -ui.theme.px(8);
  for (const Way& way : ways)
    sum += text_width(*ui.fonts.text, way.label) + 2 * ImGui::GetStyle().FramePadding.x + ui.theme.px(8);
  return sum;
}

/// The first way out, the replay and the details, beside as many words as have room, or below them. `high`: there is
/// room for two lines rather than for fewer words; otherwise the first way out, where it would take a second line, is
/// left to the details.
FoldedBanner folded_banner(const Ui& ui, const std::vector<Way>& ways, double over_limit, float most, bool high) {
  const float padding = ui.theme.px(folded_padding_at_1), gap = ui.theme.px(8), icon = ui.theme.px(26),
              line = ui.theme.px(30);
  std::vector<Way> shown{ways.front()};
  for (std::size_t k = 1; k < ways.size(); ++k)
    if (ways[k].label == replay_label) shown.push_back(ways[k]);
  shown.push_back({"Details", "What happened, why, and all remedies", "", [](Ui& u) { u.banner_whole = true; }});
  const float room = most - 2 * padding;
  if (!high && shown.size() > 2 && buttons_width(ui, shown) > room) shown.erase(shown.begin());
  const float buttons = std::min(buttons_width(ui, shown), room);
  const std::vector<ImVec2> places = flow(ui, shown, room);
  const float rows = places.back().y + line;
  const bool changed = changed_since_divergence(ui.session);
  const std::string limit = changed          ? " before the constants were changed"
                            : over_limit > 1 ? ": dt is " + power_number(over_limit, 2) + " times the worst-case limit"
                                             : std::string();
  std::vector<std::string> texts{"The simulation diverged" + limit};
  if (!changed && over_limit > 1) texts.push_back("Diverged: dt is " + power_number(over_limit, 2) + " × the limit");
  const std::size_t telling = texts.size();  // those that say why
  texts.insert(texts.end(), {changed ? "Diverged before this change" : "The simulation diverged", "Diverged"});
  FoldedBanner folded;
  std::vector<std::pair<bool, std::string>> ways_to_say;
  if (high)
    for (std::size_t n = 0; n < telling; ++n)
      for (const bool under : {false, true}) ways_to_say.emplace_back(under, texts[n]);
  for (const bool under : {false, true})
    for (const std::string& text : texts) ways_to_say.emplace_back(under, text);
  for (const auto& [under, text] : ways_to_say) {
    const float words = icon + text_width(*ui.fonts.title, text);
    const float width = 2 * padding + (under ? std::max(words, buttons) : words + 2 * gap + buttons);
    folded = {text, shown, places, under, {std::min(width, most), (under ? line : 0) + rows + 2 * gap}};
    if (width <= most && (under || rows == line)) return folded;
  }
  return folded;
}

/// All that the banner needs to know before it is drawn: how high it is decides how much room the cloth has.
struct BannerPlan {
  std::vector<Way> ways;
  FoldedBanner folded;
  std::string happened, why;
  std::vector<ImVec2> places;
  float width = 0, height = 0, indent = 0;  ///< px, of the whole
  bool whole = false;
  bool strip = false;  ///< what is shown has a strip of its own
};

BannerPlan plan_banner(Ui& ui, const Divergence& divergence, glm::vec2 region) {
  constexpr float most_of_it = 0.4f, most_presented = 0.2f;  // of the region's height
  BannerPlan plan;
  const Preset& then = ui.session.simulation->diverged_preset();
  const Advice& advice = advice_for(then, ui);
  plan.ways = ways_out(ui, advice);
  const float most = region.x - ui.theme.px(24), padding = ui.theme.px(16), gap = ui.theme.px(6);
  plan.folded = folded_banner(ui, plan.ways, advice.largest_dt > 0 ? then.dt / advice.largest_dt : 0, most,
                              region.y > ui.theme.px(high_for_banner));
  plan.width = std::min(ui.theme.px(600), most);
  // In a narrow one the text begins under the icon.
  plan.indent = plan.width < ui.theme.px(least_banner) ? 0 : ui.theme.px(30);
  const float inner = plan.width - 2 * padding - plan.indent;
  const ImFont& text = *ui.fonts.text;
  plan.happened = in_lines(text, with_whole_terms(what_happened(divergence, then, advice.largest_dt)), inner);
  plan.why = in_lines(text, with_whole_terms(why_and_what_now(ui, divergence)), inner);
  plan.places = flow(ui, plan.ways, inner);
  plan.height = 2 * padding + ui.fonts.title->FontSize + 2 * gap + height_of(text, plan.happened) +
                height_of(text, plan.why) + ui.theme.px(12) + plan.places.back().y + ui.theme.px(30);
  plan.strip = plan.height <= (ui.presenting ? most_presented : most_of_it) * region.y;
  plan.whole = ui.banner_whole.value_or(plan.strip);
  return plan;
}

constexpr float banner_margin_at_1 = 8;  // above and below it in its strip

/// In the middle of the strip; what is too high for it reaches up over the cloth.
Box place_of_banner(const Ui& ui, const Box& region, glm::vec2 size) {
  const float left = std::round((region.lo.x + region.hi.x - size.x) / 2),
              foot = region.hi.y - ui.theme.px(banner_margin_at_1);
  return {{left, std::max(region.lo.y, foot - size.y)}, {left + size.x, std::max(region.lo.y, foot - size.y) + size.y}};
}

/// Below the view buttons where it has room there; otherwise those step aside, rather than being covered in part.
Box area_of_whole(Ui& ui, const BannerPlan& plan, Box region) {
  const float foot = region.hi.y - ui.theme.px(banner_margin_at_1), under = region.lo.y + ui.theme.px(under_views_at_1);
  const bool over = foot - under < plan.height;
  if (over != ui.banner_over_views) ui.banner_over_views = over, ui.draw_by = ui.now;
  if (!over) region.lo.y = under;
  return region;
}

void draw_folded(Ui& ui, const FoldedBanner& folded, const Box& box) {
  const Tokens& c = ui.theme.colors;
  const float padding = ui.theme.px(folded_padding_at_1), gap = ui.theme.px(8), icon = ui.theme.px(26),
              line = ui.theme.px(30);
  const ImFont& font = *ui.fonts.title;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float baseline = baseline_at(ui.fonts, box.lo.y + gap + line / 2), x = box.lo.x + padding;
  draw_on_baseline(draw, *ui.fonts.text, {x, baseline}, c.danger, icon_or(ui.fonts, icon::warning, "!"));
  draw_on_baseline(draw, font, {x + icon, baseline}, c.text, folded.words);
  const ImVec2 at = folded.under ? ImVec2(x, box.lo.y + gap + line)
                                 : ImVec2(x + icon + text_width(font, folded.words) + 2 * gap, box.lo.y + gap);
  way_buttons(ui, folded.ways, folded.places, at);
}

/// In a window of its own, over all else: what is higher than the cloth's place scrolls.
void draw_whole(Ui& ui, const BannerPlan& plan, const Box& box) {
  const Tokens& c = ui.theme.colors;
  const ImFont &title = *ui.fonts.title, &text = *ui.fonts.text;
  const float padding = ui.theme.px(16), gap = ui.theme.px(6), inset = ui.theme.px(2);
  ImGui::SetCursorScreenPos({box.lo.x, box.lo.y + inset});
  gui::begin_child("banner", {box.hi.x - box.lo.x, box.hi.y - box.lo.y - 2 * inset});
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 begin = ImGui::GetCursorScreenPos();
  float y = begin.y - inset + padding;
  const float left = begin.x + padding, x = left + plan.indent;
  draw_text(draw, text, {left, y}, c.danger, icon_or(ui.fonts, icon::warning, "!"));
  draw_text(draw, title, {left + ui.theme.px(30), y}, c.text, "The simulation diverged");
  y += title.FontSize + gap;
  draw_text(draw, text, {x, y}, c.text, plan.happened);
  y += height_of(text, plan.happened) + gap;
  draw_text(draw, text, {x, y}, c.quiet, plan.why);
  y += height_of(text, plan.why) + ui.theme.px(12);
  way_buttons(ui, plan.ways, plan.places, {x, y});
  ImGui::SetCursorScreenPos({x, y + plan.places.back().y + ui.theme.px(30) + padding - 2 * inset});
  ImGui::Dummy({1, 1});
  ImGui::SetCursorScreenPos({box.hi.x - ui.theme.px(38), box.lo.y + ui.theme.px(8)});
  if (quiet_button(ui, "fold", icon::close, "x", "Fold to one line, so that more of the cloth is visible"))
    ui.banner_whole = false;
  ImGui::EndChild();
}

}  // namespace

float banner_strip(Ui& ui, glm::vec2 region) {
  const auto& divergence = ui.session.simulation->divergence();
  if (!divergence) return 0;
  const BannerPlan plan = plan_banner(ui, *divergence, region);
  return (plan.whole && plan.strip ? plan.height : plan.folded.size.y) + 2 * ui.theme.px(banner_margin_at_1);
}

void banner(Ui& ui, const Box& region) {
  const auto& divergence = ui.session.simulation->divergence();
  if (!divergence) {
    ui.banner_over_views = false;
    return ui.banner_whole.reset();
  }
  const BannerPlan plan = plan_banner(ui, *divergence, region.hi - region.lo);
  if (!plan.whole) ui.banner_over_views = false;
  const Box area = plan.whole ? area_of_whole(ui, plan, region) : region;
  const float room = area.hi.y - area.lo.y - ui.theme.px(banner_margin_at_1);
  const Box box =
      place_of_banner(ui, area, plan.whole ? glm::vec2(plan.width, std::min(plan.height, room)) : plan.folded.size);
  danger_ground(ui, box, "banner");
  if (plan.whole) return draw_whole(ui, plan, box);
  draw_folded(ui, plan.folded, box);
}

}  // namespace tyglab
