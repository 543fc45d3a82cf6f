#include "app/ui/constants/constants_panel.h"

#include <algorithm>
#include <cmath>

#include "app/base/text.h"
#include "core/integrators/scheme.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

double value_of(const Preset& preset, std::string_view key) {
  for (const ZonedConstant& zoned : zoned_constants(preset))
    if (zoned.key == key) return preset.*zoned.field;
  return 0;
}

std::string no_part_of_it(std::string_view key) {
  return key == "L" ? ": the largest frequency does not depend on rest lengths" : "";
}

/// A border in the digits in which it is worth saying.
std::string border_text(double value, std::string_view unit) {
  return quantity(value, unit, 3);
}

/// "stable in any shape up to 133 N/m, depends on the shape up to 1600 N/m, unstable in every shape above that".
std::string list_of(const std::vector<ZoneSpan>& zones, Kind kind, std::string_view unit) {
  std::string text;
  for (std::size_t n = 0; n < zones.size(); ++n) {
    text += (n > 0 ? ", " : "") + std::string(zone_name(zones[n].zone, kind));
    text += n + 1 < zones.size() ? " up to " + border_text(zones[n].to, unit) : " above that";
  }
  return text;
}

}  // namespace

ImU32 zone_color(const Tokens& c, Zone zone) {
  return zone == Zone::stable ? c.good : zone == Zone::depends ? c.warning : c.danger;
}

void draw_zone(Ui& ui, Zone zone, ImVec2 lo, ImVec2 hi) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImU32 color = zone_color(ui.theme.colors, zone);
  const float thin = ui.theme.px(2), tall = hi.y - lo.y;
  if (zone == Zone::stable) return draw.AddRectFilled(lo, {hi.x, lo.y + thin}, faded(color, 0.7f));
  draw.PushClipRect(lo, hi, true);
  if (zone == Zone::depends) {
    const float dash = ui.theme.px(6), apart = ui.theme.px(9);
    for (float x = lo.x; x < hi.x; x += apart) draw.AddRectFilled({x, lo.y}, {x + dash, lo.y + ui.theme.px(3)}, color);
  } else {
    draw.AddRectFilled(lo, hi, faded(color, 0.55f));
    for (float x = lo.x - tall, apart = ui.theme.px(5); x < hi.x; x += apart)
      draw.AddLine({x, hi.y}, {x + tall, lo.y}, color, ui.theme.px(1.6f));
  }
  draw.PopClipRect();
}

void draw_zones(Ui& ui, std::string_view key, const SliderScale& scale, ImVec2 lo, ImVec2 hi) {
  const auto& limits = ui.session.studies.stability.limits();
  if (!limits || ui.session.auto_dt) return;
  const auto zones = limits->zones.find(key);
  if (zones == limits->zones.end() || std::isinf(limits->any)) return;
  const float top = std::round((lo.y + hi.y) / 2 + ui.theme.px(9)), foot = top + ui.theme.px(4);
  for (const ZoneSpan& span : zones->second) {
    const auto at = [&](double value) {
      return std::round(lo.x + float(std::clamp(slider_position(scale, value), 0.0, 1.0)) * (hi.x - lo.x));
    };
    const float from = at(span.from), to = at(span.to);
    if (to > from) draw_zone(ui, span.zone, {from, top}, {to, foot});
  }
}

std::string zone_words(const StabilityLimits& limits, std::string_view key, std::string_view unit) {
  const auto found = limits.zones.find(key);
  if (found == limits.zones.end()) return "";
  const std::vector<ZoneSpan>& zones = found->second;
  const double value = value_of(limits.of, key);
  const auto here =
      std::find_if(zones.begin(), zones.end(), [&](const ZoneSpan& z) { return value >= z.from && value <= z.to; });
  if (here == zones.end() || std::isinf(limits.any)) return "";
  const Kind kind = limits.of.kind;
  std::string now(zone_name(here->zone, kind));
  now.front() = char(now.front() - 'a' + 'A');
  const std::string part = part_words(limits, limits.of.dt);
  const std::string method(scheme(limits.of.integrator).title), name(key);
  std::string text = now + (part.empty() ? "." : ": " + part) + "\n" + method + (key == "dt" ? "" : " at this dt");
  if (zones.size() == 1)
    return text + ": " + std::string(zone_name(here->zone, kind)) + ", whatever " + name + " is" + no_part_of_it(key) +
           ".";
  return text + ", as " + name + " grows: " + list_of(zones, kind, unit) + ".";
}

}  // namespace tyglab
