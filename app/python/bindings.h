// The Python module `tyglab`: presets, simulations and studies for scripts and notebooks. tyglab.pyi lists its types
// and functions with shapes and units; docs/python.md has examples.
#pragma once

#include <pybind11/pybind11.h>

#include "core/engines/engine.h"
#include "core/model/preset.h"

namespace tyglab::python {

namespace py = pybind11;

void add_errors(py::module_& module);
void add_preset(py::module_& module);
void add_simulation(py::module_& module);
void add_studies(py::module_& module);

/// The preset with these constants in place of its own, {"k_s": 200, "W": (0, 0, 0.1)}. Throws PresetError.
Preset with_constants(const Preset& preset, const py::dict& constants);

/// Raises tyglab.Diverged.
[[noreturn]] void raise_diverged(const Divergence& divergence);

/// Asks for Ctrl-C in the interpreter now and then, while the work goes on without its lock.
class Interrupt {
 public:
  /// To be asked from the thread that works.
  Stop stop();
  /// Throws KeyboardInterrupt, or what another signal's handler raised, if that is why the work ended. With the lock.
  void raise() const;

 private:
  bool raised_ = false;
};

}  // namespace tyglab::python
