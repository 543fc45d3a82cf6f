#include "core/engines/implicit/stiff_stage.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <glm/geometric.hpp>
#include <limits>

#include "core/forces/force.h"
#include "core/forces/spring-inl.h"
#include "core/forces/wind-inl.h"

namespace tyglab::implicit {
namespace {

using Field = simd::RowField<double>;

glm::dvec3 at(const Field& x, int i, int j) {
  return {x.row(i, 0)[j], x.row(i, 1)[j], x.row(i, 2)[j]};
}

/// Adds a third of the wind on a triangle to each of its corners.
void blow(const Preset& preset, double scale, const Field& x, int i, int j, int which, Field& forces) {
  assert(which == 0 || which == 1);
  const auto& corners = quad_triangles[std::size_t((i + j) & 1)][std::size_t(which)];
  glm::dvec3 corner[3];
  for (int n = 0; n < 3; ++n) corner[n] = at(x, i + corners[std::size_t(n)].di, j + corners[std::size_t(n)].dj);
  const glm::dvec3 force = HWY_NAMESPACE::wind_on_corner(cross(corner[1] - corner[0], corner[2] - corner[0]),
                                                         preset.W / 3.0, std::numeric_limits<double>::min());
  for (const Corner& to : corners)
    for (int c = 0; c < 3; ++c) forces.row(i + to.di, c)[j + to.dj] += scale * force[c];
}

/// Adds the wind's h²/m on every whole triangle.
void add_wind(const Preset& preset, const Tears& tears, double scale, const Field& x, Field& forces) {
  const Lattice& lattice = tears.lattice();
  for (int i = 0; i + 1 < lattice.rows; ++i)
    for (int j = 0; j + 1 < lattice.columns; ++j)
      for (int which = 0; which < 2; ++which)
        if (tears.triangle_whole(i, j, which)) blow(preset, scale, x, i, j, which, forces);
}

/// Adds h²/m F_curl.
void add_curl(const Preset& preset, const Tears& tears, double scale, const Field& x, Field& forces) {
  const auto x_of = [&](int i, int j) { return at(x, i, j); };
  for (const Stencil& stencil : force::curl.stencils(preset))
    for (int i = 0; i < tears.lattice().rows; ++i)
      for (int j = 0; j < tears.lattice().columns; ++j) {
        if (!stencil.acts(tears, i, j)) continue;
        ForceAction action;
        force::curl.act(preset, stencil, points_of(stencil, i, j, x_of, x_of), action);
        for (std::size_t n = 0; n < std::size_t(stencil.points); ++n)
          for (int c = 0; c < 3; ++c)
            forces.row(i + stencil.at[n].di, c)[j + stencil.at[n].dj] += scale * action.F[n][c];
      }
}

template <class R>
bool is_fixed(const StiffTask<R>& task, int i, int j) {
  return !task.fixed.empty() && task.fixed[std::size_t(i) * task.lattice.columns + j] != 0;
}

/// Calls what(i, j, c, n) for all components, n their place in the engine's arrays. Returns false where it was stopped.
template <class R, class What>
bool for_each(const StiffTask<R>& task, const What& what) {
  for (int i = 0; i < task.lattice.rows; ++i) {
    if (i % 64 == 0 && task.stops()) return false;
    for (int c = 0; c < 3; ++c)
      for (int j = 0; j < task.lattice.columns; ++j) what(i, j, c, (3 * i + c) * task.stride + j);
  }
  return true;
}

}  // namespace

template <class R, class S>
Balance StiffStage::solve_with(InteriorPoint<S>& solver, const StiffTask<R>& task, SolveCounts& counts) {
  const Preset& p = task.preset;
  const double h = task.h, scale = h * h / p.m;
  const SpringConstants springs = spring_constants(p);
  assert(possible(p) && h > 0 && p.m > 0 && task.stride >= task.lattice.columns);
  assert(task.fixed.empty() || task.fixed.size() >= std::size_t(task.lattice.size()));
  if (!solver.resize(task.lattice, task.stops)) return {};
  linear_.follow(p, task.tears, simd::row_stride<double>(task.lattice.columns), scale);
  const bool begun = for_each(task, [&](int i, int j, int c, std::ptrdiff_t n) {
    const bool fixed = is_fixed(task, i, j);
    const double from = double(task.c_x[n]), end = from + h * double(task.c_v[n]);
    solver.c().row(i, c)[j] = from;
    solver.y().row(i, c)[j] = end - (c == 1 && !fixed ? h * h * p.g : 0);
    if (task.air != nullptr && !fixed) solver.y().row(i, c)[j] += h * h * double(task.air[n]);
    solver.x().row(i, c)[j] = fixed ? end : double(task.x[n]);
  });
  if (!begun) return {};
  // Every spring needs a tension, so one of constant 0 gets a hair of one.
  constexpr double least = 1e-9;
  std::array<double, stretch_directions> stretch;
  for (std::size_t d = 0; d < stretch.size(); ++d)
    stretch[d] = std::max(springs.of(directions[d]), least * springs.largest()) * scale;
  typename InteriorPoint<S>::Task inner{.constants = {stretch, springs.bend * scale, p.k_d * h / p.m, p.L},
                                        .gravity = h * h * p.g,
                                        .weight = weight_scale(p.g, h),
                                        .tolerance = task.tolerance,
                                        .tears = &task.tears,
                                        .linear = linear_,
                                        .linear_stiffness = scale * linear_sum_of(&Force::at_particle, p),
                                        .fixed = task.fixed,
                                        .others = {},
                                        .stops = task.stops,
                                        .out_of_time = task.out_of_time,
                                        .progress = task.progress,
                                        .crew = task.crew};
  const bool curls = force::curl.on(p);
  if (p.W != glm::dvec3(0) || curls)
    inner.others = [&, curls](const Field& x, Field& forces) {
      if (p.W != glm::dvec3(0)) add_wind(p, task.tears, scale, x, forces);
      if (curls) add_curl(p, task.tears, scale, x, forces);
    };
  const Balance balance = solver.solve(inner, counts);
  for_each(task, [&](int i, int j, int c, std::ptrdiff_t n) {
    if (!is_fixed(task, i, j)) task.v[n] = R((solver.x().row(i, c)[j] - solver.c().row(i, c)[j]) / h);
  });
  return balance;
}

template <class R>
Balance StiffStage::solve(const StiffTask<R>& task, SolveCounts& counts) {
  const double linear = linear_sum_of(&Force::at_particle, task.preset) * task.h * task.h / task.preset.m;
  if (stiffness_of(task.preset, task.h) + linear < very_stiff) {
    if (!single_) single_ = std::make_unique<InteriorPoint<float>>();
    return solve_with(*single_, task, counts);
  }
  if (!double_) double_ = std::make_unique<InteriorPoint<double>>();
  return solve_with(*double_, task, counts);
}

Balance solve_either_way(EitherStage& stage, const Preset& preset, double h, TooSlow& too_slow) {
  const bool both = preset.iterations > 1 && StiffStage::possible(preset);
  const StageLimit limit = stage.limit();
  const bool limited = limit.seconds > 0, slow = limited && too_slow.stages > 0;
  too_slow.stages -= slow;
  assert(too_slow.stages >= 0);
  const bool stiff_first = both && stiffness_of(preset, h) >= stiff;
  const auto over = [&](double part) { return limited && limit.is_over(part); };
  if (stiff_first && slow) return stage.solve_quickly();
  if (stiff_first && limited) stage.keep();
  const Balance first = stiff_first ? stage.solve_stiff() : stage.solve_by_newton();
  if (first.found() || !both || stage.stops()) return first;
  if (stiff_first && first.residual > nearly_there && over(first_share)) {
    too_slow.stages = 16;
    stage.restore();
    return stage.solve_quickly();
  }
  if (over(1)) return first;
  stage.keep();
  const Balance second = stiff_first ? stage.solve_by_newton() : stage.solve_stiff();
  if (second.found() || second.residual < first.residual || stage.stops()) return second;
  stage.restore();
  return first;
}

std::size_t StiffStage::bytes() const {
  return linear_.bytes() + (single_ ? single_->bytes() : 0) + (double_ ? double_->bytes() : 0);
}

template Balance StiffStage::solve(const StiffTask<float>&, SolveCounts&);
template Balance StiffStage::solve(const StiffTask<double>&, SolveCounts&);

}  // namespace tyglab::implicit
