// Numbers as text: quick, and the same in every locale.
#pragma once

#include <string>

namespace tyglab {

/// Appends `value` with that many significant digits. Text with 17 gives back the same double, with 9 the same float.
void append_number(std::string& text, double value, int digits = 17);

}  // namespace tyglab
