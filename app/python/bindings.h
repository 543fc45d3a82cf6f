// The Python module `tyglab`: presets, simulations and studies for scripts and notebooks. tyglab.pyi lists its types
// and functions with shapes and units; docs/python.md has examples.
#pragma once

#include <pybind11/pybind11.h>

#include <algorithm>
#include <cstddef>

#include "core/analysis/reference.h"
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

/// Checks for Ctrl-C in the interpreter now and then, while the work runs without its lock.
class Interrupt {
 public:
  /// To be asked from the thread that works.
  Stop stop();
  /// Throws KeyboardInterrupt, or the exception of another signal handler, if it ended the work. Requires the lock.
  void raise() const;

 private:
  bool raised_ = false;
};

/// Lets other Python threads run during `work(stop)`, which Ctrl-C ends.
template <class Work>
auto beside_python(const Work& work) {
  Interrupt interrupt;
  try {
    const py::gil_scoped_release unlocked;
    return work(interrupt.stop());
  } catch (const Stopped&) {
  }
  interrupt.raise();
  throw py::value_error("the study was stopped");
}

/// Of X.__new__(X), which has no value, pybind11 would read memory that nobody has written: that raises TypeError. So
/// do pickle's protocols 0 and 1 of what has no __getstate__; of what has one they are as later ones.
template <class Class>
void refuse_objects_without_value(Class& type) {
  py::detail::get_type_info(typeid(typename Class::type))->operator_new = [](std::size_t) -> void* {
    throw py::type_error("this object has no value: its __init__() was not called");
  };
  type.def("__reduce_ex__", [](const py::object& self, int protocol) {
    return py::module_::import("builtins").attr("object").attr("__reduce_ex__")(self, std::max(protocol, 2));
  });
}

}  // namespace tyglab::python
