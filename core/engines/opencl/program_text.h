// The text of an engine's program: the files of kernels/, followed by a kernel for each sweep of the method.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/integrators/scheme.h"
#include "core/model/preset.h"

namespace tyglab::opencl {

/// A coefficient of a sweep, factor · dt^dt_power, divided by m for a term of a; in the order of the sweep's text.
struct Coefficient {
  double factor;
  int dt_power;
  bool of_force;
};
std::vector<Coefficient> coefficients(const std::vector<Assignment>& assignments);

/// A part of a step: one launch, or the solution of an implicit stage.
enum class Work { forces, sums, solution };
struct Pass {
  Work work;    ///< a sweep; assignments without a force; the stage that the sweep `solves`
  Sweep sweep;  ///< with the assignments of this pass
};
std::vector<Pass> passes(const Scheme& scheme);

/// The sweep of the kernel `residual`: from a stage's x, v and c_v it writes β dt a - (v - c_v) into a fourth vector,
/// for β = 1.
inline constexpr int residual_start = 2, residual_target = 3;
const Sweep& residual();

/// The sweep of the kernel `accelerations`: writes F/m of the first two vectors into a third.
inline constexpr int readout_target = 2;
const Sweep& readout();

/// All kernels for a scheme: pass_0, pass_1 … for its passes except solutions, start if it has one, residual if it is
/// implicit, accelerations, and those of kernels/. The text depends on nothing that a slider changes.
std::string program_text(const Scheme& scheme);

}  // namespace tyglab::opencl

// The features of a preset that determine which kernels an engine builds.

namespace tyglab::opencl {

/// Whether bodies act on what the preset simulates.
inline bool meets_bodies(const Preset& preset) {
  return !preset.bodies.empty();
}

/// Build options, " -D DAMPING" and so on. `contacts`: of steps that note what bodies stop.
std::string program_features(const Preset& preset, bool contacts);

}  // namespace tyglab::opencl

// The OpenCL C of kernels/, which CMake compiles into the program, so no file has to be found at run time.

namespace tyglab::opencl {

/// The text of a file of kernels/, such as "cloth.cl", which must exist.
std::string_view kernel_text(std::string_view file);

}  // namespace tyglab::opencl

// Caches slow results about a device (built programs, measured times) on disk between runs: in XDG_CACHE_HOME/tyglab,
// or ~/.cache/tyglab. A file that cannot be read or written counts as missing.

namespace tyglab::opencl {

/// That folder, which need not exist; empty: there is none.
std::filesystem::path cache_folder();
/// What was kept under that key, which contains everything that it depends on (device, driver, options, text); empty if
/// there is nothing.
std::string kept_on_disk(const std::string& key);
void keep_on_disk(const std::string& key, const std::string& content);

}  // namespace tyglab::opencl
