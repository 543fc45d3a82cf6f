#include "core/engines/cpu/projection.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "core/forces/force.h"

namespace tyglab::cpu {
namespace {

constexpr int E = 0, S = 1, SE = 2, SW = 3, EE = 4, SS = 5;  // directions
constexpr double softest = 1e30;                             // m/(k dt²): softer springs move nothing

}  // namespace

template <class R>
void Projector<R>::prepare(const Cloth<R>& cloth, const Tears& tears, bool changed) {
  if (rows_ == 0) {
    lambda_.assign(std::size_t(cloth.lattice.rows) * lambdas * cloth.stride + widest_vector / sizeof(R), R(0));
    rows_ = cloth.lattice.rows, stride_ = cloth.stride;
    changed = true;
  }
  if (changed || springs_ != cloth.springs.version()) find_stencils(cloth, tears);
  if (!changed) return;
  masked_ = !tears.untorn() || !cloth.fixed.empty();
  if (!masked_) return;
  const int columns = cloth.lattice.columns;
  free_.assign(std::size_t(rows_) * stride_ + widest_vector / sizeof(R), R(1));
  whole_.assign(std::size_t(rows_) * directions.size() * stride_ + widest_vector / sizeof(R), R(1));
  row_free_.assign(std::size_t(rows_), 1);
  row_whole_.assign(std::size_t(rows_) * directions.size(), 1);
  for (int i = 0; i < rows_; ++i)
    for (int j = 0; j < columns; ++j) {
      const std::size_t p = std::size_t(i) * columns + j;
      if (!cloth.fixed.empty() && cloth.fixed[p] != 0)
        free_[std::size_t(i) * stride_ + j] = R(0), row_free_[std::size_t(i)] = 0;
      for (int d = 0; d < int(directions.size()); ++d)
        if (!tears.whole(d, i, j)) {
          const std::size_t row = std::size_t(i) * directions.size() + d;
          whole_[row * stride_ + j] = R(0), row_whole_[row] = 0;
        }
    }
}

/// Where the springs of a color in row i lie: the first elements of both ends' rows. False where there are none.
template <class R>
template <class Row>
bool Projector<R>::place(const Cloth<R>& cloth, const Color& color, int i, Row& row, int& upper, int& lower) const {
  const Direction& to = directions[std::size_t(color.direction)];
  const int columns = cloth.lattice.columns;
  row.stride = cloth.stride;
  assert(i >= 0 && i < rows_);
  if (to.di == 0) {
    row.reach = to.dj;
    upper = lower = color.first;
    row.count = columns - color.first;
    if (row.count <= row.reach) return false;
  } else {
    upper = std::max(0, -to.dj), lower = upper + to.dj;
    row.count = columns - std::abs(to.dj);
    if (row.count <= 0 || i + to.di >= rows_) return false;
  }
  const std::size_t springs = std::size_t(i) * directions.size() + color.direction;
  row.free_a = row.free_b = row.whole = nullptr;
  if (masked_ && !(row_free_[std::size_t(i)] && row_free_[std::size_t(i + to.di)] && row_whole_[springs])) {
    row.free_a = free_.data() + std::size_t(i) * stride_ + upper;
    row.free_b = free_.data() + std::size_t(i + to.di) * stride_ + lower;
    row.whole = whole_.data() + springs * stride_ + upper;
  }
  return true;
}

template <class R>
void Projector<R>::project_color(Cloth<R>& cloth, int q, const Color& color, int i, ProjectionRow<R>& row) {
  assert(color.lambda >= 0 && color.lambda < lambdas);
  const Direction& to = directions[std::size_t(color.direction)];
  int upper = 0, lower = 0;
  if (!(row.compliance < softest) || !place(cloth, color, i, row, upper, lower)) return;
  row.x_a = cloth.row(vector_x, i, 0) + upper, row.x_b = cloth.row(vector_x, i + to.di, 0) + lower;
  row.q_a = cloth.row(q, i, 0) + upper, row.q_b = cloth.row(q, i + to.di, 0) + lower;
  row.lambda = lambda_.data() + (std::size_t(i) * lambdas + color.lambda) * stride_ + upper;
  project_row(row);
}

template <class R>
void Projector<R>::damp_color(Cloth<R>& cloth, const Color& color, int i, const Decay& both_free,
                              const Decay& one_free) {
  const Direction& to = directions[std::size_t(color.direction)];
  DampingRow<R> row;
  int upper = 0, lower = 0;
  if (!place(cloth, color, i, row, upper, lower)) return;
  row.v_a = cloth.row(vector_v, i, 0) + upper, row.v_b = cloth.row(vector_v, i + to.di, 0) + lower;
  row.both = both_free.lost / 2, row.one = one_free.lost;
  damp_row(row);
}

template <class R>
template <class Work>
void Projector<R>::in_colors(int begin, int end, bool bending, Team& team, Work work) {
  assert(begin % 2 == 0);
  static constexpr Color in_row[]{{E, 0, 0}, {E, 1, 1}, {EE, 0, 2}, {EE, 2, 3}};
  static constexpr Color to_next[]{{S, 0, 4}, {SE, 0, 5}, {SW, 0, 6}};
  static constexpr Color to_second{SS, 0, 7};
  // Rows of even number first, with what lies within them and below; then what joins pairs to pairs.
  for (int i = begin; i < end; i += 2) {
    for (int row = i; row < std::min(i + 2, end); ++row)
      for (const Color& color : in_row)
        if (bending || color.direction == E) work(color, row);
    for (const Color& color : to_next) work(color, i);
  }
  team.barrier();
  for (int i = begin + 1; i < end; i += 2)
    for (const Color& color : to_next) work(color, i);
  team.barrier();
  if (!bending) return;
  for (const int first : {0, 2}) {
    for (int i = begin; i < end; ++i)
      if ((i & 2) == first) work(to_second, i);
    team.barrier();
  }
}

template <class R>
void Projector<R>::find_stencils(const Cloth<R>& cloth, const Tears& tears) {
  linear_.clear();
  for_each_stencil(cloth.preset, [&](const Force& force, const Stencil& stencil) {
    if (force.linear == nullptr) return;
    LinearColor& color = linear_.emplace_back();
    color.stencil = &stencil, color.constant = force.linear(cloth.preset, stencil);
    color.acts.resize(std::size_t(cloth.lattice.size()));
    color.lambda.resize(3 * color.acts.size());
    for (int i = 0; i < rows_; ++i)
      for (int j = 0; j < cloth.lattice.columns; ++j)
        color.acts[std::size_t(i * cloth.lattice.columns + j)] = stencil.acts(tears, i, j);
  });
  springs_ = cloth.springs.version();
}

/// The stencils of a color that row i owns, from left to right.
template <class R>
void Projector<R>::project_stencils(Cloth<R>& cloth, int q, LinearColor& color, int i) {
  const int columns = cloth.lattice.columns, points = color.stencil->points;
  const R compliance = R(cloth.preset.m / (color.constant * cloth.dt * cloth.dt));
  if (!(compliance < R(softest))) return;
  for (int j = 0; j < columns; ++j) {
    const std::size_t owner = std::size_t(i * columns + j);
    if (color.acts[owner] == 0) continue;
    R free[Stencil::most_points], squares = compliance;
    for (int n = 0; n < points; ++n) {
      const auto& [di, dj, weight] = color.stencil->at[std::size_t(n)];
      const bool moves = cloth.fixed.empty() || cloth.fixed[std::size_t((i + di) * columns + j + dj)] == 0;
      free[n] = moves ? R(weight) : R(0), squares += free[n] * free[n];
    }
    for (int c = 0; c < 3; ++c) {
      R& lambda = color.lambda[3 * owner + std::size_t(c)];
      R lacking = compliance * lambda;
      for (int n = 0; n < points; ++n) {
        const auto& [di, dj, weight] = color.stencil->at[std::size_t(n)];
        lacking += R(weight) * (cloth.row(vector_x, i + di, c)[j + dj] + cloth.row(q, i + di, c)[j + dj]);
      }
      const R by = -lacking / squares;
      lambda += by;
      for (int n = 0; n < points; ++n) {
        const auto& [di, dj, weight] = color.stencil->at[std::size_t(n)];
        cloth.row(q, i + di, c)[j + dj] += free[n] * by;
      }
    }
  }
}

template <class R>
void Projector<R>::project_weight(Cloth<R>& cloth, int q) {
  const Preset& p = cloth.preset;
  // One spring, linear: a single step of Gauss-Seidel solves it.
  const double compliance = p.m / (p.k * cloth.dt * cloth.dt);
  if (!(compliance < softest)) return;
  R* way = cloth.row(q, 0, 1);
  way[0] -= R((double(cloth.row(vector_x, 0, 1)[0]) + double(way[0]) - p.x_0.y) / (1 + compliance));
}

template <class R>
bool Projector<R>::project(Cloth<R>& cloth, int q, int begin, int end, Team& team,
                           const std::function<bool(int n)>& goes_on) {
  if (cloth.preset.kind == Kind::one_weight) {
    if (begin == 0) project_weight(cloth, q);
    team.barrier();
    return true;
  }
  assert(end % 2 == 0 || end == rows_);
  assert(rows_ == cloth.lattice.rows && stride_ == cloth.stride);
  assert(cloth.dt > 0 && cloth.preset.m > 0 && cloth.preset.iterations >= 1);
  std::array<ProjectionRow<R>, directions.size()> of_direction;
  const Preset& p = cloth.preset;
  for (std::size_t d = 0; d < directions.size(); ++d) {
    ProjectionRow<R>& row = of_direction[d];
    row.rest = directions[d].rest * p.L, row.pushes = directions[d].bending;
    row.soften(p.m / (spring_constant(p, directions[d]) * cloth.dt * cloth.dt));
  }
  const std::size_t pitch = std::size_t(lambdas) * stride_;
  std::fill(lambda_.begin() + std::ptrdiff_t(begin * pitch), lambda_.begin() + std::ptrdiff_t(end * pitch), R(0));
  for (LinearColor& color : linear_) {
    const std::ptrdiff_t columns = 3 * cloth.lattice.columns;
    std::fill(color.lambda.begin() + begin * columns, color.lambda.begin() + end * columns, R(0));
  }
  for (int n = 0; n < cloth.preset.iterations; ++n) {
    // Read by all after the barriers of this iteration, and written again after those of the next.
    bool& stopped = stopped_[n % 2];
    if (begin == 0) stopped = n > 0 && !goes_on(n);
    in_colors(begin, end, force::bend.on(p), team, [&](const Color& color, int i) {
      project_color(cloth, q, color, i, of_direction[std::size_t(color.direction)]);
    });
    for (LinearColor& color : linear_) {
      // Rows that share no particle at a time.
      int rows = 1;
      for (int point = 0; point < color.stencil->points; ++point)
        rows = std::max(rows, color.stencil->at[std::size_t(point)].di + 1);
      for (int first = 0; first < rows; ++first) {
        for (int i = begin; i < end; ++i)
          if (i % rows == first) project_stencils(cloth, q, color, i);
        team.barrier();
      }
    }
    if (stopped) return false;
  }
  return true;
}

template <class R>
void Projector<R>::damp(Cloth<R>& cloth, int begin, int end, Team& team) {
  if (cloth.preset.k_d == 0) return;
  const double times = cloth.preset.k_d * cloth.dt / cloth.preset.m;  // of the decay of one particle: dt over it
  const Decay one_free = decay_over(times), both_free = decay_over(2 * times);
  assert(one_free.lost >= 0 && both_free.lost >= one_free.lost && both_free.lost <= 1);
  if (cloth.preset.kind == Kind::one_weight) {
    if (begin == 0) cloth.row(vector_v, 0, 1)[0] *= R(one_free.kept);
    team.barrier();
    return;
  }
  in_colors(begin, end, false, team,
            [&](const Color& color, int i) { damp_color(cloth, color, i, both_free, one_free); });
}

template <class R>
std::size_t Projector<R>::bytes() const {
  return (lambda_.size() + free_.size() + whole_.size()) * sizeof(R) + row_free_.size() + row_whole_.size() +
         linear_.size() * rows_ * stride_ * (1 + 3 * sizeof(R));
}

template class Projector<float>;
template class Projector<double>;

}  // namespace tyglab::cpu
