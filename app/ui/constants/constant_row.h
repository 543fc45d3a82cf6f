// One constant on one line: symbol, slider, value, unit, in aligned columns.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "app/ui/state/ui.h"
#include "core/model/notation.h"

namespace tyglab {

/// Draws the row of a constant of the preset; changes become requests. Rows without a slider (text) are not for here.
void constant_row(Ui& ui, const PresetRow& row);
/// The same for body `index`.
void body_row(Ui& ui, const BodyRow& row, int index);

/// A line whose slider column `content` fills (combos, buttons): a plain label stands where symbols do.
void labeled_row(Ui& ui, const char* label, const std::function<void(float width)>& content);

/// "equation (2.5) of the report “Simulering av tyg” (2012)": a number alone would not say where to look.
std::string equation_of_report(std::string_view equation);

/// Height of a row and width of its columns, at the present scale.
struct RowColumns {
  float height, symbol, value, unit, gap;
};
RowColumns row_columns(const Ui& ui);

}  // namespace tyglab
