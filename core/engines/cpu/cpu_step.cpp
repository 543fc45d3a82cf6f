// Stepping: bands side by side, then what needs the whole cloth: tearing, the hand's release, the watch for divergence.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "core/engines/cpu/cpu_engine.h"
#include "core/engines/cpu/row_distances.h"
#include "core/forces/spring-inl.h"

namespace tyglab::cpu {
namespace {

constexpr int steps_between_backups = 256;  // a copy of the state costs about a step's memory traffic: under 1 %
template <class R>
constexpr double rounding = 16 * double(std::numeric_limits<R>::epsilon());  // of a length computed in R, generously
constexpr double longest_factor = 1000;  // a spring longer than that many rest lengths has diverged

/// Whether all of a row's values are numbers. Without a way out of the loop, so that the compiler can use SIMD.
template <class R>
bool finite_row(const RowField<R>& field, int i, int columns) {
  int bad = 0;
  for (int c = 0; c < 3; ++c) {
    const R* row = field.row(i, c);
    for (int j = 0; j < columns; ++j) bad |= int(!(std::abs(row[j]) <= std::numeric_limits<R>::max()));
  }
  return bad == 0;
}

}  // namespace

template <class R, unsigned Present>
double CpuEngine<R, Present>::distance2(int i, int j, const Direction& to) const {
  double r2 = 0;
  for (int c = 0; c < 3; ++c) {
    const double d = double(cloth_.row(vector_x, i + to.di, c)[j + to.dj]) - double(cloth_.row(vector_x, i, c)[j]);
    r2 += d * d;
  }
  return r2;
}

/// Breaks what is overloaded, and says by how much any other spring may still grow, m.
template <class R, unsigned Present>
double CpuEngine<R, Present>::tear_overloaded(Tears& tears) {
  double slack = std::numeric_limits<double>::infinity();
  for (int d = 0; d < stretch_directions; ++d) {
    const double longest = directions[d].rest * cloth_.preset.L + cloth_.preset.F_max / cloth_.preset.k_s;
    for (int i = 0; i + directions[d].di < cloth_.lattice.rows; ++i)
      slack = std::min(slack, longest * (1 - rounding<R>)-std::sqrt(tear_row(tears, d, i)));
  }
  return slack;
}

/// Breaks the overloaded springs of a row in one direction; returns the square of the longest one that it leaves and
/// that could break, m².
template <class R, unsigned Present>
double CpuEngine<R, Present>::tear_row(Tears& tears, int d, int i) {
  const Direction& dir = directions[d];
  const double rest = dir.rest * cloth_.preset.L, longest = rest + cloth_.preset.F_max / cloth_.preset.k_s;
  const int begin = std::max(0, -dir.dj), end = cloth_.lattice.columns - std::max(0, dir.dj);
  // First all of them in the state's precision and in SIMD; one by one and exactly only if one may be overloaded.
  const double found = double(longest_squared(cloth_.row(vector_x, i, 0), cloth_.stride,
                                              dir.di * cloth_.vector(vector_x).pitch() + dir.dj, begin, end));
  if (found <= longest * longest * (1 - rounding<R>)) return found;
  double left = 0;
  for (int j = begin; j < end; ++j) {
    if (!tears.whole(d, i, j) || guarded(i, j) || guarded(i + dir.di, j + dir.dj)) continue;
    const double r2 = distance2(i, j, dir);
    if (HWY_NAMESPACE::stretch_tension(cloth_.preset.k_s, rest, r2) > cloth_.preset.F_max)
      tears.tear(d, i, j);
    else
      left = std::max(left, r2);
  }
  return left;
}

template <class R, unsigned Present>
bool CpuEngine<R, Present>::finite(Fault& fault) const {
  for (int i = 0; i < cloth_.lattice.rows; ++i) {
    if (finite_row(cloth_.vector(vector_x), i, cloth_.lattice.columns) &&
        finite_row(cloth_.vector(vector_v), i, cloth_.lattice.columns))
      continue;
    for (int j = 0; j < cloth_.lattice.columns; ++j)
      for (int which : {vector_x, vector_v})
        for (int c = 0; c < 3; ++c) {
          const double value = cloth_.row(which, i, c)[j];
          if (std::isfinite(value)) continue;
          fault = {i, j, which == vector_x ? "position" : "velocity", value};
          return false;
        }
  }
  return true;
}

template <class R, unsigned Present>
double CpuEngine<R, Present>::growth_left(const Tears& tears, int d, int i, Fault& fault) const {
  const Direction& dir = directions[d];
  const double bound = longest_factor * dir.rest * cloth_.preset.L;
  const int begin = std::max(0, -dir.dj), end = cloth_.lattice.columns - std::max(0, dir.dj);
  if (begin >= end) return bound;
  // First all of them in the state's precision and in SIMD; one by one and exactly only if one may be too long or torn.
  const std::uint8_t* masks = tears.row(i);
  if (masks == nullptr || std::all_of(masks + begin, masks + end, [&](auto mask) { return (mask >> d & 1) != 0; })) {
    const R longest = longest_squared(cloth_.row(vector_x, i, 0), cloth_.stride,
                                      dir.di * cloth_.vector(vector_x).pitch() + dir.dj, begin, end);
    const double left = bound - std::sqrt(double(longest)) * (1 + rounding<R>);
    if (left >= 0) return left;
  }
  double slack = bound;
  for (int j = begin; j < end; ++j) {
    if (!tears.whole(d, i, j)) continue;
    const double length = std::sqrt(distance2(i, j, dir));
    if (bound - length < 0) fault = {i, j, "spring length", length};
    if (bound - length < 0) return bound - length;
    slack = std::min(slack, bound - length);
  }
  return slack;
}

template <class R, unsigned Present>
bool CpuEngine<R, Present>::within_bounds(const Tears& tears, Fault& fault) {
  double slack = std::numeric_limits<double>::infinity();
  if (cloth_.preset.kind == Kind::one_weight) {
    const double bound = longest_factor * std::max(cloth_.preset.L, std::abs(cloth_.preset.offset));
    const double away = std::abs(double(cloth_.row(vector_x, 0, 1)[0]) - cloth_.preset.x_0.y);
    fault = {0, 0, "distance from x_0", away};
    free_motion_ = bound - away;
    return free_motion_ >= 0;
  }
  for (int d = 0; d < int(directions.size()); ++d)
    for (int i = 0; i + directions[d].di < cloth_.lattice.rows; ++i) {
      slack = std::min(slack, growth_left(tears, d, i, fault));
      if (slack < 0) return false;
    }
  free_motion_ = slack;
  return true;
}

template <class R, unsigned Present>
bool CpuEngine<R, Present>::find_fault(const Tears& tears, Fault& fault) {
  return !finite(fault) || !within_bounds(tears, fault);
}

/// Ends a step on one thread: says whether to go on.
template <class R, unsigned Present>
typename CpuEngine<R, Present>::End CpuEngine<R, Present>::finish_step(Tears& tears, Fault& fault) {
  const Preset& preset = cloth_.preset;
  double largest = 0;
  for (const auto& band : bands_) {
    largest = std::max(largest, band->largest_way());
    if (has(part::hand) && band->has_hand()) hand_force_ = band->hand_force();
  }
  // Two ends, each by at most √3 of its largest component.
  const double growth = 2 * std::numbers::sqrt3 * largest;
  if (has(part::tearing) && preset.F_max > 0 && preset.k_s > 0 && preset.kind == Kind::cloth) {
    tear_motion_ -= growth;
    if (!(tear_motion_ > 0)) tear_motion_ = tear_overloaded(tears);
  }
  free_motion_ -= growth;
  if (!(free_motion_ > 0) && find_fault(tears, fault)) return End::fault;
  if (has(part::hand) && cloth_.held.particle >= 0 && preset.F_release > 0 &&
      glm::length(hand_force_) > preset.F_release)
    return End::released;
  return End::none;
}

template <class R, unsigned Present>
int CpuEngine<R, Present>::run(int steps, Tears& tears, Fault& fault) {
  int done = 0;
  end_ = End::none;
  team_->run([&](int number) {
    Band<R, Present>& band = *bands_[std::size_t(number)];
    for (int n = 0; n < steps && end_ == End::none; ++n) {
      band.begin_watch();
      for (const ResolvedSweep& sweep : sweeps_) {
        const bool last = &sweep == &sweeps_.back();
        if (sweep.solve_dt != 0) {
          if (number == 0) solve(sweep, tears);
          team_->barrier();
          band.assign(sweep.assignments, last);
          team_->barrier();
          continue;
        }
        band.copy_halo(sweep);
        team_->barrier();
        band.sweep(sweep, tears, last);
        team_->barrier();
      }
      if (number == 0) {
        end_ = finish_step(tears, fault);
        if (end_ != End::fault) ++done;
      }
      team_->barrier();
    }
  });
  return done;
}

template <class R, unsigned Present>
Advance CpuEngine<R, Present>::advance(int steps, Tears& tears) {
  Advance result;
  const int torn_before = tears.torn_count();
  Fault fault{};
  while (result.steps < steps && !result.diverged && !result.released) {
    const int batch = std::min(steps - result.steps, steps_between_backups);
    for (std::size_t n = 0; n < cloth_.vectors.size(); ++n) backup_[n] = cloth_.vectors[n];
    if (has(part::tearing) && cloth_.preset.F_max > 0) tears_backup_ = tears;
    const int done = run(batch, tears, fault);
    result.diverged = end_ == End::fault;
    result.released = end_ == End::released;
    if (result.diverged) {
      // The sweep works in place: return to the backup and repeat the good steps, which gives the same bits.
      for (std::size_t n = 0; n < cloth_.vectors.size(); ++n) cloth_.vectors[n] = backup_[n];
      if (has(part::tearing) && cloth_.preset.F_max > 0) tears = tears_backup_;
      measure_again();
      Fault none{};
      run(done, tears, none);
      measure_again();
    }
    result.steps += done;
  }
  result.i = fault.i, result.j = fault.j, result.value = fault.value;
  if (result.diverged) result.quantity = fault.quantity;
  result.torn = tears.torn_count() - torn_before;
  for (const auto& band : bands_) result.left_inside += band->left_inside();
  result.hand_force = has(part::hand) && cloth_.held.particle >= 0 ? hand_force_ : glm::dvec3(0);
  return result;
}

// What cpu_engine.cpp, where the class is instantiated, needs of this file.
#define TYGLAB_MAKE(R, present) template Advance CpuEngine<R, (present)>::advance(int, Tears&);
TYGLAB_FOR_EACH_CPU_ENGINE(TYGLAB_MAKE)
#undef TYGLAB_MAKE

}  // namespace tyglab::cpu
