#include "core/engines/fault.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <utility>

#include "core/forces/contact.h"
#include "core/forces/force.h"
#include "core/forces/parted.h"
#include "core/simd/row_field.h"

namespace tyglab {
namespace {

/// Whether all values of a row are finite. The loop does not stop early, so that the compiler can use SIMD.
template <class R>
bool finite_row(const R* field, std::ptrdiff_t stride, int i, int columns) {
  int bad = 0;
  for (int c = 0; c < 3; ++c) {
    const R* row = StateView<R>::row(field, stride, i, c);
    for (int j = 0; j < columns; ++j) bad |= int(!(std::abs(row[j]) <= std::numeric_limits<R>::max()));
  }
  return bad == 0;
}

template <class R>
bool finite(const Lattice& lattice, const StateView<R>& state, Fault& fault) {
  for (int i = 0; i < lattice.rows; ++i) {
    if (finite_row(state.x, state.stride, i, lattice.columns) && finite_row(state.v, state.stride, i, lattice.columns))
      continue;
    for (int j = 0; j < lattice.columns; ++j)
      for (const bool position : {true, false})
        for (int c = 0; c < 3; ++c) {
          const double value = position ? state.x_row(i, c)[j] : state.v_row(i, c)[j];
          if (std::isfinite(value)) continue;
          fault = {i, j, position ? "position" : "velocity", value};
          return false;
        }
  }
  return true;
}

bool all_whole(const Tears& tears, int d, int i, int begin, int end) {
  const std::uint8_t* masks = tears.row(i);
  return masks == nullptr || std::all_of(masks + begin, masks + end, [&](auto mask) { return (mask >> d & 1) != 0; });
}

/// By how much any spring of a row in one direction may still grow, m; less than 0: `fault` is too long.
template <class R>
double growth_left(const Preset& preset, const Lattice& lattice, const Tears& tears, const StateView<R>& state, int d,
                   int i, Fault& fault) {
  const Direction& dir = directions[d];
  const double bound = longest_factor * dir.rest * preset.L;
  const int columns = lattice.columns;
  const int begin = std::max(0, -dir.dj), end = columns - std::max(0, dir.dj);
  if (begin >= end) return bound;
  // First all of them in the state's precision and in SIMD; one by one and exactly only if one may be too long or torn.
  if (all_whole(tears, d, i, begin, end)) {
    const R longest =
        simd::longest_squared(state.x_row(i, 0), state.stride, dir.di * 3 * state.stride + dir.dj, begin, end);
    const double left = bound - std::sqrt(double(longest)) * (1 + rounding<R>);
    if (left >= 0) return left;
  }
  double slack = bound;
  for (int j = begin; j < end; ++j) {
    if (!tears.whole(d, i, j)) continue;
    const double length = std::sqrt(distance2(state, i, j, dir));
    if (bound - length < 0) fault = {i, j, "spring length", length, dir.di, dir.dj};
    if (bound - length < 0) return bound - length;
    slack = std::min(slack, bound - length);
  }
  return slack;
}

template <class R>
bool within_bounds(const Preset& preset, const Lattice& lattice, const Tears& tears, const StateView<R>& state,
                   Fault& fault, double& divergence_budget) {
  double slack = std::numeric_limits<double>::infinity();
  if (preset.kind == Kind::one_weight) {
    const double bound = longest_factor * std::max(preset.L, std::abs(preset.offset));
    const double away = std::abs(double(state.x_row(0, 1)[0]) - preset.x_0.y);
    fault = {0, 0, "distance from x_0", away};
    divergence_budget = bound - away;
    return divergence_budget >= 0;
  }
  for (int d = 0; d < int(directions.size()); ++d)
    for (int i = 0; i + directions[d].di < lattice.rows; ++i) {
      slack = std::min(slack, growth_left(preset, lattice, tears, state, d, i, fault));
      if (slack < 0) return false;
    }
  for (const LooseSpring& spring : loose_springs(tears, 0, int(directions.size()))) {
    const Direction& to = directions[std::size_t(spring.spring.direction)];
    glm::dvec3 apart{0};
    for (int c = 0; c < 3; ++c)
      apart[c] = double(state.x_row(spring.b / lattice.columns, c)[spring.b % lattice.columns]) -
                 double(state.x_row(spring.a / lattice.columns, c)[spring.a % lattice.columns]);
    const double length = glm::length(apart);
    slack = std::min(slack, longest_factor * to.rest * preset.L - length);
    if (slack >= 0) continue;
    fault = {spring.spring.i, spring.spring.j, "spring length", length, to.di, to.dj};
    return false;
  }
  divergence_budget = slack;
  return true;
}

/// Σ (|x_ij| - rest)² over the whole springs of a row in one direction that pull or push, m².
template <class R>
double strain_squared(const Preset& preset, const Lattice& lattice, const Tears& tears, const StateView<R>& state,
                      int d, int i) {
  const Direction& dir = directions[d];
  const double rest = dir.rest * preset.L;
  const int begin = std::max(0, -dir.dj), end = lattice.columns - std::max(0, dir.dj);
  if (begin >= end) return 0;
  if (all_whole(tears, d, i, begin, end))
    return simd::strain_squared(state.x_row(i, 0), state.stride, dir.di * 3 * state.stride + dir.dj, begin, end,
                                R(rest), dir.bending);
  double sum = 0;
  for (int j = begin; j < end; ++j) {
    if (!tears.whole(d, i, j)) continue;
    const double longer = std::sqrt(distance2(state, i, j, dir)) - rest;
    if ((longer < 0) == dir.bending) sum += longer * longer;
  }
  return sum;
}

/// How far bodies are about to push a particle out of themselves, m, at most: out of one into the next, too.
double pushed(std::span<const PlacedBody> bodies, const glm::dvec3& x) {
  double inside = 0, all = 0;
  for (const PlacedBody& body : bodies) {
    const double deep = std::max(depth(body, x), 0.0);
    inside = std::max(inside, deep);
    all += body.extent > 0 ? 2 * body.extent : deep;
  }
  return inside > 0 && bodies.size() > 1 ? all : inside;
}

/// |v|² of a particle as it is stored.
template <class R>
double speed_squared(const StateView<R>& state, int i, int j) {
  double sum = 0;
  for (int c = 0; c < 3; ++c) sum += double(state.v_row(i, c)[j]) * double(state.v_row(i, c)[j]);
  return sum;
}

template <class R>
double farthest(const StateView<R>& state, int i, int j) {
  double most = 0;
  for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(double(state.x_row(i, c)[j])));
  return most;
}

}  // namespace

double max_elongation(double max_displacement) {
  assert(!(max_displacement < 0));
  return 2 * std::numbers::sqrt3 * max_displacement;
}

template <class R>
double growth_left(const Preset& preset, const LongestSquared& longest) {
  assert(!(longest.straight < 0) && !(longest.diagonal < 0) && !(longest.bending < 0));
  double slack = std::numeric_limits<double>::infinity();
  for (const auto& [direction, squared] : {std::pair(0, longest.straight), std::pair(2, longest.diagonal),
                                           std::pair(int(stretch_directions), longest.bending)}) {
    const double left = longest_factor * directions[direction].rest * preset.L - std::sqrt(squared) * (1 + rounding<R>);
    if (!(left >= slack)) slack = left;
  }
  return slack;
}

template <class R>
double distance2(const StateView<R>& state, int i, int j, const Direction& to) {
  double r2 = 0;
  for (int c = 0; c < 3; ++c) {
    const double d = double(state.x_row(i + to.di, c)[j + to.dj]) - double(state.x_row(i, c)[j]);
    r2 += d * d;
  }
  return r2;
}

template <class R>
bool find_fault(const Preset& preset, const Lattice& lattice, const Tears& tears, const StateView<R>& state,
                Fault& fault, double& divergence_budget) {
  assert(state.stride >= lattice.columns);
  assert(tears.untorn() || tears.lattice() == lattice);
  return !finite(lattice, state, fault) || !within_bounds(preset, lattice, tears, state, fault, divergence_budget);
}

template <class R>
Motion motion_of(const Preset& preset, const Lattice& lattice, const Tears& tears, std::span<const PlacedBody> bodies,
                 const StateView<R>& state, double to_velocity) {
  assert(preset.m > 0 && to_velocity > 0);
  assert(state.stride >= lattice.columns);
  Motion motion;
  double speeds = 0, pushes = 0;
  const bool meets_bodies = !bodies.empty();
  for (int i = 0; i < lattice.rows; ++i)
    for (int j = 0; j < lattice.columns; ++j) {
      speeds += speed_squared(state, i, j);
      motion.farthest = std::max(motion.farthest, farthest(state, i, j));
      if (!meets_bodies) continue;
      const double push = pushed(bodies, {state.x_row(i, 0)[j], state.x_row(i, 1)[j], state.x_row(i, 2)[j]});
      pushes += push * push;
    }
  motion.squared = speeds * to_velocity * to_velocity;
  motion.pushed = std::sqrt(pushes);
  if (preset.kind == Kind::one_weight) {
    const double away = double(state.x_row(0, 1)[0]) - preset.x_0.y;
    motion.squared += preset.k / preset.m * away * away;
    return motion;
  }
  for (int d = 0; d < int(directions.size()); ++d)
    for (int i = 0; i + directions[d].di < lattice.rows; ++i)
      motion.squared +=
          spring_constant(preset, directions[d]) / preset.m * strain_squared(preset, lattice, tears, state, d, i);
  const auto x_of = [&](int i, int j) {
    return glm::dvec3(state.x_row(i, 0)[j], state.x_row(i, 1)[j], state.x_row(i, 2)[j]);
  };
  for_each_stencil(preset, [&](const Force& force, const Stencil& stencil) {
    if (force.linear == nullptr && &force != &force::curl) return;
    for_each_action(preset, tears, force, stencil, x_of, x_of,
                    [&](const Points&, const ForceAction& action) { motion.squared += 2 / preset.m * action.energy; });
  });
  for (const LooseStencil& loose : loose_stencils(preset, tears)) {
    const auto x_of_particle = [&](int particle) {
      return x_of(particle / lattice.columns, particle % lattice.columns);
    };
    if (loose.force->group == Force::Group::internal && loose.force->conserves)
      motion.squared += 2 / preset.m * action_of(preset, loose, x_of_particle, x_of_particle).energy;
  }
  motion.squared += 2 / preset.m * curl_below_zero(preset) * lattice.size();
  return motion;
}

template <class R>
bool find_runaway(const MotionLimit& limit, const Lattice& lattice, const StateView<R>& state, double to_velocity,
                  Fault& fault) {
  assert(to_velocity > 0 && state.stride >= lattice.columns);
  constexpr double about = 1 + 1e-3;
  double sum = 0, fastest = 0, far = 0;
  Fault of_speed{0, 0, "velocity", 0}, of_place{0, 0, "position", 0};
  for (int i = 0; i < lattice.rows; ++i)
    for (int j = 0; j < lattice.columns; ++j) {
      const double squared = speed_squared(state, i, j) * to_velocity * to_velocity, away = farthest(state, i, j);
      sum += squared;
      if (squared > about * fastest) fastest = squared, of_speed.i = i, of_speed.j = j;
      if (away > about * far) far = away, of_place.i = i, of_place.j = j;
    }
  of_speed.value = std::sqrt(fastest), of_place.value = far;
  // Particles of a cloth that has parted have at least a quarter of a mass.
  const double most = limit.most_squared() * (lattice.copy_rows > 0 ? Mesh::cells_round : 1);
  of_speed.excess = of_place.excess = MotionLimit::factor * sum / most;
  const bool too_fast = !(sum <= most);
  fault = too_fast ? of_speed : of_place;
  return too_fast || !(far <= limit.farthest());
}

template Motion motion_of(const Preset&, const Lattice&, const Tears&, std::span<const PlacedBody>,
                          const StateView<float>&, double);
template Motion motion_of(const Preset&, const Lattice&, const Tears&, std::span<const PlacedBody>,
                          const StateView<double>&, double);
template bool find_runaway(const MotionLimit&, const Lattice&, const StateView<float>&, double, Fault&);
template bool find_runaway(const MotionLimit&, const Lattice&, const StateView<double>&, double, Fault&);
template double growth_left<float>(const Preset&, const LongestSquared&);
template double growth_left<double>(const Preset&, const LongestSquared&);
template double distance2(const StateView<float>&, int, int, const Direction&);
template double distance2(const StateView<double>&, int, int, const Direction&);
template bool find_fault(const Preset&, const Lattice&, const Tears&, const StateView<float>&, Fault&, double&);
template bool find_fault(const Preset&, const Lattice&, const Tears&, const StateView<double>&, Fault&, double&);

}  // namespace tyglab
