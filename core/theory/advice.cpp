#include "core/theory/advice.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <vector>

#include <glm/geometric.hpp>

#include "core/cloth/state.h"
#include "core/forces/force.h"
#include "core/model/notation.h"
#include "core/model/words.h"
#include "core/theory/modes.h"
#include "core/theory/zones.h"

namespace tyglab {
namespace {

constexpr double margin = 0.9;
constexpr double least_dt = 1e-7;  // s, of presets

std::string seconds(double dt) {
  return quantity(dt, "s", 2);
}

/// What to do where rounding changes forces too much.
std::string finer_precision(const Preset& p) {
  return p.precision == Precision::float_
             ? "Use double precision (--precision double)."
             : "Use a smaller " + std::string(force::stretch.constant(p)) + " or a larger m.";
}

/// One unit in the last place of the largest coordinate of a particle at the start, m.
double last_digit(const Preset& p) {
  double size = 0;
  const Lattice lattice = lattice_of(p);
  for (const int i : {0, lattice.rows - 1})
    for (const int j : {0, lattice.columns - 1}) {
      const glm::dvec3 x = starting_position(p, i, j);
      size = std::max({size, std::abs(x.x), std::abs(x.y), std::abs(x.z)});
    }
  const double epsilon =
      p.precision == Precision::float_ ? std::numeric_limits<float>::epsilon() : std::numeric_limits<double>::epsilon();
  return size > 0 ? epsilon * std::exp2(std::floor(std::log2(size))) : 0;
}

}  // namespace

double stable_dt(const Preset& p, const std::string& integrator) {
  const std::vector<Mode> worst = worst_modes(p);
  return worst.front().stiffness == 0 ? 1 : dt_crit(scheme(integrator), worst);
}

double advised_dt(const Preset& p, const std::string& integrator) {
  return rounded(margin * stable_dt(p, integrator), 2);
}

std::string tolerance_missed(const Preset& p, const InnerSteps& inner) {
  if (inner.below_digits == 0 && inner.too_short == 0) return "";
  const std::string tolerance = "The tolerance " + quantity(p.tolerance, "m") + " is ";
  if (inner.below_digits > 0)
    return tolerance + "below what " + std::string(name_of(p.precision)) + " can resolve at these coordinates. Use " +
           (p.precision == Precision::float_ ? "a larger one, or double precision." : "a larger one.");
  return tolerance +
         "not reached by the shortest inner steps, a ten-thousandth of dt: use a smaller dt or a larger "
         "tolerance.";
}

std::string excess_in_words(double excess, const Preset& p) {
  return (p.kind == Kind::cloth ? "the cloth has " : "the mass has ") + power_number(rounded(excess, 2)) +
         " times the energy the scene can supply";
}

std::string energy_in_excess(double excess, const Preset& p) {
  constexpr double certain = 1.5;  // methods that keep to the motion stay below 1
  if (!(excess > certain)) return "";
  return sentence(excess_in_words(excess, p) + ": " + std::string(scheme(p.integrator).title) + "'s errors added it") +
         " " + sentence(method_to_blame(p)) + " " + advice(p);
}

namespace {

/// "12 of 3,400 steps": those that have not converged.
std::string of_steps(const SolveCounts& solves, std::int64_t steps) {
  steps = std::max(steps, solves.unconverged);  // a rewind takes steps back, but nothing of what the engine has counted
  return grouped(solves.unconverged) + " of " + grouped(steps) + (steps == 1 ? " step" : " steps");
}

/// Whether more digits would have solved most of those that have not converged.
bool by_rounding(const SolveCounts& solves, const Preset& p) {
  return 2 * solves.rounded >= solves.unconverged && !counts_passes(scheme(p.integrator));
}

std::string stopped_early(const SolveCounts& solves, std::int64_t steps) {
  return of_steps(solves, steps) + " stopped early";
}

/// N/m.
double largest_constant(const Preset& p) {
  double most = 0;
  for_each_stencil(p, [&](const Force& force, const Stencil& stencil) {
    if (force.stiffness != nullptr) most = std::max(most, force.stiffness(p, stencil));
  });
  return most;
}

/// The force that makes most of the fastest mode's stiffness.
const Force& stiffest(const Preset& p) {
  const Force* most = &force::stretch;
  for (const Force* force : force::all)
    if (force->potential != nullptr && force->on(p) && force->largest_eigenvalue(p) > most->largest_eigenvalue(p))
      most = force;
  return *most;
}

}  // namespace

std::string unsolved(const SolveCounts& solves, std::int64_t steps, const Preset& p) {
  if (!by_rounding(solves, p)) return stopped_early(solves, steps);
  return of_steps(solves, steps) + " unbalanced by rounding to " + std::string(name_of(p.precision)) +
         (p.precision == Precision::float_ ? ": use double" : "");
}

std::string precision_too_coarse(const Preset& p) {
  constexpr double much = 0.5;  // of the weight that springs carry: from about here on no step converges
  constexpr double on_earth = 9.82;
  const double digit = last_digit(p), by_stretch = spring_constants(p).largest() * digit;
  const double force = largest_constant(p) * digit;
  const bool hangs = p.kind == Kind::cloth && p.pins.mode != Pins::Mode::none;
  const double weight = (hangs ? p.rows : 1) * p.m * std::max(std::abs(p.g), on_earth);
  const bool tears = p.kind == Kind::cloth && p.F_max > 0 && by_stretch > p.F_max;
  if (!tears && !(is_implicit(scheme(p.integrator)) && force > much * weight)) return "";
  const std::string text = "Rounding positions to " + std::string(name_of(p.precision)) +
                           " changes the force of a spring by up to " + quantity(tears ? by_stretch : force, "N", 2);
  return text +
         (tears ? " here, more than F_max: springs tear by rounding alone. "
                : " here, where " +
                      std::string(hangs                   ? "a column"
                                  : p.kind == Kind::cloth ? "a particle"
                                                          : "the mass") +
                      " weighs " + quantity(weight, "N", 2) + ": steps cannot balance the forces. ") +
         finer_precision(p);
}

std::string solves_missed(const SolveCounts& solves, std::int64_t steps, const Preset& p) {
  if (solves.unconverged == 0) return "";
  const bool one = solves.unconverged == 1;
  constexpr double much = 0.1;
  const double worst = solves.worst_residual;
  const std::string left = !std::isfinite(worst) ? "forces are not numbers"
                           : worst < 1 ? "up to " + short_number(100 * worst, 2) + " % of the force unbalanced"
                                       : "up to " + power_number(worst, 2) + " times the largest force unbalanced";
  const bool passing = counts_passes(scheme(p.integrator));
  const std::string digits = "with springs this stiff, rounding positions to " + std::string(name_of(p.precision)) +
                             " changes forces that much. ";
  if (by_rounding(solves, p))
    return "Forces do not balance in " + of_steps(solves, steps) + " (" + left + "): " + digits + finer_precision(p);
  const std::string count = stopped_early(solves, steps) + " (" + left + ")";
  std::string method(scheme(counts_passes(scheme(p.integrator)) ? "implicit_euler" : p.integrator).title);
  if (method[1] >= 'a') method[0] = char(std::tolower(static_cast<unsigned char>(method[0])));  // but "TR-BDF2"
  const std::string said = count + "; this is " + (worst < much ? "not quite " : "not ") + method + "'s motion. ";
  const std::string passes = passing ? "Each step ends after " + std::to_string(p.iterations) +
                                           (p.iterations == 1 ? " pass, " : " passes, ") + "converged or not. "
                             : p.iterations == 1 ? "With iterations = 1 a step is a single linear solve. "
                                                 : "";
  if (solves_damping(scheme(p.integrator))) return said + "Use a smaller dt or a smaller k_d.";
  if (solves.ended_early > 0)
    return said + "The time limit ended " +
           (solves.ended_early < solves.unconverged ? std::to_string(solves.ended_early) + " of them"
            : one                                   ? "it"
                                                    : "them") +
           " (the longest took " + short_number(1000 * solves.longest_limited, 2) +
           " ms). Allow more time per step, or use a smaller dt.";
  if (2 * solves.rounded >= solves.unconverged) return said + passes + "Also, " + digits + finer_precision(p);
  const bool more = p.iterations < int(find_row("iterations")->max);
  return said + passes + (more ? "Use a smaller dt or more iterations." : "Use a smaller dt.");
}

namespace {

/// How to get to Verlet, whose step must be `dt` or less: nothing where no such dt is allowed.
std::string or_verlet(const Preset& p, double dt) {
  if (dt < least_dt) return "";
  return "; or use Verlet" + (p.dt <= dt ? "" : " with dt = " + seconds(dt) + " or less");
}

/// Of a method that linear theory gives no limit: what can be done about dt itself.
std::string smaller_dt(const Preset& p) {
  return p.dt > least_dt ? "Use a smaller dt and restart: " : "dt is the smallest that is allowed: ";
}

/// Of an explicit method, whose dt is to be `own` or less and Verlet's `verlet` or less, s.
std::string advice_on_dt(const Preset& p, double own, double verlet, const std::string& stiffness, bool overdamped) {
  const std::string title(scheme(p.integrator).title);
  if (std::max(own, verlet) < least_dt)
    return "No dt that is allowed (" + seconds(least_dt) + " or more) is stable here: use a smaller " + stiffness +
           " or a larger m, or implicit Euler, which is stable at any stiffness, and restart.";
  if (own < verlet)
    return "Use Verlet" + (p.dt <= verlet ? "" : " with dt = " + seconds(verlet) + " or less") + " and restart; " +
           (own >= least_dt ? title + " needs dt below about " + seconds(own) + " here"
            : own > 0       ? title + " is stable at no dt that is allowed"
                            : "without damping, " + title + " is unstable at every dt") +
           ".";
  if (p.dt > own) return "Use dt = " + seconds(own) + " or less, or a smaller " + stiffness + ", and restart.";
  const std::string smaller = p.dt > least_dt ? (overdamped ? "a smaller dt or " : "a smaller dt, ") : "";
  return "Use " + smaller + "a smaller " + stiffness + (overdamped ? "" : " or more damping") + ", and restart." +
         (p.bodies.empty() ? ""
                           : " Particles that begin in a body, or are pinned in one, stretch their springs at any dt.");
}

}  // namespace

std::string method_to_blame(const Preset& p) {
  const Scheme& method = scheme(p.integrator);
  const std::string title(method.title), at_dt = "at dt = " + quantity(p.dt, "s");
  switch (zone_of(p)) {
    case Zone::unstable:
      return title + " is unstable here " + at_dt;
    case Zone::depends:
      if (stable_dt(p, p.integrator) == 0) return title + " is stable at no dt in some shapes of the cloth";
      return at_dt + ", above the worst-case limit of " + seconds(stable_dt(p, p.integrator)) + ", " + title +
             " is stable in some shapes of the cloth, but not in this one";
    case Zone::stable:
      break;
  }
  if (chooses_steps(method))
    return title + " may need inner steps shorter than a ten-thousandth of dt = " + quantity(p.dt, "s") + " here";
  return "linear theory finds " + title + " stable " + at_dt + ", but leaves out bodies, springs that switch or tear" +
         (is_implicit(method) ? ", and solves that do not converge" : "");
}

std::string advice(const Preset& p) {
  const Mode fastest = any_configuration(p);
  const bool overdamped = fastest.damping > 2 * fastest.omega();
  const std::string stiffness = overdamped ? "k_d" : std::string(stiffest(p).constant(p));
  const double verlet_dt = advised_dt(p, "verlet");
  if (chooses_steps(scheme(p.integrator)))
    return "Use " +
           std::string(p.dt > least_dt ? "a smaller dt (its inner steps may be a ten-thousandth of it) or " : "") +
           "a smaller " + stiffness + ", and restart; or use implicit Euler, which is stable at any stiffness.";
  if (counts_passes(scheme(p.integrator)))
    return "Use " + std::string(p.dt > least_dt ? "a smaller dt or " : "") +
           "more iterations, and restart: linear theory sets no limit of dt for this method, but the residual "
           "of few iterations, bodies and wind may overstretch springs" +
           or_verlet(p, verlet_dt) + ".";
  if (projects(scheme(p.integrator)))
    return "Use " + std::string(p.dt > least_dt ? "a smaller dt or " : "") +
           "more iterations, and restart: this method has no limit of dt, but with few iterations its springs are "
           "soft, "
           "and bodies and wind may overstretch them" +
           or_verlet(p, verlet_dt) + ".";
  if (is_implicit(scheme(p.integrator)))
    return smaller_dt(p) + "linear theory sets no limit for this method, but bodies, wind and springs that switch do" +
           or_verlet(p, verlet_dt) + ".";
  return advice_on_dt(p, advised_dt(p, p.integrator), verlet_dt, stiffness, overdamped);
}

bool springs_too_weak(const Preset& p) {
  if (p.dt > stable_dt(p, p.integrator)) return false;
  constexpr double times = 1000;
  if (p.kind == Kind::one_weight) return p.m * std::abs(p.g) > p.k * times * std::max(p.L, std::abs(p.offset));
  const double particles = double(p.rows) * p.columns, per_column = 3;  // springs of a seam: across, and two diagonals
  const double u = glm::length(p.u) * (1 + p.gust);
  const double air = force::air.on(p) ? p.air_density / 2 * p.L * p.L * (p.C_N + p.C_T) * u * u : 0;
  const double pull = particles * (p.m * std::abs(p.g) + 2 * glm::length(p.W) * (1 + p.gust) + air);
  return pull > spring_constants(p).largest() * times * p.L * per_column * std::min(p.rows, p.columns);
}

std::string advice_for_weak_springs(const Preset& p) {
  if (p.kind == Kind::one_weight) return "Use a larger k or a smaller m, and restart: dt and method do not matter.";
  std::string also = p.bodies.empty() ? "" : ", or move bodies out of the cloth";
  if (p.v_0 != glm::dvec3(0)) also += ", or use a smaller v_0";
  return "Use a larger " + std::string(force::stretch.constant(p)) + ", or less weight (m, g) or wind" + also +
         ", and restart: dt and method do not matter.";
}

std::optional<Preset> suggested_fix(const Preset& p) {
  if (springs_too_weak(p)) return std::nullopt;
  Preset cured = p;
  const double verlet_dt = advised_dt(p, "verlet"), own_dt = advised_dt(p, p.integrator);
  const Scheme& method = scheme(p.integrator);
  const bool is_explicit = has_step_limit(method) && !is_implicit(method);
  const bool gains = !is_explicit || own_dt < verlet_dt;
  if (gains) cured.integrator = "verlet";
  cured.dt = std::min(p.dt, gains ? verlet_dt : own_dt);
  if (cured == p || cured.dt < least_dt) return std::nullopt;  // nothing to change, or below the range of dt
  return cured;
}

std::optional<Preset> with_advised_dt(const Preset& p) {
  Preset slower = p;
  slower.dt = advised_dt(p, p.integrator);
  if (!(slower.dt >= least_dt && slower.dt < p.dt)) return std::nullopt;
  return slower;
}

}  // namespace tyglab
