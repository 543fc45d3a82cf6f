// The slider and the typed value of a constant.
#pragma once

#include "app/ui/kit/ui_context.h"
#include "core/model/notation.h"

namespace tyglab {

/// What a slider spans. A logarithmic one that starts at 0 keeps a small stretch at its left end for 0 itself.
struct SliderScale {
  double min, max;
  Scale scale = Scale::linear;
  bool integer = false;
  double low = 0;  ///< of a logarithmic one that starts at 0: the least other value
};
/// The slider of a constant whose preset has that value.
SliderScale slider_scale(const PresetRow& row, double preset_value);
/// The same scale, longer at the one side on which `value` lies beyond it, by whole decades (a linear one doubles), but
/// within the row's limits: what stands at the other end stays there, and 0 at the left.
SliderScale grown(SliderScale scale, const PresetRow& row, double value);
/// Place of a value on the slider, 0 to 1.
double slider_position(const SliderScale& scale, double value);
/// The value there, rounded to that many significant digits.
double slider_value(const SliderScale& scale, double position, int digits = 3);

struct SliderResult {
  bool changed = false;   ///< `value` is new
  bool finished = false;  ///< the drag (or the key) is over
  bool reset = false;     ///< double click: back to the preset's value
  double value = 0;
  unsigned typed = 0;  ///< the field in which Enter gave it; 0: not given so
};

/// Draws it at the cursor and takes mouse and keys. Shift drags ten times finer.
SliderResult slider(UiContext& ui, const SliderScale& scale, double value, float width, float height);

/// What was typed there is not accepted: the field keeps the keys, with all of its text selected.
void type_again(SliderState& state, unsigned field);

/// A value that is dragged sideways (`scale` tells how far) or typed: component of a vector.
SliderResult drag_cell(UiContext& ui, const char* id, const SliderScale& scale, double value, float width, float height,
                       std::string_view unit = {});

/// A number that a double click or Ctrl+click lets one type. `shown` is its text; `unit` may be typed after it.
SliderResult value_cell(UiContext& ui, const char* id, double value, std::string_view shown, float width, float height,
                        std::string_view unit = {});

}  // namespace tyglab
