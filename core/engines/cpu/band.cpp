#include "core/engines/cpu/band.h"

#include <algorithm>
#include <limits>

#include "core/forces/contact.h"
#include "core/forces/spring-inl.h"

namespace tyglab::cpu {

template <class R>
Band<R>::Band(Cloth<R>& cloth, int begin, int end) : cloth_(cloth), begin_(begin), end_(end) {
  const std::size_t row = std::size_t(cloth.stride), margin = widest_vector / sizeof(R);
  for (Field& field : ring_) field.resize(row);
  old_row_.resize(row);
  sum_row_.resize(row);
  // The sweep loads rows and columns that lie beyond the halo before it masks them: as in the cloth's own arrays.
  if (begin > 0) head_.x.resize(6 * row + margin), head_.v.resize(6 * row + margin);
  if (end < cloth.lattice.rows) tail_.x.resize(6 * row + margin), tail_.v.resize(6 * row + margin);
}

template <class R>
std::size_t Band<R>::bytes() const {
  std::size_t total = old_row_.bytes() + sum_row_.bytes();
  for (const Field& row : ring_) total += row.bytes();
  for (const Halo* halo : {&head_, &tail_}) total += halo->x.bytes() + halo->v.bytes();
  return total;
}

/// Rows first … first + count - 1 of the sweep's vectors to rows at … of a halo.
template <class R>
void Band<R>::copy_rows(const ResolvedSweep& s, int first, int count, Halo& halo, int at) {
  for (int c = 0; c < 3; ++c) {
    const auto copy = [&](int vector, Field& to) {
      std::copy_n(cloth_.component(vector, c) + cloth_.row_begin(first), std::ptrdiff_t(count) * cloth_.stride,
                  Cloth<R>::component(to, c) + cloth_.row_begin(at));
    };
    copy(s.position, halo.x);
    copy(s.velocity, halo.v);
  }
}

template <class R>
void Band<R>::copy_halo(const ResolvedSweep& s) {
  if (begin_ > 0) copy_rows(s, begin_ - 2, 4, head_, 0);
  if (end_ < cloth_.lattice.rows) copy_rows(s, end_, 2, tail_, 2);
}

template <class R>
RowTask<R> Band<R>::task(const ResolvedSweep& s) {
  RowTask<R> t{};
  t.stride = cloth_.stride;
  t.columns = cloth_.lattice.columns;
  t.L = cloth_.preset.L, t.k_s = cloth_.preset.k_s, t.k_b = cloth_.preset.k_b, t.k_d = s.k_d;
  t.weight = cloth_.preset.m * cloth_.preset.g;
  for (int c = 0; c < 3; ++c) t.W[c] = cloth_.preset.W[c];
  t.v_to_x = s.v_to_x, t.force_to_x = s.force_to_x, t.force_to_v = s.force_to_v;
  t.dt_v = cloth_.preset.dt / cloth_.velocity_scale();
  t.largest_way = largest_way_.data();
  return t;
}

template <class R>
void Band<R>::point(RowTask<R>& t, const Tears& tears, int i, int x_row, Field& x, Field& v) {
  for (int c = 0; c < 3; ++c) {
    t.x[c] = Cloth<R>::component(x, c) + cloth_.row_begin(x_row);
    t.v[c] = Cloth<R>::component(v, c) + cloth_.row_begin(x_row);
    for (int n = 0; n < 3; ++n) t.f[n][c] = force_row(i + n, c);
  }
  t.rows_below = cloth_.lattice.rows - 1 - i;
  t.whole = tears.row(i);
  t.fixed = cloth_.has_fixed(i) ? cloth_.fixed.data() + std::size_t(i) * cloth_.lattice.columns : nullptr;
  t.parity = i & 1;
}

template <class R>
void Band<R>::point_at_row(RowTask<R>& t, const ResolvedSweep& s, const Tears& tears, int i) {
  if (!in_tail(i)) {
    point(t, tears, i, i, cloth_.vectors[std::size_t(s.position)], cloth_.vectors[std::size_t(s.velocity)]);
    return;
  }
  // The last two rows look at the next band's first two, which may have moved on: they are swept in the halo.
  if (i == end_ - 2) copy_rows(s, i, 2, tail_, 0);
  point(t, tears, i, i - (end_ - 2), tail_.x, tail_.v);
}

/// Clears the ring, and computes what the two rows above the band add to its first two.
template <class R>
void Band<R>::begin_forces(RowTask<R>& t, const Tears& tears) {
  const int first = std::max(0, begin_ - 2);
  for (int i = first; i < first + 2; ++i)
    for (int c = 0; c < 3; ++c) std::fill_n(force_row(i, c), cloth_.stride, R(0));
  for (int i = first; i < begin_; ++i) {
    point(t, tears, i, i - first, head_.x, head_.v);
    forces_on_row(t, Update::force);
  }
}

template <class R>
void Band<R>::forces_on_row(const RowTask<R>& t, Update update) {
  if (cloth_.preset.kind == Kind::one_weight) {
    t.f[0][0][0] = R(0), t.f[0][2][0] = R(0);
    t.f[0][1][0] =
        R(HWY_NAMESPACE::hooke(t.x[1][0], cloth_.preset.x_0.y, cloth_.preset.k, t.v[1][0], t.k_d) - t.weight);
    return;
  }
  if (cloth_.preset.W != glm::dvec3(0) && t.rows_below > 0) cloth_.rows.wind(t);
  cloth_.rows.sweep[cloth_.features][std::size_t(update)](t);
}

/// The force on the hand's particle, if it is in this row.
template <class R>
void Band<R>::read_hand(int i) {
  if (cloth_.held.particle < 0 || cloth_.held.particle / cloth_.lattice.columns != i) return;
  const int j = cloth_.held.particle % cloth_.lattice.columns;
  has_hand_ = true;
  hand_force_ = {force_row(i, 0)[j], force_row(i, 1)[j], force_row(i, 2)[j]};
}

/// Pinned and held particles: the force is measured, then set to 0, so a = 0 and they keep the velocity they were
/// given.
template <class R>
void Band<R>::fix_row(int i) {
  read_hand(i);
  for (int n = cloth_.fixed_begin[i]; n < cloth_.fixed_begin[i + 1]; ++n)
    for (int c = 0; c < 3; ++c) force_row(i, c)[cloth_.fixed_columns[n]] = R(0);
}

template <class R>
void Band<R>::assign_row(const ResolvedSweep& s, int i) {
  for (const auto& assignment : s.assignments)
    for (int c = 0; c < 3; ++c) {
      const auto source = [&](int vector) -> const R* {
        return vector == acceleration ? force_row(i, c) : cloth_.component(vector, c) + cloth_.row_begin(i);
      };
      R* target = cloth_.component(assignment.target, c) + cloth_.row_begin(i);
      R* sum = Cloth<R>::component(sum_row_, c);
      std::fill_n(sum, cloth_.lattice.columns, R(0));
      for (const auto [vector, factor] : assignment.terms) {
        const R* from = source(vector);
        const R by = R(factor);
        for (int j = 0; j < cloth_.lattice.columns; ++j) sum[j] += by * from[j];
      }
      std::copy_n(sum, cloth_.lattice.columns, target);
    }
}

template <class R>
void Band<R>::keep_row(int i) {
  for (int c = 0; c < 3; ++c)
    std::copy_n(cloth_.component(vector_x, c) + cloth_.row_begin(i), cloth_.lattice.columns,
                Cloth<R>::component(old_row_, c));
}

/// A row swept in the halo goes back to the cloth.
template <class R>
void Band<R>::give_back_row(const RowTask<R>& t, const ResolvedSweep& s, int i) {
  for (int c = 0; c < 3; ++c) {
    std::copy_n(t.x[c], cloth_.lattice.columns, cloth_.component(s.position, c) + cloth_.row_begin(i));
    std::copy_n(t.v[c], cloth_.lattice.columns, cloth_.component(s.velocity, c) + cloth_.row_begin(i));
  }
}

/// Whether a particle of the row may be inside a body; rounding is left to the exact test.
template <class R>
bool Band<R>::touches(int i) const {
  const R *x = cloth_.component(vector_x, 0) + cloth_.row_begin(i),
          *y = cloth_.component(vector_x, 1) + cloth_.row_begin(i),
          *z = cloth_.component(vector_x, 2) + cloth_.row_begin(i);
  for (const Body& body : cloth_.preset.bodies) {
    int inside = 0;
    if (body.shape == Body::Shape::plane) {
      const R height = std::nextafter(R(body.y), std::numeric_limits<R>::max());
      for (int j = 0; j < cloth_.lattice.columns; ++j) inside |= y[j] < height;
    } else {
      const R cx = R(body.c.x), cy = R(body.c.y), cz = R(body.c.z);
      const double reach = body.r + contact_tolerance(body, body.c, double(std::numeric_limits<R>::epsilon()));
      const R r2 = R(reach * reach * (1 + 8 * double(std::numeric_limits<R>::epsilon())));
      for (int j = 0; j < cloth_.lattice.columns; ++j) {
        const R dx = x[j] - cx, dy = y[j] - cy, dz = z[j] - cz;
        inside |= dx * dx + dy * dy + dz * dz < r2;
      }
    }
    if (inside) return true;
  }
  return false;
}

template <class R>
void Band<R>::collide_row(int i) {
  const std::ptrdiff_t row = cloth_.row_begin(i);
  const double scale = cloth_.keeps_displacement ? cloth_.preset.dt : 1;
  int next_fixed = cloth_.fixed_begin[i];
  for (int j = 0; j < cloth_.lattice.columns; ++j) {
    if (next_fixed < cloth_.fixed_begin[i + 1] && cloth_.fixed_columns[next_fixed] == j) {
      ++next_fixed;
      continue;
    }
    R *x[3], *v[3];
    for (int c = 0; c < 3; ++c)
      x[c] = cloth_.component(vector_x, c) + row + j, v[c] = cloth_.component(vector_v, c) + row + j;
    Passage p{{old_row_.x[j], old_row_.y[j], old_row_.z[j]}, {*x[0], *x[1], *x[2]}, {*v[0], *v[1], *v[2]}};
    if (std::none_of(cloth_.preset.bodies.begin(), cloth_.preset.bodies.end(),
                     [&](const Body& b) { return depth(b, p.x) > 0; }))
      continue;
    p.v /= scale;
    if (!collide(cloth_.preset.bodies, cloth_.preset.dt, double(std::numeric_limits<R>::epsilon()), p)) ++left_inside_;
    for (int c = 0; c < 3; ++c) *x[c] = R(p.x[c]), *v[c] = R(p.v[c] * scale);
  }
}

/// What the row sweep does itself where it makes the update: keeps the largest way.
template <class R>
void Band<R>::watch_row(int i) {
  const R dt = R(cloth_.preset.dt / cloth_.velocity_scale());
  R largest = 0;
  int finite = 1;
  for (int c = 0; c < 3; ++c) {
    const R *x = cloth_.component(vector_x, c) + cloth_.row_begin(i),
            *v = cloth_.component(vector_v, c) + cloth_.row_begin(i), *old = Cloth<R>::component(old_row_, c);
    for (int j = 0; j < cloth_.lattice.columns; ++j) {
      const R way = std::max(std::abs(x[j] - old[j]), std::abs(dt * v[j]));
      largest = way > largest ? way : largest;
      finite &= std::abs(x[j]) + std::abs(v[j]) <= std::numeric_limits<R>::max();  // false for NaN too
    }
  }
  largest_way_[0] = std::max(largest_way_[0], largest);
  finite_ &= finite != 0;
}

template <class R>
void Band<R>::begin_watch() {
  largest_way_.fill(R(0));
  finite_ = true;
  left_inside_ = 0;
}

template <class R>
double Band<R>::largest_way() const {
  double largest = 0;
  bool finite = finite_;
  for (const R way : largest_way_) {
    finite &= std::isfinite(way);
    largest = std::max(largest, double(way));
  }
  return finite ? largest : std::numeric_limits<double>::infinity();
}

template <class R>
void Band<R>::sweep(const ResolvedSweep& s, const Tears& tears, bool last) {
  RowTask<R> t = task(s);
  const bool weight = cloth_.preset.kind == Kind::one_weight;
  const bool bodies = last && !cloth_.preset.bodies.empty() && !weight;
  const bool assigns = weight || s.update == Update::force;
  has_hand_ = false;
  begin_forces(t, tears);
  for (int i = begin_; i < end_; ++i) {
    point_at_row(t, s, tears, i);
    if (bodies || (last && assigns)) keep_row(i);
    forces_on_row(t, assigns ? Update::force : s.update);
    if (assigns)
      fix_row(i), assign_row(s, i);
    else
      read_hand(i);
    if (!assigns && in_tail(i)) give_back_row(t, s, i);
    if (bodies && touches(i)) collide_row(i);
    if (last && assigns) watch_row(i);
  }
}

template <class R>
void Band<R>::accelerations(const ResolvedSweep& s, const Tears& tears, Field& out) {
  RowTask<R> t = task(s);
  const R per_mass = R(1 / cloth_.preset.m);
  const glm::dvec3 hand_force = hand_force_;  // a look must not change what the last step measured
  begin_forces(t, tears);
  for (int i = begin_; i < end_; ++i) {
    point_at_row(t, s, tears, i);
    forces_on_row(t, Update::force);
    fix_row(i);
    for (int c = 0; c < 3; ++c) {
      const R* force = force_row(i, c);
      R* a = Cloth<R>::component(out, c) + cloth_.row_begin(i);
      for (int j = 0; j < cloth_.lattice.columns; ++j) a[j] = force[j] * per_mass;
    }
  }
  hand_force_ = hand_force;
}

template class Band<float>;
template class Band<double>;

}  // namespace tyglab::cpu
