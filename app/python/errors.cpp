#include "app/base/files.h"
#include "app/python/bindings.h"
#include "core/analysis/reference.h"
#include "core/analysis/tolerance.h"
#include "core/engines/engine.h"
#include "core/io/output_file.h"
#include "core/io/preset_io.h"

namespace tyglab::python {
namespace {

py::object new_error(py::module_& module, const char* name, PyObject* base, const char* meaning) {
  const std::string whole = std::string("tyglab.") + name;
  auto error = py::reinterpret_steal<py::object>(PyErr_NewExceptionWithDoc(whole.c_str(), meaning, base, nullptr));
  if (!error) throw py::error_already_set();
  module.attr(name) = error;
  return error;
}

/// They live as long as the interpreter.
struct Errors {
  py::object preset, engine, diverged, tolerance;
};
Errors& errors() {
  static auto* all = new Errors;
  return *all;
}

void raise_tolerance_error(const ToleranceError& error) {
  const py::object value = errors().tolerance(error.what());
  value.attr("tightest") = error.tightest ? py::object(py::float_(*error.tightest)) : py::object(py::none());
  PyErr_SetObject(errors().tolerance.ptr(), value.ptr());
}

}  // namespace

void raise_diverged(const Divergence& divergence) {
  const py::object value = errors().diverged(divergence.in_words());
  value.attr("divergence") = py::cast(divergence);
  PyErr_SetObject(errors().diverged.ptr(), value.ptr());
  throw py::error_already_set();
}

void add_errors(py::module_& module) {
  errors().preset = new_error(module, "PresetError", PyExc_ValueError,
                              "A preset or a constant is wrong: the message names it and the allowed values.");
  errors().engine =
      new_error(module, "EngineError", PyExc_RuntimeError, "The engine or its device is missing or was lost.");
  errors().diverged = new_error(
      module, "Diverged", PyExc_ArithmeticError,
      "A step diverged; the simulation keeps the state before that step. `divergence` reports time, place and cause.");
  errors().tolerance = new_error(module, "ToleranceError", PyExc_ValueError,
                                 "No setting is guaranteed to reach the requested error. `tightest`: the smallest "
                                 "error that can be guaranteed (m), or None.");
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      if (pointer) std::rethrow_exception(pointer);
    } catch (const PresetError& error) {
      PyErr_SetString(errors().preset.ptr(), error.what());
    } catch (const EngineError& error) {
      PyErr_SetString(errors().engine.ptr(), error.what());
    } catch (const ToleranceError& error) {
      raise_tolerance_error(error);
    } catch (const OutputError& error) {
      PyErr_SetString(PyExc_OSError, error.what());
    } catch (const DataFileError& error) {
      PyErr_SetString(PyExc_FileNotFoundError, error.what());
    }
  });
}

}  // namespace tyglab::python
