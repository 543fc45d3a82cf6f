// The notation table has one row per constant. Presets, `--set`, panels, tooltips, CSV headers and docs/notation.md
// read it; a new constant is one field in preset.h and one row in notation.cpp.
#pragma once

#include <charconv>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/model/effect.h"
#include "core/model/preset.h"

namespace tyglab {

enum class Scale { linear, logarithmic };

/// Field of T (Preset or Body) that a row stands for.
template <class T>
using FieldOf = std::variant<double T::*, int T::*, glm::dvec3 T::*, std::string T::*>;

template <class T>
struct Row {
  std::string_view section;   ///< block of the preset file: "cloth", "forces", …; empty at the top level
  std::string_view key;       ///< inner key, also that of --set; with its section where another one has the same
  std::string_view symbol;    ///< the report's symbol, subscript after '_': "k_s", "F_max"
  std::string_view quantity;  ///< English
  std::string_view storhet;   ///< Swedish, the report's word where it has one
  std::string_view unit;      ///< SI, empty if dimensionless
  FieldOf<T> field;
  double min = 0, max = 0;      ///< allowed range, ends included (numbers alone)
  Scale scale = Scale::linear;  ///< of its slider
  Effect effect = Effect::force;
  std::string_view equation;  ///< number in the report, empty where it has none
  std::string_view help;      ///< one sentence: what it does
  bool zero_is_off = false;   ///< 0 means never
  Kind only = Kind::cloth;    ///< with only_one_kind: the kind that uses it
  bool only_one_kind = false;
  EffectSet of_weight = {};         ///< additional effect of a change for the mass on a spring
  double usual = 1;                 ///< a usual value, where the default is 0
  std::string_view otherwise = {};  ///< the key of the constant that counts while this one is `left_out`; empty: it has
                                    ///< a value in every preset
  /// The key as its section of the file has it.
  std::string_view key_in_section() const {
    const std::size_t dot = key.find('.');
    return dot == std::string_view::npos ? key : key.substr(dot + 1);
  }
};

using PresetRow = Row<Preset>;
using BodyRow = Row<Body>;

/// All numeric and text constants of a preset in the order of the report and of the panel.
std::span<const PresetRow> notation();
/// A heading of the panel: its constants in order, then those of `block`, a section of the preset file, that no heading
/// lists.
struct Heading {
  const char* name;
  std::string_view block;
  std::vector<std::string_view> keys;
};
std::span<const Heading> headings();
/// The heading that lists the constant; "constants" if none does.
std::string_view heading_of(const PresetRow& row);
/// Constants of a body; `c`, `r` belong to spheres, `y` to planes.
std::span<const BodyRow> body_notation();
/// Row with that inner key, or nullptr.
const PresetRow* find_row(std::string_view key);
const BodyRow* find_body_row(std::string_view key);
/// Whether bodies of that shape have a value of that name.
bool shape_has(Body::Shape shape, std::string_view key);

/// A derived variable of table B.1 (F, F_s, …, x, ẋ, ẍ): read out, not set.
struct Variable {
  std::string_view key;     ///< "F_s"; ẋ is "v", ẍ is "a"
  std::string_view symbol;  ///< to typeset: "F_s", "x'" for ẋ, "x''" for ẍ
  std::string_view quantity;
  std::string_view storhet;
  std::string_view unit;
  std::string_view equation;
  std::string_view help;
};
std::span<const Variable> variables();

/// The nearest of `known` to `word` by edit distance, if any is near enough to be meant.
std::optional<std::string_view> nearest(std::string_view word, std::span<const std::string_view> known);
/// "; did you mean rows?" where one is; otherwise that text.
std::string did_you_mean(std::string_view word, std::span<const std::string_view> known, const std::string& otherwise);

/// The default of a number, or what is usual where that is 0.
double usual_value(const PresetRow& row);
/// Whether the preset leaves the constant out, so that that of Row::otherwise counts.
bool is_absent(const PresetRow& row, const Preset& preset);
/// Whether the value stands for that.
template <class T>
bool is_absent(const Row<T>& row, double value) {
  return !row.otherwise.empty() && value == left_out;
}
/// The keys of the constants that act in its place, "k_warp, k_weft and k_shear", where all of them are set and it has
/// no effect; otherwise empty.
std::string replaced_by(const PresetRow& row, const Preset& preset);
/// Slider range about three decades round `value` (logarithmic) or round the value (linear), inside the allowed range;
/// starts at 0 where 0 is allowed.
struct SliderRange {
  double min, max;
};
SliderRange slider_range(const PresetRow& row, double preset_value);

/// The preset with each number that is out of its range moved to the nearer end.
Preset nearest_allowed(Preset preset);

/// docs/notation.md, generated.
std::string notation_markdown();

// Formats numbers and sentences for people: panels, messages, reports.

/// Up to that many significant digits, "310", "0.002", "1.2e-4": without an exponent from 0.001 to 100,000, where every
/// digit before the point is written.
std::string short_number(double value, int digits = 4);
/// "1.20e-04", as printf writes it, as "1.20e-4".
std::string short_exponent(std::string text);
/// Rounded to that many significant digits.
double rounded(double value, int digits);
/// The text with a capital letter and a period: "it fell" becomes "It fell.".
std::string sentence(std::string text);
/// The texts of a range's elements, one after the other: "cpu, opencl".
template <class Range, class Text = std::identity>
std::string joined(Range&& elements, std::string_view between = ", ", const Text& text_of = {}) {
  std::string all;
  bool first = true;
  for (const auto& element : elements) {
    if (!first) all += between;
    all += std::invoke(text_of, element);
    first = false;
  }
  return all;
}

// Reads numbers from text, independently of the locale.

/// std::from_chars, where the library has it for doubles; otherwise the same of what C reads.
std::from_chars_result read_number(const char* first, const char* last, double& value);

}  // namespace tyglab
