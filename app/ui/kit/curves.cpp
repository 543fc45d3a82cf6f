#include "app/ui/kit/curves.h"

namespace tyglab {

CurveStyle curve_style(const Tokens& c, std::string_view key) {
  if (key == "F_s") return {c.blue, LineStyle::solid, 1.8f};
  if (key == "F_b") return {c.green, LineStyle::dashed, 1.8f};
  if (key == "F_d") return {c.magenta, LineStyle::dotted, 2.2f};
  if (key == "F_g") return {c.yellow, LineStyle::long_dash, 1.8f};
  if (key == "F_int") return {c.sky, LineStyle::dash_dot, 1.8f};
  if (key == "F_ext") return {c.orange, LineStyle::sparse_dots, 2.4f};
  if (key == "v") return {c.vermilion, LineStyle::long_dash, 1.8f};
  if (key == "a") return {c.vermilion, LineStyle::dotted, 2.2f};
  return {c.text, LineStyle::solid, 1.2f};
}

CurveStyle integrator_style(const Tokens& c, std::string_view name) {
  struct Style {
    std::string_view name;
    ImU32 Tokens::*color;
    LineStyle line;
  };
  // Implicit methods are dashed.
  static constexpr Style styles[] = {{"verlet", &Tokens::blue, LineStyle::solid},
                                     {"improved_euler", &Tokens::green, LineStyle::solid},
                                     {"euler", &Tokens::magenta, LineStyle::solid},
                                     {"semi_implicit_euler", &Tokens::orange, LineStyle::solid},
                                     {"velocity_verlet", &Tokens::sky, LineStyle::solid},
                                     {"rk4", &Tokens::yellow, LineStyle::solid},
                                     {"rkn4", &Tokens::text, LineStyle::solid},
                                     {"dopri5", &Tokens::yellow, LineStyle::long_dash},
                                     {"xpbd", &Tokens::orange, LineStyle::dotted},
                                     {"implicit_euler", &Tokens::magenta, LineStyle::dashed},
                                     {"implicit_midpoint", &Tokens::sky, LineStyle::dashed},
                                     {"tr_bdf2", &Tokens::green, LineStyle::dashed},
                                     {"exact", &Tokens::vermilion, LineStyle::solid}};
  for (const Style& style : styles)
    if (style.name == name) return {c.*style.color, style.line, 1.8f};
  return {c.quiet, LineStyle::solid, 1.8f};
}

CurveStyle copy_style(const Tokens& c, std::optional<std::size_t> seat) {
  static constexpr std::array<ImU32 Tokens::*, Lockstep::most> colors{&Tokens::orange, &Tokens::green, &Tokens::magenta,
                                                                      &Tokens::yellow, &Tokens::vermilion};
  static constexpr std::array<LineStyle, Lockstep::most> lines{
      LineStyle::dashed, LineStyle::long_dash, LineStyle::dotted, LineStyle::dash_dot, LineStyle::sparse_dots};
  if (!seat) return {c.sky, LineStyle::solid, 2};
  return {c.*colors[*seat], lines[*seat], 2};
}

}  // namespace tyglab
