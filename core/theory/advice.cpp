#include "core/theory/advice.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "core/model/readable.h"
#include "core/theory/modes.h"

namespace tyglab {
namespace {

constexpr double margin = 0.9;

std::string seconds(double dt) {
  return short_number(dt, 2) + " s";
}

}  // namespace

double stable_dt(const Preset& p, const std::string& integrator) {
  const std::array any{any_configuration(p)};
  return any[0].stiffness == 0 ? 1 : dt_crit(scheme(integrator), any);
}

double advised_dt(const Preset& p, const std::string& integrator) {
  return rounded(margin * stable_dt(p, integrator), 2);
}

std::string tolerance_missed(const Preset& p, const InnerSteps& inner) {
  if (inner.below_digits == 0 && inner.too_short == 0) return "";
  const std::string tolerance = "The tolerance " + short_number(p.tolerance) + " m is ";
  const std::string precision = p.precision == Precision::float_ ? "float" : "double";
  if (inner.below_digits > 0)
    return tolerance + "below what " + precision + " resolves: the last digit of the largest coordinate is more. Use " +
           (p.precision == Precision::float_ ? "a larger one, or double precision." : "a larger one.");
  return tolerance +
         "not reached by the shortest inner steps, a ten-thousandth of dt: use a smaller dt or a larger "
         "tolerance.";
}

std::string advice(const Preset& p) {
  const Mode fastest = any_configuration(p);
  const bool overdamped = fastest.damping > 2 * fastest.omega();
  const std::string stiffness = overdamped ? "k_d" : p.kind == Kind::cloth ? "k_s" : "k";
  const double verlet_dt = advised_dt(p, "verlet");
  if (p.integrator == "verlet") {
    if (p.dt <= verlet_dt && overdamped) return "Use a smaller dt or a smaller k_d, and restart.";
    if (p.dt <= verlet_dt) return "Use a smaller dt, a smaller " + stiffness + " or more damping, and restart.";
    return "Use dt = " + seconds(verlet_dt) + " or less, or a smaller " + stiffness + ", and restart.";
  }
  const std::string step = p.dt <= verlet_dt ? "" : " with dt = " + seconds(verlet_dt) + " or less";
  if (chooses_steps(scheme(p.integrator)))
    return "Use a smaller dt (its inner steps may be a ten-thousandth of it) or a smaller " + stiffness +
           ", and restart; or use the integrator implicit_euler, which is stable at any stiffness.";
  if (projects(scheme(p.integrator)))
    return "Use a smaller dt or more iterations, and restart: this method has no limit of dt, but with few iterations "
           "its springs are soft, and bodies and wind may overstretch them; or use the integrator verlet" +
           step + ".";
  if (is_implicit(scheme(p.integrator)))
    return "Use a smaller dt and restart: linear theory sets no limit for this method, but bodies, wind and springs "
           "that "
           "switch do; or use the integrator verlet" +
           step + ".";
  const double own_dt = advised_dt(p, p.integrator);
  const std::string own = own_dt > 0 ? "this method itself needs dt below about " + seconds(own_dt)
                                     : "without damping this method is unstable at every dt";
  return "Use the integrator verlet" + step + " and restart; " + own + ".";
}

bool springs_too_weak(const Preset& p) {
  if (p.dt > stable_dt(p, p.integrator)) return false;
  constexpr double times = 1000;
  if (p.kind == Kind::one_weight) return p.m * std::abs(p.g) > p.k * times * std::max(p.L, std::abs(p.offset));
  const double particles = double(p.rows) * p.columns, per_column = 3;  // springs of a seam: across, and two diagonals
  const double pull = particles * (p.m * std::abs(p.g) + 2 * glm::length(p.W) * (1 + p.gust));
  return pull > p.k_s * times * p.L * per_column * std::min(p.rows, p.columns);
}

std::string advice_for_weak_springs(const Preset& p) {
  if (p.kind == Kind::one_weight) return "Use a larger k or a smaller m, and restart: dt and method do not matter.";
  return "Use a larger k_s, or less weight (m, g) or wind, and restart: dt and method do not matter.";
}

std::optional<Preset> suggested_fix(const Preset& p) {
  if (springs_too_weak(p)) return std::nullopt;
  Preset cured = p;
  cured.integrator = "verlet";
  cured.dt = std::min(p.dt, advised_dt(p, "verlet"));
  if (cured == p || cured.dt < 1e-7) return std::nullopt;  // nothing to change, or below the range of dt
  return cured;
}

std::optional<Preset> with_advised_dt(const Preset& p) {
  Preset slower = p;
  slower.dt = advised_dt(p, p.integrator);
  if (!(slower.dt >= 1e-7 && slower.dt < p.dt)) return std::nullopt;
  return slower;
}

}  // namespace tyglab
