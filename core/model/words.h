// The spelling of words and numbers in preset files.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "core/model/preset.h"

namespace tyglab {

/// In the order of the enumerations in preset.h.
inline constexpr std::array<std::string_view, 2> kind_names{"cloth", "one_weight"};
inline constexpr std::array<std::string_view, 7> pin_names{"none",        "top_row",  "top_corners", "four_corners",
                                                           "left_column", "boundary", "list"};
inline constexpr std::array<std::string_view, 2> shape_names{"sphere", "plane"};
inline constexpr std::array<std::string_view, 2> engine_names{"cpu", "opencl"};
inline constexpr std::array<std::string_view, 2> precision_names{"float", "double"};
constexpr std::string_view name_of(Kind v) {
  return kind_names[std::size_t(v)];
}
constexpr std::string_view name_of(Pins::Mode v) {
  return pin_names[std::size_t(v)];
}
constexpr std::string_view name_of(Body::Shape v) {
  return shape_names[std::size_t(v)];
}
constexpr std::string_view name_of(EngineKind v) {
  return engine_names[std::size_t(v)];
}
constexpr std::string_view name_of(Precision v) {
  return precision_names[std::size_t(v)];
}
/// As people call it.
constexpr std::string_view title_of(EngineKind v) {
  return v == EngineKind::cpu ? "CPU" : "OpenCL";
}
/// Sections of a preset file.
inline constexpr std::array<std::string_view, 6> section_names{"cloth",  "forces", "tearing",
                                                               "bodies", "solver", "view"};

/// Shortest text that reads back as the same number; without an exponent where a person would write none.
std::string shortest_number(double v);

}  // namespace tyglab
