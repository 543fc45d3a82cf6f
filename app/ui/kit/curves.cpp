#include "app/ui/kit/chart.h"

namespace tyglab {

CurveStyle curve_style(const Tokens& c, std::string_view key) {
  if (key == "F_s") return {c.blue, LineStyle::solid, 1.8f};
  if (key == "F_b") return {c.green, LineStyle::dashed, 1.8f};
  if (key == "F_B") return {c.green, LineStyle::dash_dot_dot, 1.8f};
  if (key == "F_curl") return {c.green, LineStyle::sparse_dots, 2.2f};
  if (key == "F_d") return {c.magenta, LineStyle::dotted, 2.2f};
  if (key == "F_self") return {c.sky, LineStyle::long_dash, 1.8f};
  if (key == "F_slip") return {c.sky, LineStyle::dotted, 2.2f};
  if (key == "F_g") return {c.yellow, LineStyle::long_dash, 1.8f};
  if (key == "F_wind") return {c.vermilion, LineStyle::dash_dot_dot, 1.8f};
  if (key == "F_air") return {c.vermilion, LineStyle::sparse_dots, 2.2f};
  if (key == "F_int") return {c.sky, LineStyle::dash_dot, 1.8f};
  if (key == "F_ext") return {c.orange, LineStyle::sparse_dots, 2.4f};
  if (key == "v") return {c.vermilion, LineStyle::long_dash, 1.8f};
  if (key == "a") return {c.vermilion, LineStyle::dotted, 2.2f};
  return {c.text, LineStyle::solid, 1.2f};
}

CurveStyle integrator_style(const Tokens& c, std::string_view name) {
  struct Style {
    std::string_view name;
    unsigned dark, light;  ///< its color in dark and in light themes
    LineStyle line;
  };
  // The colors of two methods with the same line are far apart for the color-blind too (tests/app/theme_test.cpp).
  static constexpr Style styles[] = {{"exact", 0xD55E00, 0xB84300, LineStyle::solid},
                                     {"verlet", 0x4A90D9, 0x1F5FA8, LineStyle::solid},
                                     {"improved_euler", 0x009E73, 0x0A8A4A, LineStyle::solid},
                                     {"euler", 0xCC79A7, 0x9A2F6A, LineStyle::solid},
                                     {"semi_implicit_euler", 0xE69F00, 0xA27179, LineStyle::dashed},
                                     {"velocity_verlet", 0x73DFFF, 0x4589A5, LineStyle::long_dash},
                                     {"rk4", 0xF0E442, 0x4C3C00, LineStyle::dash_dot},
                                     {"rkn4", 0xA1B058, 0x114D30, LineStyle::dash_dot_dot},
                                     {"force_gradient4", 0xB0703C, 0x4A3AE0, LineStyle::long_dash},
                                     {"damped_verlet", 0xFE02DB, 0xEB09CD, LineStyle::sparse_dots},
                                     {"dopri5", 0x00FFE8, 0x281747, LineStyle::dash_dot_dot},
                                     {"rkc2", 0x47FE0E, 0x0202FE, LineStyle::solid},
                                     {"implicit_euler", 0xD23E52, 0x440802, LineStyle::dashed},
                                     {"implicit_midpoint", 0x6C68E4, 0x916DDE, LineStyle::dotted},
                                     {"tr_bdf2", 0xF4C7A8, 0x550073, LineStyle::dash_dot},
                                     {"projective_dynamics", 0xA13DFF, 0x7A8800, LineStyle::dashed},
                                     {"vbd", 0x6D7873, 0xFC045C, LineStyle::sparse_dots},
                                     {"xpbd", 0xA5FF80, 0x06232C, LineStyle::dotted}};
  for (const Style& style : styles)
    if (style.name == name) return {rgb(c.light ? style.light : style.dark), style.line, 1.8f};
  return {c.quiet, LineStyle::solid, 1.8f};
}

CurveStyle copy_style(const Tokens& c, std::string_view method, std::optional<std::size_t> seat) {
  struct Style {
    unsigned dark, light;
    LineStyle line;
  };
  // Far from the colors of all methods, and from each other (tests/app/theme_test.cpp).
  static constexpr std::array<Style, Lockstep::most> own{{{0xF7369C, 0xBE00FC, LineStyle::dashed},
                                                          {0xBFFC02, 0xFF0001, LineStyle::long_dash},
                                                          {0x028E01, 0xF02796, LineStyle::dotted},
                                                          {0xD871FB, 0xCC4C4E, LineStyle::dash_dot},
                                                          {0xD1FFC6, 0x582F43, LineStyle::sparse_dots}}};
  constexpr float width = 2;
  if (seat) return {rgb(c.light ? own[*seat].light : own[*seat].dark), own[*seat].line, width};
  CurveStyle style = integrator_style(c, method);
  style.width = width;
  return style;
}

}  // namespace tyglab
