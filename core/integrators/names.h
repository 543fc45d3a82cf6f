// The names of all integrators, separate from the schemes, so presets can be checked without them.
#pragma once

#include <span>
#include <string_view>

namespace tyglab {

std::span<const std::string_view> integrator_names();
bool is_integrator(std::string_view name);

}  // namespace tyglab
