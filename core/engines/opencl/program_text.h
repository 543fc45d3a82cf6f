// The text of an engine's program: the files of kernels/, and after them a kernel for each sweep of the method.
#pragma once

#include <string>
#include <vector>

#include "core/integrators/scheme.h"

namespace tyglab::opencl {

/// A sweep's coefficients in the order in which its text names them: factor · dt^dt_power, over m for a term of a.
struct Coefficient {
  double factor;
  int dt_power;
  bool of_force;
};
std::vector<Coefficient> coefficients(const std::vector<Assignment>& assignments);

/// The sweep of the kernel `accelerations`: F/m of the first two vectors into a third.
inline constexpr int look_target = 2;
const Sweep& look();

/// All kernels for a scheme: sweep_0, sweep_1 …, start if it has one, accelerations, and those of kernels/. Text and
/// options depend on nothing that a slider changes.
std::string program_text(const Scheme& scheme);

}  // namespace tyglab::opencl
