// Breaks text into lines: at spaces, and within a formula or a quantity only if it is wider than a whole
// line.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace tyglab {

/// With no-break spaces within formulas ("F = −k·(x − x₀)") and quantities ("0.5 N").
std::string with_whole_terms(std::string text);

/// With a capital letter at the start, unless that is a symbol or a key.
std::string capitalised(std::string text);

/// The width of a piece of text.
using Measure = std::function<float(std::string_view)>;

/// The text with a line feed where each line ends; `width` in the unit of `measure`. A formula that is wider than a
/// line is broken before a relation sign, or else at any of its spaces; a single word that is wider is cut.
std::string broken_into_lines(std::string_view text, float width, const Measure& measure);

/// As much of the text as has that width, with an ellipsis where it was cut.
std::string shortened(const std::string& text, float width, const Measure& measure);

/// A name and what has become of it ("verlet, dt = 0.002 · diverged at t = 0.19 s"): on one line where they have room,
/// else on as many as they need, at most `most`. Where that is too little the name is shortened, never the state.
std::vector<std::string> name_lines(const std::string& name, const std::string& state, float width, std::size_t most,
                                    const Measure& measure);

}  // namespace tyglab
