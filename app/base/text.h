// Text: links to presets, numbers as people read them, lines.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/notation.h"
#include "core/model/preset.h"

// The constants of an experiment as a link, "#hanging&k_s=100&W=[0,0,0.02]": a shipped preset and its differences,
// written as for --set. A page of Tyglab shows the link at the end of its address; the command line accepts the whole
// address or the link alone.

namespace tyglab {

/// The example link in messages and in help: a cloth that stays stable.
constexpr std::string_view example_link = "#hanging&k_s=100";

/// Whether a word on the command line, or dropped on the window, is a link or an address rather than a name or a file.
bool is_link(std::string_view text);

/// The content of a link.
struct LinkedPreset {
  std::string name;                   ///< of a shipped preset
  std::vector<std::string> settings;  ///< "k_s=100"
};
/// Reads a link, or an address with one in it. Its constants are those of the preset that it names; else of the one
/// that the address names before the #, as in ?embed&preset=flag#k_s=100; else of the default preset. Throws
/// PresetError: the link names no shipped preset, something in it is no setting, or the address holds no experiment, as
/// that of a file does.
LinkedPreset read_link(std::string_view text);

/// The preset itself. Throws PresetError: a setting is wrong.
Preset linked_preset(const LinkedPreset& link);

/// The link to these constants. `label`: name of the shipped preset from which they were made, or any other text. The
/// link names only a shipped texture, and its numbers omit the noise of their last bits.
std::string link_to(const Preset& preset, const std::string& label);

// Formats and reads numbers in panels; short_number of notation.h formats constants.

/// A steady read-out, always with three significant digits: "3.41·10⁻³", "12.0".
std::string steady_number(double value);
/// "(1.00, -2.50·10⁻³, 0)": each as steady_number.
std::string steady_vector(const glm::dvec3& value);
/// A number of a table whose unit suits its largest: three digits of that one, three decimals of what is far smaller.
std::string table_number(double value);
/// A simulated time, with as many decimals as show a single step of dt (three at least): "0.4213".
std::string time_number(double t, double dt);
/// Significant digits, four at least, that show the ends of a span with an error of a twentieth of the span at most.
int digits_apart(double lo, double hi);
/// Parses a typed number; a comma counts as a decimal point. After it may stand the unit, or one that differs from it
/// by an SI prefix ("2 ms" where s are meant, "9,8 cm"), which is converted. None if it is not a number or has another
/// unit.
std::optional<double> typed_number(std::string_view text, std::string_view unit = {});

// Breaks text into lines: at spaces, and within a formula or a quantity only if it is wider than a whole
// line.

/// With no-break spaces within formulas ("F = −k·(x − x₀)") and quantities ("0.5 N").
std::string with_whole_terms(std::string text);

/// Instructions for mouse and keys, rewritten for a finger on a touch screen.
std::string for_fingers(std::string_view text);

/// With a capital letter at the start, unless that is a symbol or a key.
std::string capitalised(std::string text);

/// The width of a piece of text.
using Measure = std::function<float(std::string_view)>;

/// The text with a line feed where each line ends; `width` in the unit of `measure`. A formula that is wider than a
/// line is broken before a relation sign, or else at any of its spaces; a single word that is wider is cut.
std::string broken_into_lines(std::string_view text, float width, const Measure& measure);

/// The part of the text that fits into that width, with an ellipsis where it was cut.
std::string shortened(const std::string& text, float width, const Measure& measure);

/// A name and its state ("verlet, dt = 0.002 · diverged at t = 0.19 s"): on one line if they fit, else on as many as
/// they need, at most `most`. If that is too little, the name is shortened, never the state.
std::vector<std::string> name_lines(const std::string& name, const std::string& state, float width, std::size_t most,
                                    const Measure& measure);

}  // namespace tyglab
