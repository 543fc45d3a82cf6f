// The conditions of checks and answers, as a lab writes them. words_of() (lab.h) puts them into words.
#pragma once

#include <string_view>

#include "app/session/lab.h"

namespace tyglab {

/// Reads "k_s >= 180 N/m throughout", "integrator = euler", "error < 0.3 * before.error", "F_max < 0.1 N when torn >
/// 0". In the first step nothing can be asked of the one before. Throws LabError, which does not name the place.
Condition parse_condition(std::string_view value, bool first_step);

/// Reads "0.098 m within 10 %", "dt_crit within 0.0001" into a prediction: the answer, its unit and how far a number
/// may be off. Throws as parse_condition does.
void parse_answer(std::string_view value, bool first_step, Prediction& given);

/// "diverged = yes": a moment that has a verb of its own.
bool asks_divergence(const Condition& condition);

/// What a quantity is called on the card: "k_s", "Integrator".
std::string label_of(std::string_view name);

/// A word of an observable as people read it: "Verlet" for "verlet", "CPU" for "cpu".
std::string shown_word(std::string_view name, std::string_view word);

}  // namespace tyglab
