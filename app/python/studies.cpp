#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cmath>
#include <string>
#include <vector>

#include "app/python/bindings.h"
#include "core/analysis/error_study.h"
#include "core/analysis/one_weight.h"
#include "core/analysis/tolerance.h"
#include "core/integrators/scheme.h"
#include "core/io/preset_io.h"
#include "core/model/words.h"
#include "core/theory/advice.h"
#include "core/theory/zones.h"

namespace tyglab::python {
namespace {

void check(const Preset& preset, double seconds) {
  if (const std::string problem = check_preset(preset); !problem.empty()) throw PresetError(problem);
  if (!(seconds > 0) || !std::isfinite(seconds)) throw py::value_error("seconds must be above 0");
}

py::dict as_dict(const ErrorPoint& point) {
  py::dict all;
  all["integrator"] = point.integrator;
  all["precision"] = std::string(name_of(point.precision));
  all["dt"] = point.dt;
  if (point.tolerance > 0) all["tolerance"] = point.tolerance;
  all["error"] = point.error_rms_m;
  all["cost"] = point.cost;
  all["resolved"] = point.resolved;
  all["converged"] = point.converged;
  return all;
}

py::dict stability(const Preset& preset) {
  check(preset, 1);
  py::dict all;
  all["zone"] = std::string(zone_name(zone_of(preset), preset.kind));
  const bool limited = has_step_limit(scheme(preset.integrator));
  const double infinite = std::numeric_limits<double>::infinity();
  all["worst_case_limit"] = limited ? stable_dt(preset, preset.integrator) : infinite;
  all["every_shape_limit"] = every_shape_limit(preset);
  return all;
}

py::dict error_study(const Preset& preset, double seconds) {
  check(preset, seconds);
  StudyReference reference;
  const ErrorPoint point = beside_python([&](const Stop& stop) {
    reference = study_reference({preset, {}}, seconds, {}, stop);
    return measure_point({preset, {}}, reference, stop);
  });
  py::dict all = as_dict(point);
  all["seconds"] = reference.seconds;
  return all;
}

py::list work_precision(const Preset& preset, const std::vector<std::string>& integrators, double seconds) {
  check(preset, seconds);
  for (const std::string& name : integrators) with_settings(preset, {"integrator=" + name});
  const auto points = beside_python([&](const Stop& stop) {
    std::vector<ErrorPoint> all;
    const StudyReference reference = study_reference({preset, {}}, seconds, {}, stop);
    for (const std::string& name : integrators) {
      Preset other = preset;
      other.integrator = name;
      for (const ErrorPoint& point : error_ladder({other, {}}, reference, 0, {}, stop)) all.push_back(point);
    }
    return all;
  });
  py::list all;
  for (const ErrorPoint& point : points) all.append(as_dict(point));
  return all;
}

py::list find_settings(const Preset& preset, double error, double seconds) {
  check(preset, seconds);
  if (!(error > 0) || !std::isfinite(error)) throw py::value_error("error must be above 0");
  SettingsGoal goal;
  goal.tolerance = error, goal.seconds = seconds;
  const ToleranceChoice choice =
      beside_python([&](const Stop& stop) { return choose_for_tolerance(preset, goal, stop, [](const auto&) {}); });
  py::list all;
  for (const ErrorPoint& point : choice.reached) {
    py::dict one = as_dict(point);
    one["preset"] = with_setting(preset, point);
    all.append(one);
  }
  return all;
}

py::tuple exact_motion(const Preset& preset, const py::array_t<double>& t) {
  if (preset.kind != Kind::one_weight) throw py::value_error("a closed form is known only for a mass on a spring");
  for (const auto& time : t.attr("flat"))
    if (!(time.cast<double>() >= 0)) throw py::value_error("t must not be negative");
  auto y = py::vectorize([&](double time) { return exact_weight(preset, time).y; });
  auto v = py::vectorize([&](double time) { return exact_weight(preset, time).v; });
  return py::make_tuple(y(t), v(t));
}

}  // namespace

void add_studies(py::module_& module) {
  py::list methods;
  for (const Scheme& method : schemes()) methods.append(std::string(method.name));
  module.attr("integrators") = py::tuple(methods);
  module.def("stability", &stability, py::arg("preset"),
             "The preset's dt in linear theory: its `zone` in words, and two limits of dt (s). Up to worst_case_limit "
             "the method is stable in any shape of the cloth (0: at no dt); above every_shape_limit it is unstable in "
             "every shape. A limit is infinite if the method has none.");
  module.def(
      "error_study", &error_study, py::arg("preset"), py::arg("seconds") = 1.0,
      "Measures the error of the preset's settings against a finer reference: {error: m, root mean square over the "
      "particles, infinite after a divergence; cost: processor seconds per simulated second; resolved: False if the "
      "error is too small to be measured; converged; seconds: length of the motion that was compared; ...}.");
  module.def("work_precision", &work_precision, py::arg("preset"), py::arg("integrators"), py::arg("seconds") = 1.0,
             "Error and cost of each method for decreasing dt, from the largest stable dt on, halved each time: a list "
             "of dictionaries like that of error_study().");
  module.def("find_settings", &find_settings, py::arg("preset"), py::arg("error"), py::arg("seconds") = 1.0,
             "The cheapest setting of each method with an error of at most `error` (m), the cheapest method first: "
             "dictionaries like that of error_study(), with the `preset`. Raises ToleranceError if no setting can be "
             "guaranteed.");
  module.def(
      "exact_motion", &exact_motion, py::arg("preset"), py::arg("t"),
      "Height (m) and velocity (m/s) of a mass on a spring at the times t (s), in closed form: two arrays of the "
      "shape of t.");
}

}  // namespace tyglab::python
