// What the plots collect.
#pragma once

namespace tyglab {

struct App;

/// Collects the frame's values, only for plots that are shown, and only when the simulation moved.
void sample(App& app);

}  // namespace tyglab
