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
