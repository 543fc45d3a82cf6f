// Names of the integrators there are. Apart from the schemes, so that presets can be checked without them.
#pragma once

#include <span>
#include <string_view>

namespace tyglab {

std::span<const std::string_view> integrator_names();
bool is_integrator(std::string_view name);

}  // namespace tyglab
