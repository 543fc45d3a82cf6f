#include <algorithm>
#include <stdexcept>
#include <string>

#include "core/integrators/scheme.h"
#include "core/integrators/scheme_rows.h"

namespace tyglab {
namespace {

const std::vector<Scheme>& table() {
  static const std::vector<Scheme> rows = [] {
    std::vector<Scheme> all = explicit_schemes();
    all.push_back(damped_verlet());
    all.push_back(dopri5());
    all.push_back(rkc2());
    for (Scheme& row : implicit_schemes()) all.push_back(std::move(row));
    all.push_back(projective_dynamics());
    all.push_back(vbd());
    all.push_back(xpbd());
    return all;
  }();
  return rows;
}

}  // namespace

std::span<const Scheme> schemes() {
  return table();
}

const Scheme& scheme(std::string_view name) {
  const auto& rows = table();
  const auto it = std::find_if(rows.begin(), rows.end(), [&](const Scheme& s) { return s.name == name; });
  if (it == rows.end()) throw std::invalid_argument("no integrator is called " + std::string(name));
  return *it;
}

StepShape step_shape(const Scheme& scheme) {
  std::vector<double> vectors(std::size_t(scheme.vectors), 0.0);  // at dt = a = 1, from rest at 0
  const auto assign = [&](const std::vector<Assignment>& assignments) {
    for (const Assignment& assignment : assignments) {
      double sum = 0;
      for (const Term& term : assignment.terms)
        sum += term.factor * (term.vector == acceleration ? 1 : vectors[std::size_t(term.vector)]);
      vectors[std::size_t(assignment.target)] = sum;
    }
  };
  double before_last = 0;
  for (const Sweep& sweep : scheme.sweeps) {
    before_last = vectors[vector_v];
    assign(sweep.before);
    if (sweep.solves != 0) {
      vectors[std::size_t(sweep.velocity)] += sweep.solves;
      vectors[std::size_t(sweep.position)] += sweep.solves * vectors[std::size_t(sweep.velocity)];
    }
    assign(sweep.assignments);
  }
  return {vectors[vector_x], vectors[vector_v] - before_last};
}

std::span<const std::string_view> integrator_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> list;
    for (const Scheme& s : table()) list.push_back(s.name);
    return list;
  }();
  return names;
}

bool is_integrator(std::string_view name) {
  const auto names = integrator_names();
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace tyglab
