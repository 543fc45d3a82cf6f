#include "app/ui/constants/zones.h"

#include <algorithm>
#include <cmath>

#include "app/base/numbers.h"
#include "core/integrators/scheme.h"

namespace tyglab {
namespace {

ImU32 zone_color(const Tokens& c, Zone zone) {
  return zone == Zone::stable ? c.good : zone == Zone::near ? c.warning : c.danger;
}

/// Color is never the only sign: what is unstable is hatched and thicker.
void draw_span(Ui& ui, Zone zone, ImVec2 lo, ImVec2 hi) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImU32 color = zone_color(ui.theme.colors, zone);
  if (zone != Zone::unstable) {
    draw.AddRectFilled(lo, {hi.x, lo.y + ui.theme.px(2)}, faded(color, zone == Zone::stable ? 0.7f : 1));
    return;
  }
  draw.PushClipRect(lo, hi, true);
  draw.AddRectFilled(lo, hi, faded(color, 0.55f));
  const float tall = hi.y - lo.y, apart = ui.theme.px(5);
  for (float x = lo.x - tall; x < hi.x; x += apart) draw.AddLine({x, hi.y}, {x + tall, lo.y}, color, ui.theme.px(1.6f));
  draw.PopClipRect();
}

double value_of(const Preset& preset, std::string_view key) {
  for (const auto& zoned : zoned_cloth)
    if (zoned.key == key) return preset.*zoned.field;
  return preset.k;
}

std::string no_part_of_it(std::string_view key) {
  return key == "L" ? ": the largest frequency does not depend on rest lengths" : "";
}

}  // namespace

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
    if (to > from) draw_span(ui, span.zone, {from, top}, {to, foot});
  }
}

std::string zone_words(const StabilityLimits& limits, std::string_view key, std::string_view unit) {
  const auto found = limits.zones.find(key);
  if (found == limits.zones.end()) return "";
  const std::vector<ZoneSpan>& zones = found->second;
  const std::string method(scheme(limits.of.integrator).title), name(key);
  const auto quantity = [&](double value) {
    return name + " = " + short_number(rounded(value, 3)) + " " + std::string(unit);
  };
  const double value = value_of(limits.of, key);
  const auto here =
      std::find_if(zones.begin(), zones.end(), [&](const ZoneSpan& z) { return value >= z.from && value <= z.to; });
  if (here == zones.end()) return "";
  const auto unstable = [](const ZoneSpan& z) { return z.zone == Zone::unstable; };
  if (std::none_of(zones.begin(), zones.end(), unstable)) {
    if (std::isinf(limits.any)) return "";
    return method + " is stable at this dt, whatever " + name + " is" + no_part_of_it(key) + ".";
  }
  const std::string others = key == "dt" ? "" : key == "k_d" ? " at this dt" : " at this dt; implicit Euler is not";
  if (!unstable(*here)) {
    const auto above = std::find_if(here, zones.end(), unstable);
    if (above != zones.end()) return method + " is unstable above " + quantity(above->from) + others + ".";
    const auto below = std::find_if(std::make_reverse_iterator(here), zones.rend(), unstable);
    return method + " is unstable below " + quantity(below->to) + others + ".";
  }
  std::string text = method + " is unstable here";
  if (here != zones.begin()) return text + "; it is stable below " + quantity(here->from) + ".";
  if (here + 1 != zones.end()) return text + "; it is stable above " + quantity(here->to) + ".";
  return text + ", whatever " + name + " is" + no_part_of_it(key) + ".";
}

}  // namespace tyglab
