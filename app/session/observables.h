// The quantities that a lab's checks can use: one row each, and every constant of the notation table.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/studies/studies.h"

namespace tyglab {

struct Session;

struct Observable {
  std::string_view name = {};
  std::string_view unit = {};     ///< SI, empty if it has none
  std::string_view meaning = {};  ///< a sentence
  std::string_view hint = {};     ///< how to make it known, empty if it always is
  std::string_view place = {};    ///< its place in the window, empty if it has none
  /// Its value, none while it is not known; null for words.
  std::optional<double> (*number)(Session&) = nullptr;
  bool Wants::*needs = nullptr;  ///< the study that computes it, if any; not those that the user opens
  /// It is computed in the background, for one moment or for the constants, so it is not available in every step.
  bool measured = false;
  bool Wants::*shown_by = nullptr;  ///< the study that does so, where somebody has to open it on purpose
  std::string_view (*word)(const Session&) = nullptr;
  std::span<const std::string_view> (*words)() = nullptr;  ///< those it can be
  std::string_view label = {};                             ///< what it is called on the card, where not by its name
  /// For the words "no" and "yes": the sentences of a check for each, and of the present state.
  std::array<std::string_view, 2> asked = {}, present = {};
};

std::span<const Observable> observables();
/// The row of that name, or nullptr. Constants of the notation table ("k_s", "W.x") are no rows.
const Observable* find_observable(std::string_view name);

/// Whether a check may name it: a row, or a number of the notation table.
bool is_observable(std::string_view name);
bool is_word(std::string_view name);
/// Whether it is computed in the background, so that no check can apply to every step.
bool is_measured(std::string_view name);
/// Its place in the window: "Springs", the heading among the constants, or "Energy card"; empty if it has none.
std::string place_of(std::string_view name);
std::string_view unit_of(std::string_view name);
/// Every name a check may use, for "did you mean".
std::vector<std::string_view> observable_names();

/// Its value; none while it is not known.
std::optional<double> observe(Session& session, std::string_view name);
std::string_view observe_word(const Session& session, std::string_view name);

/// The table of docs/labs/README.md.
std::string observables_markdown();

}  // namespace tyglab
