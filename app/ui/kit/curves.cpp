#include "app/ui/kit/curves.h"

#include "app/session/reference_curves.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <stdexcept>

namespace tyglab {

const Variable& variable(std::string_view key) {
  const auto list = variables();
  const auto it = std::find_if(list.begin(), list.end(), [&](const Variable& v) { return v.key == key; });
  if (it == list.end()) throw std::logic_error("no variable is called " + std::string(key));
  return *it;
}

glm::dvec3 vector_of(const ParticleReadout& r, std::string_view key) {
  if (key == "F_s") return r.F_s;
  if (key == "F_b") return r.F_b;
  if (key == "F_d") return r.F_d;
  if (key == "F_g") return r.F_g;
  if (key == "F_int") return r.F_int;
  if (key == "F_ext") return r.F_ext;
  if (key == "F") return r.F;
  if (key == "x") return r.x;
  if (key == "v") return r.v;
  return r.a;
}

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

std::vector<std::string> height_column_names() {
  std::vector<std::string> names{"y [m]"};
  for (std::string_view curve : ReferenceCurves::curves) names.push_back("y_" + std::string(curve) + " [m]");
  return names;
}

std::vector<std::string> force_column_names() {
  std::vector<std::string> names;
  for (std::string_view key : force_keys) names.push_back(std::string(key) + " [N]");
  return names;
}

std::array<double, Plots::forces_count> force_values(const ParticleReadout& r) {
  return {glm::length(r.F),   glm::length(r.F_s),   glm::length(r.F_b),  glm::length(r.F_d),
          glm::length(r.F_g), glm::length(r.F_int), glm::length(r.F_ext)};
}

std::array<double, Plots::forces_count> force_values(const ForceSummary& s) {
  return {s.F, s.F_s, s.F_b, s.F_d, s.F_g, s.F_int, s.F_ext};
}

}  // namespace tyglab
