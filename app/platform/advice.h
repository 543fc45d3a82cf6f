// Advice about graphics for the users of this system.
#pragma once

namespace tyglab {

/// A sentence for those whose driver has no OpenGL 3.3.
const char* driver_advice();
/// A sentence for those without a display.
const char* display_advice();

}  // namespace tyglab
