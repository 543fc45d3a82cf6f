// The spelling of words and numbers in preset files, and of numbers with units for people.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/model/preset.h"

namespace tyglab {

/// In the order of the enumerations in preset.h.
inline constexpr std::array<std::string_view, 2> kind_names{"cloth", "one_weight"};
inline constexpr std::array<std::string_view, 7> pin_names{"none",        "top_row",  "top_corners", "four_corners",
                                                           "left_column", "boundary", "list"};
inline constexpr std::array<std::string_view, 5> shape_names{"sphere", "plane", "box", "capsule", "cylinder"};
inline constexpr std::array<std::string_view, 3> engine_names{"cpu", "opencl", "plain"};
inline constexpr std::array<std::string_view, 2> precision_names{"float", "double"};
/// Values of solver.contact: within the step, at its end (the report's rule), or in steps that end at each impact.
inline constexpr std::array<std::string_view, 3> contact_names{"local", "step", "global"};
/// As people call them.
inline constexpr std::array<const char*, contact_names.size()> contact_titles{"when met", "at end of step",
                                                                              "split step"};
/// What an overloaded spring does: it breaks, and triangles vanish with it (the report's rule), or it parts the cloth.
inline constexpr std::array<std::string_view, 2> tearing_names{"springs", "split"};
inline constexpr std::array<const char*, tearing_names.size()> tearing_titles{"springs break", "cloth parts"};
/// What keeps the cloth from passing through itself: nothing, a force, or that force and a bound of its motion.
inline constexpr std::array<std::string_view, 3> self_names{"off", "repel", "guard"};
inline constexpr std::array<const char*, self_names.size()> self_titles{"cross", "repel", "guard"};
constexpr std::string_view name_of(Kind v) {
  return kind_names[std::size_t(v)];
}
constexpr std::string_view name_of(Pins::Mode v) {
  return pin_names[std::size_t(v)];
}
constexpr std::string_view name_of(Body::Shape v) {
  return shape_names[std::size_t(v)];
}
/// As a title.
constexpr std::string_view title_of(Body::Shape v) {
  constexpr std::array<std::string_view, 5> titles{"Sphere", "Plane", "Box", "Capsule", "Cylinder"};
  return titles[std::size_t(v)];
}
constexpr std::string_view name_of(EngineKind v) {
  return engine_names[std::size_t(v)];
}
constexpr std::string_view name_of(Precision v) {
  return precision_names[std::size_t(v)];
}
/// As people call it.
constexpr std::string_view title_of(EngineKind v) {
  return v == EngineKind::cpu ? "CPU" : v == EngineKind::opencl ? "OpenCL" : "plain";
}
/// Sections of a preset file.
inline constexpr std::array<std::string_view, 7> section_names{"cloth",  "forces", "tearing", "contact",
                                                               "bodies", "solver", "view"};

/// Shortest text that reads back as the same number; without an exponent where a person would write none.
std::string shortest_number(double v);

/// short_number (notation.h) for people: "1.2·10⁻⁴", "18,000".
std::string power_number(double value, int digits = 4);
/// "1.2e-4" as "1.2·10⁻⁴".
std::string with_power(std::string text);
/// "1,234,567".
std::string grouped(std::int64_t count);
/// A unit in which values of that size need no exponent: "mN" below 0.1 N, "µN" below 0.1 mN. Only seconds, meters,
/// newtons, joules and what begins with them are divided; kg become g and mg.
struct ScaledUnit {
  double size;  ///< in the unit itself: 1e-3
  std::string name;
};
ScaledUnit scaled_unit(double largest, std::string_view unit);
/// A value in a sentence: "0.002 s", "26 µs", "4.04 mN/m", "3·10⁷ N/m", "12". The unit is divided where the number
/// would need an exponent.
std::string quantity(double value, std::string_view unit, int digits = 4);

}  // namespace tyglab
