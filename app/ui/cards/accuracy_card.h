// What linear theory and trial runs say of the present settings, as two cards of the plots column.
#pragma once

#include <string>

#include "app/ui/kit/chart.h"
#include "app/ui/state/ui.h"

namespace tyglab {

/// Growth of an oscillation per step over ω·dt, with the cloth's fastest modes marked.
void stability_card(Ui& ui, float height);
float stability_card_height(const Ui& ui, float width);

/// Error of the present settings and of other methods over their run time.
void accuracy_card(Ui& ui, float height);
float accuracy_card_height(const Ui& ui, float width);

/// The chart of a study: error over cost, a line for each method, the present settings as a disc of their own.
Chart accuracy_chart(const Tokens& colors, const AccuracyStudy& study);
/// Its sentence: "Verlet: error 2.1e-05 m (rms) over the 0.25 s from t = 1.2 s; …"
std::string accuracy_words(const AccuracyStudy& study);
/// The chart of a method's spectral radius.
Chart stability_chart(const Tokens& colors, const StabilityLimits& limits);

}  // namespace tyglab
