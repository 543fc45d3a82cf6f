#include "core/engines/cpu/band.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <functional>
#include <limits>

#include "core/engines/cpu/row_update.h"
#include "core/forces/force.h"
#include "core/forces/spring-inl.h"
#include "core/simd/row_field.h"

namespace tyglab::cpu {
namespace {

constexpr int ring_lead = 43;  // cache lines: away from where the vectors lie in their pages (row_field.h)

/// Rows of a block. Narrow ones go together, since what is done once for each call would cost as much as they do; what
/// a block needs stays in the first-level cache.
int rows_of_block(std::size_t bytes_of_row) {
  constexpr std::size_t block = 4096;  // bytes of forces
  return int(std::bit_floor(std::max(std::size_t(2), block / bytes_of_row)));
}

}  // namespace

template <class R, unsigned Present>
Band<R, Present>::Band(Cloth<R>& cloth, int begin, int end)
    : cloth_(cloth), block_(rows_of_block(3 * std::size_t(cloth.stride) * sizeof(R))) {
  assert(block_ >= 2 && std::has_single_bit(unsigned(block_)));  // a ring's rows are found by a mask
  ring_.resize(2 * block_, cloth.stride, ring_lead);
  // The sweep loads rows that lie beyond the halo before it masks them: as in the cloth's own arrays.
  if (begin > 0) head_.x.resize(6, cloth.stride), head_.v.resize(6, cloth.stride);
  if (end < cloth.lattice.rows) tail_.x.resize(6, cloth.stride), tail_.v.resize(6, cloth.stride);
  cover(begin, end);
}

template <class R, unsigned Present>
void Band<R, Present>::cover(int begin, int end) {
  assert(begin % 2 == 0 && (end % 2 == 0 || end == cloth_.lattice.rows));
  assert((begin == 0 && end == cloth_.lattice.rows) || end - begin >= least_rows);
  assert((begin == 0 || !head_.x.empty()) && (end == cloth_.lattice.rows || !tail_.x.empty()));
  begin_ = begin, end_ = end;
}

template <class R, unsigned Present>
void Band<R, Present>::allocate(bool old_rows, bool old_velocities) {
  if (old_rows && old_rows_.empty()) old_rows_.resize(block_, cloth_.stride);
  if (old_velocities && old_velocities_.empty()) old_velocities_.resize(block_, cloth_.stride);
  if (!force::curl.on(cloth_.preset)) return;
  curl_.allocate(cloth_.preset);
  if (curled_.empty()) curled_.resize(2, cloth_.stride);
}

template <class R, unsigned Present>
std::size_t Band<R, Present>::bytes() const {
  std::size_t total = ring_.bytes() + old_rows_.bytes() + old_velocities_.bytes();
  total += curled_.bytes() + curl_.bytes();
  for (const Halo* halo : {&head_, &tail_}) total += halo->x.bytes() + halo->v.bytes();
  return total;
}

/// Rows first … first + count - 1 of the sweep's vectors to rows at … of a halo.
template <class R, unsigned Present>
void Band<R, Present>::copy_rows(const ResolvedSweep& s, int first, int count, Halo& halo, int at) {
  assert(first >= 0 && at >= 0 && count > 0 && at + count <= 4);
  const Field &x = cloth_.vector(s.position), &v = cloth_.vector(s.velocity);
  std::copy_n(x.row(first), count * x.pitch(), halo.x.row(at));
  std::copy_n(v.row(first), count * v.pitch(), halo.v.row(at));
}

template <class R, unsigned Present>
void Band<R, Present>::copy_halo(const ResolvedSweep& s) {
  if (begin_ > 0) copy_rows(s, begin_ - 2, 4, head_, 0);
  if (end_ < cloth_.lattice.rows) copy_rows(s, end_, 2, tail_, 2);
}

template <class R, unsigned Present>
PairTask<R> Band<R, Present>::task(const ResolvedSweep& s) {
  assert(cloth_.dt > 0 && cloth_.preset.m > 0);
  PairTask<R> t{};
  t.stride = cloth_.stride;
  t.columns = cloth_.lattice.columns;
  t.L = cloth_.preset.L;
  const bool weight = cloth_.preset.kind == Kind::one_weight;
  const SpringConstants springs = spring_constants(cloth_.preset);
  if (!s.external) {
    t.weft = weight ? cloth_.preset.k : springs.weft, t.warp = springs.warp, t.shear = springs.shear;
    t.bend = springs.bend, t.k_d = s.k_d;
  }
  const bool air_alone = s.air == ResolvedSweep::Air::alone;
  features_ = air_alone    ? cloth_.features & unsigned(air)
              : s.external ? cloth_.features & unsigned(wind | air)
                           : cloth_.features;
  if (s.air == ResolvedSweep::Air::none) features_ &= ~unsigned(air);
  if (air_alone)
    t.weft = t.warp = t.shear = t.bend = t.k_d = 0;
  else
    t.weight = cloth_.preset.m * cloth_.preset.g;
  for (int c = 0; c < 3; ++c) t.W[c] = cloth_.preset.W[c];
  if ((features_ & air) != 0) take_air(t, s.per_velocity);
  curl_.begin(cloth_.preset, !air_alone);
  t.v_to_x = s.v_to_x, t.force_to_x = s.force_to_x, t.force_to_v = s.force_to_v;
  t.dt_v = cloth_.dt / cloth_.velocity_scale();
  t.max_displacement = max_displacement_.data();
  return t;
}

/// The constants of F_air (air.cpp) for velocities that are to be multiplied by `per`.
template <class R, unsigned Present>
void Band<R, Present>::take_air(PairTask<R>& t, double per) {
  const Preset& p = cloth_.preset;
  // ½ρA, where twice the area is |n|, on each of three corners.
  const double corner = per * per * p.air_density / 12;
  for (int c = 0; c < 3; ++c) t.u[c] = p.u[c] / per;
  t.air_across = corner * p.C_N, t.air_along = corner * p.C_T;
  t.air_most = per * most_air_damping(p, cloth_.dt);
}

template <class R, unsigned Present>
void Band<R, Present>::point(PairTask<R>& t, const Tears& tears, int i, int x_row, Field& x, Field& v) {
  t.x = x.row(x_row), t.v = v.row(x_row);
  for (int n = 0; n < 4; ++n) t.f[n] = force_row(i + n, 0);
  t.rows_below = cloth_.lattice.rows - 1 - i;
  t.whole = has(part::tearing) ? tears.row(i) : nullptr;
  if ((features_ & unsigned(linear)) != 0) {
    assert(!cloth_.springs.empty());  // whoever sweeps has followed them
    for (const int row : {0, 1}) t.linear[row] = cloth_.springs.row(std::min(i + row, cloth_.lattice.rows - 1));
  }
  for (const int row : {0, 1})
    t.fixed[row] = has(part::pins) && i + row < cloth_.lattice.rows && cloth_.has_fixed(i + row)
                       ? cloth_.fixed.data() + std::size_t(i + row) * cloth_.lattice.columns
                       : nullptr;
}

template <class R, unsigned Present>
void Band<R, Present>::point_at_pair(PairTask<R>& t, const ResolvedSweep& s, const Tears& tears, int i) {
  if (!in_tail(i)) {
    point(t, tears, i, i, cloth_.vector(s.position), cloth_.vector(s.velocity));
    return;
  }
  // The last pair looks at the next band's first one, which may have moved on: it is swept in the halo.
  copy_rows(s, i, 2, tail_, 0);
  point(t, tears, i, 0, tail_.x, tail_.v);
}

/// Clears the ring's first pair, and computes what the pair above the band adds to it.
template <class R, unsigned Present>
void Band<R, Present>::begin_forces(PairTask<R>& t, const Tears& tears) {
  const int first = std::max(0, begin_ - 2);
  for (int i = first; i < first + 2; ++i) std::fill_n(force_row(i, 0), ring_.pitch(), R(0));
  if (begin_ == 0) return;
  point(t, tears, first, 0, head_.x, head_.v);
  forces_on_pair(t, tears, first, Update::force);
}

/// What F_curl does to the rows of a pair and to the two below, which the sweep of the pair begins.
template <class R, unsigned Present>
void Band<R, Present>::curl_pair(const PairTask<R>& t, const Tears& tears, int i) {
  assert(!curled_.empty());
  std::fill_n(curled_.row(0), 2 * curled_.pitch(), R(0));
  curl_.add(tears, i, t.x, t.stride, {t.f[0], t.f[1], curled_.row(0), curled_.row(1)});
}

template <class R, unsigned Present>
void Band<R, Present>::pass_on_curl(const PairTask<R>& t) {
  for (const int row : {0, 1})
    for (std::ptrdiff_t n = 0; n < curled_.pitch(); ++n) t.f[2 + row][n] += curled_.row(row)[n];
}

template <class R, unsigned Present>
void Band<R, Present>::forces_on_pair(PairTask<R>& t, const Tears& tears, int i, Update update) {
  if (cloth_.preset.kind == Kind::one_weight) {
    const R x = t.x[t.stride], v = t.v[t.stride];
    t.f[0][0] = R(0), t.f[0][2 * t.stride] = R(0);
    t.f[0][t.stride] = R(HWY_NAMESPACE::hooke(x, cloth_.preset.x_0.y, t.weft, v, t.k_d) - t.weight);
    return;
  }
  t.update = update;
  const auto& sweeps = cloth_.sweeps.sweep[features_];
  const auto sweep = update == Update::displacement ? sweeps.displacement : sweeps.other;
  if (cloth_.near_force != nullptr) add_near_force(t, i);
  if (!curl_.acts()) return sweep(t);
  curl_pair(t, tears, i);
  sweep(t);
  pass_on_curl(t);
}

/// The sweep subtracts what stands in the rows from the forces that it computes.
template <class R, unsigned Present>
void Band<R, Present>::add_near_force(const PairTask<R>& t, int i) {
  for (int row = i; row < std::min(i + 2, cloth_.lattice.rows); ++row) {
    if (cloth_.near_rows != nullptr && cloth_.near_rows[row] == 0) continue;
    const R* from = cloth_.near_force->row(row);
    std::transform(t.f[row - i], t.f[row - i] + ring_.pitch(), from, t.f[row - i], std::minus<>());
  }
}

/// The force on the hand's particle, if it is in this row.
template <class R, unsigned Present>
void Band<R, Present>::read_hand(int i) {
  if (cloth_.held.particle < 0 || cloth_.held.particle / cloth_.lattice.columns != i) return;
  const int j = cloth_.held.particle % cloth_.lattice.columns;
  assert(cloth_.fixed[std::size_t(cloth_.held.particle)] != 0);
  has_hand_ = true;
  hand_force_ = {force_row(i, 0)[j], force_row(i, 1)[j], force_row(i, 2)[j]};
}

/// Pinned and held particles: the force is measured, then set to 0, so a = 0 and they keep the velocity they were
/// given.
template <class R, unsigned Present>
void Band<R, Present>::fix_row(int i) {
  if constexpr (has(part::hand)) read_hand(i);
  if constexpr (!has(part::pins)) return;
  assert(cloth_.fixed_begin[i] <= cloth_.fixed_begin[i + 1] &&
         std::size_t(cloth_.fixed_begin[i + 1]) <= cloth_.fixed_columns.size());
  for (int n = cloth_.fixed_begin[i]; n < cloth_.fixed_begin[i + 1]; ++n)
    for (int c = 0; c < 3; ++c) force_row(i, c)[cloth_.fixed_columns[n]] = R(0);
}

/// Assignments as sums over rows, found once for all rows.
template <class R, unsigned Present>
void Band<R, Present>::begin_sums(const std::vector<ResolvedSweep::ResolvedAssignment>& assignments) {
  assert(assignments.size() <= std::size_t(RowSums<R>::most));
  sums_.count = 0;
  for (const auto& assignment : assignments) {
    assert(!assignment.terms.empty() && assignment.terms.size() <= std::size_t(RowSum<R>::most_terms));
    RowSum<R>& sum = sums_.sum[sums_.count++];
    sum.target = cloth_.row(assignment.target, 0, 0), sum.terms = 0;
    for (const auto [vector, factor] : assignment.terms) {
      sum.source[sum.terms] = vector == acceleration ? nullptr : cloth_.row(vector, 0, 0);
      sum.factor[sum.terms++] = R(factor);
    }
  }
}

template <class R, unsigned Present>
void Band<R, Present>::sum_rows(int i, int count) {
  make_sums(sums_, i * 3 * std::ptrdiff_t(cloth_.stride), force_row(i, 0),
            RowRun{cloth_.stride, cloth_.lattice.columns, count});
}

template <class R, unsigned Present>
void Band<R, Present>::save_rows(int i, int count, bool bodies) {
  std::copy_n(cloth_.row(vector_x, i, 0), count * old_rows_.pitch(), old_row(i, 0));
  if (bodies && !cloth_.contacts.at_ends)
    std::copy_n(cloth_.row(vector_v, i, 0), count * old_rows_.pitch(), old_velocity(i, 0));
}

/// A pair swept in the halo goes back to the cloth.
template <class R, unsigned Present>
void Band<R, Present>::restore_pair(const PairTask<R>& t, const ResolvedSweep& s, int i) {
  Field &x = cloth_.vector(s.position), &v = cloth_.vector(s.velocity);
  std::copy_n(t.x, 2 * x.pitch(), x.row(i));
  std::copy_n(t.v, 2 * v.pitch(), v.row(i));
}

/// The least coordinate of a row's particles along the normal of a plane, m.
template <class R, unsigned Present>
R Band<R, Present>::lowest(const PlacedBody& plane, const R* x) const {
  if (!plane.turns) return simd::lowest(x, cloth_.stride, cloth_.lattice.columns);
  const R n[] = {R(plane.axes[3]), R(plane.axes[4]), R(plane.axes[5])};
  const R *y = x + cloth_.stride, *z = y + cloth_.stride;
  R least = std::numeric_limits<R>::infinity();
  for (int j = 0; j < cloth_.lattice.columns; ++j) least = std::min(least, n[0] * x[j] + n[1] * y[j] + n[2] * z[j]);
  return least;
}

/// Whether a particle of the row may meet a body; rounding is left to the exact test.
template <class R, unsigned Present>
bool Band<R, Present>::touches(int i) {
  const R* x = cloth_.row(vector_x, i, 0);
  const R* from = cloth_.contacts.at_ends ? x : old_row(i, 0);
  constexpr double epsilon = double(std::numeric_limits<R>::epsilon());
  for (const PlacedBody& body : *pass_.bodies) {
    if (body.shape == std::int32_t(Body::Shape::plane)) {
      if (double(lowest(body, x)) < body.reach) return true;
      continue;
    }
    const R center[] = {R(body.c[0]), R(body.c[1]), R(body.c[2])};
    if (double(simd::nearest_squared(from, x, cloth_.stride, cloth_.lattice.columns, center)) <
        body.reach * body.reach * (1 + 8 * epsilon))
      return true;
  }
  return false;
}

template <class R, unsigned Present>
void Band<R, Present>::collide_row(int i) {
  const double scale = cloth_.velocity_scale();
  Contacts rule = cloth_.contacts;
  rule.dt = cloth_.dt;
  int next_fixed = cloth_.fixed_begin[i];
  for (int j = 0; j < cloth_.lattice.columns; ++j) {
    if (has(part::pins) && next_fixed < cloth_.fixed_begin[i + 1] && cloth_.fixed_columns[next_fixed] == j) {
      ++next_fixed;
      continue;
    }
    R *x[3], *v[3];
    ContactStep p;
    for (int c = 0; c < 3; ++c) {
      x[c] = cloth_.row(vector_x, i, c) + j, v[c] = cloth_.row(vector_v, i, c) + j;
      p.old_x[c] = old_row(i, c)[j], p.x[c] = *x[c], p.v[c] = *v[c] / scale;
      if (!rule.at_ends) p.old_v[c] = old_velocity(i, c)[j] / scale;
    }
    if (!meets(*pass_.bodies, rule, p)) continue;
    const ContactStep freely = p;
    collided_ = true;
    if (!collide(*pass_.bodies, rule, p)) ++left_inside_;
    for (int c = 0; c < 3; ++c) {
      *x[c] = R(p.x[c]), *v[c] = R(p.v[c] * scale);
      // What damping sees is changed as much; at the ends of steps alone it becomes the same.
      if (R& seen = cloth_.row(cloth_.seen_velocity, i, c)[j]; &seen != v[c])
        seen = rule.at_ends ? *v[c] : R(seen + (p.v[c] - freely.v[c]) * scale);
      // A body that was moved into the cloth may push a particle further than it would have gone.
      max_displacement_[0] = std::max(max_displacement_[0], std::abs(*x[c] - old_row(i, c)[j]));
    }
    if (cloth_.notes_contacts)
      contacts_.push_back({i * cloth_.lattice.columns + j, freely.x - glm::dvec3(*x[0], *x[1], *x[2]),
                           freely.v - glm::dvec3(*v[0], *v[1], *v[2]) / scale});
  }
  assert(!has(part::pins) || next_fixed == cloth_.fixed_begin[i + 1]);  // all were met, in order
}

/// What the pair sweep does itself where it makes the update: keeps the largest way.
template <class R, unsigned Present>
void Band<R, Present>::watch_rows(int i, int count) {
  watch_displacements(cloth_.row(vector_x, i, 0), old_row(i, 0), cloth_.row(vector_v, i, 0),
                      R(cloth_.dt / cloth_.velocity_scale()), RowRun{cloth_.stride, cloth_.lattice.columns, count},
                      max_displacement_.data());
}

template <class R, unsigned Present>
void Band<R, Present>::measure(const ResolvedEstimate& estimate, const ResolvedSweep& s, int i) {
  assert(estimate.shares.size() <= std::size_t(RowEstimate<R>::most_terms));
  assert(cloth_.measures.size() == std::size_t(cloth_.lattice.rows));
  RowEstimate<R> row{.x = cloth_.row(s.position, i, 0), .dt = R(cloth_.dt)};
  for (const auto& share : estimate.shares) {
    const int n = row.terms++;
    row.source[n] = cloth_.row(share.vector, i, 0);
    row.error_x[n] = R(share.error_x), row.error_v[n] = R(share.error_v);
    row.stage_x[n] = R(share.stage_x), row.stage_v[n] = R(share.stage_v), row.stage_a[n] = R(share.stage_a);
  }
  cloth_.measures[std::size_t(i)] = measure_row(row, cloth_.stride, cloth_.lattice.columns);
}

template <class R, unsigned Present>
void Band<R, Present>::reset_watch() {
  max_displacement_.fill(R(0));
  contacts_.clear();
  left_inside_ = 0;
  collided_ = false;
}

template <class R, unsigned Present>
double Band<R, Present>::max_displacement() const {
  double largest = 0;
  bool finite = true;
  for (const R way : max_displacement_) {
    finite &= std::isfinite(way);
    largest = std::max(largest, double(way));
  }
  return finite ? largest : std::numeric_limits<double>::infinity();
}

/// The bodies that act in a step of the batch; null: none do.
template <class R, unsigned Present>
const std::vector<PlacedBody>* Band<R, Present>::bodies_in(int step) const {
  if (!has(part::bodies) || cloth_.preset.bodies.empty()) return nullptr;
  const std::size_t n = cloth_.bodies_move ? std::size_t(step) : 0;
  assert(n < cloth_.bodies.size());
  return &cloth_.bodies[n];
}

template <class R, unsigned Present>
void Band<R, Present>::begin_sweep(const ResolvedSweep& s, const Tears& tears, bool last, int step) {
  const bool weight = cloth_.preset.kind == Kind::one_weight;
  pass_ = {&s, &tears, task(s), last, last ? bodies_in(step) : nullptr, weight || s.update == Update::force};
  has_hand_ = false;
  if (pass_.assigns) begin_sums(s.assignments);
  begin_forces(pass_.task, tears);
}

/// Rows of one block. What follows the forces may wait for those of the whole block: no pair looks at rows above it.
template <class R, unsigned Present>
void Band<R, Present>::sweep_rows(int i, int count) {
  const ResolvedSweep& s = *pass_.sweep;
  const bool last = pass_.last, bodies = pass_.bodies != nullptr, assigns = pass_.assigns;
  const int end = i + count;
  assert(i >= begin_ && end <= end_ && count > 0 && count <= block_);
  if (bodies || (last && assigns)) save_rows(i, count, bodies);
  for (int pair = i; pair < end; pair += 2) {
    point_at_pair(pass_.task, s, *pass_.tears, pair);
    forces_on_pair(pass_.task, *pass_.tears, pair, assigns ? Update::force : s.update);
    if (!assigns && in_tail(pair)) restore_pair(pass_.task, s, pair);
  }
  if (assigns) {
    for (int row = i; row < end; ++row) fix_row(row);
    sum_rows(i, count);
  } else if constexpr (has(part::hand)) {
    for (int row = i; row < end; ++row) read_hand(row);
  }
  for (int row = i; bodies && row < end; ++row)
    if (touches(row)) collide_row(row);
  if (last && assigns) watch_rows(i, count);
  for (int row = i; s.estimate != nullptr && row < end; ++row) measure(*s.estimate, s, row);
}

template <class R, unsigned Present>
void Band<R, Present>::sweep(const ResolvedSweep& s, const Tears& tears, bool last) {
  begin_sweep(s, tears, last);
  for (int i = begin_; i < end_; i += block_) sweep_rows(i, rows_of(i, block_));
}

template <class R, unsigned Present>
void Band<R, Present>::assign(const std::vector<ResolvedSweep::ResolvedAssignment>& assignments, bool last) {
  pass_.bodies = last ? bodies_in(0) : nullptr;
  const bool bodies = pass_.bodies != nullptr;
  begin_sums(assignments);
  for (int i = begin_; i < end_; i += block_) {
    const int count = rows_of(i, block_);
    if (last) save_rows(i, count, bodies);
    sum_rows(i, count);
    for (int row = i; bodies && row < i + count; ++row)
      if (touches(row)) collide_row(row);
    if (last) watch_rows(i, count);
  }
}

template <class R, unsigned Present>
void Band<R, Present>::accelerations(const ResolvedSweep& s, const Tears& tears, Field& out, bool of_step) {
  assert(out.pitch() == ring_.pitch());
  PairTask<R> t = task(s);
  const R per_mass = R(1 / cloth_.preset.m);
  const glm::dvec3 hand_force = hand_force_;  // a look must not change what the last step measured
  begin_forces(t, tears);
  for (int i = begin_; i < end_; i += 2) {
    point_at_pair(t, s, tears, i);
    forces_on_pair(t, tears, i, Update::force);
    for (int row = i; row < std::min(i + 2, end_); ++row) {
      fix_row(row);
      for (int c = 0; c < 3; ++c) {
        const R* force = force_row(row, c);
        R* a = out.row(row, c);
        for (int j = 0; j < cloth_.lattice.columns; ++j) a[j] = force[j] * per_mass;
      }
    }
  }
  if (!of_step) hand_force_ = hand_force;
}

#define TYGLAB_MAKE(R, present) template class Band<R, (present)>;
TYGLAB_FOR_EACH_CPU_ENGINE(TYGLAB_MAKE)
#undef TYGLAB_MAKE

}  // namespace tyglab::cpu
