#include "core/engines/cpu/block_descent.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "core/forces/force.h"

namespace tyglab::cpu {
namespace {

// In place of a piece: the particle is fixed, or its piece is not known yet.
constexpr int of_fixed = -1, of_none = -2;

static_assert(links_of_a_particle == 2 * int(directions.size()));
/// No spring joins two particles of one color.
constexpr bool colors_differ(int colors) {
  return std::none_of(directions.begin(), directions.end(),
                      [colors](const Direction& to) { return (to.di + 2 * to.dj) % colors == 0; });
}
static_assert(colors_differ(BlockDescent<float>::colors));
/// Of a BlockRow's link in that direction.
enum : int { of_weft, of_warp, of_shear, of_bending };
int kind_of(const Direction& to) {
  return to.bending ? of_bending : to.di == 0 ? of_weft : to.dj == 0 ? of_warp : of_shear;
}

}  // namespace

template <class R>
void BlockDescent<R>::prepare(const Cloth<R>& cloth, const Tears& tears, double h, bool changed) {
  const Preset& p = cloth.preset;
  assert(h > 0 && p.m > 0 && p.L > 0);
  assert(rows_ == 0 || (rows_ == cloth.lattice.rows && columns_ == cloth.lattice.columns));
  const auto [weft, warp, shear, bend] = spring_constants(p);
  const auto scaled = [&](double k) { return h * h * k / p.m; };
  constants_ = {scaled(weft), scaled(warp), scaled(shear), scaled(bend), h * p.k_d / p.m, p.L, h * h / p.m};
  h_ = h, gravity_ = p.g;
  if (rows_ == 0) {
    const int longest = (cloth.lattice.columns + colors - 1) / colors;
    part_ = lanes + (longest + lanes) / lanes * lanes;
    columns_ = cloth.lattice.columns;
    const std::size_t rows = std::size_t(cloth.lattice.rows) + 2 * ghost_rows, row = std::size_t(component());
    for (Array<R>* field : {&c_, &q_, &y_}) field->assign(3 * rows * row + lanes, R(0));
    whole_.assign(directions.size() * rows * row + lanes, R(0));
    free_.assign(rows * row + lanes, R(0));
    piece_of_.assign(std::size_t(cloth.lattice.rows) * std::size_t(columns_), of_none);
    rows_ = cloth.lattice.rows;  // now that all of the memory is there
  }
  if (!changed && pieces_known_ && springs_ == cloth.springs.version()) return;
  pieces_known_ = false;
  make_masks(cloth, tears), find_pieces(cloth, tears);
  pieces_known_ = true, springs_ = cloth.springs.version();
}

template <class R>
void BlockDescent<R>::make_masks(const Cloth<R>& cloth, const Tears& tears) {
  linear_.assign(cloth.springs.empty() ? 0 : whole_.size(), R(0));
  for (int i = 0; i < rows_; ++i)
    for (int j = 0; j < columns_; ++j) {
      const bool fixed = !cloth.fixed.empty() && cloth.fixed[std::size_t(i) * columns_ + j] != 0;
      free_[std::size_t(i * component() + place(j))] = fixed ? R(0) : R(1);
      for (int d = 0; d < int(directions.size()); ++d) {
        const bool whole = cloth.lattice.has_spring(d, i, j) && tears.whole(d, i, j);
        whole_[mask_at(i, d, j)] = R(whole ? 1 : 0);
        if (!linear_.empty() && whole) linear_[mask_at(i, d, j)] = cloth.springs.at(d, i, j);
      }
    }
}

template <class R>
void BlockDescent<R>::begin(const Field& c_x, const Field& c_v, int begin, int end) {
  assert(pieces_known_ && begin >= 0 && begin <= end && end <= rows_);
  for (int i = begin; i < end; ++i)
    for (int c = 0; c < 3; ++c)
      for (int j = 0; j < columns_; ++j) {
        const bool falls = c == 1 && free_[std::size_t(i * component() + place(j))] != 0;
        const R way = R(h_) * c_v.row(i, c)[j];
        c_[at(i, c, j)] = c_x.row(i, c)[j], q_[at(i, c, j)] = way;
        y_[at(i, c, j)] = way - (falls ? R(h_ * h_ * gravity_) : R(0));
      }
}

template <class R>
void BlockDescent<R>::find_pieces(const Cloth<R>& cloth, const Tears& tears) {
  const int particles = rows_ * columns_;
  for (int p = 0; p < particles; ++p)
    piece_of_[std::size_t(p)] = !cloth.fixed.empty() && cloth.fixed[std::size_t(p)] != 0 ? of_fixed : of_none;
  pieces_.clear(), held_.clear();
  for (int first = 0; first < particles; ++first) {
    if (piece_of_[std::size_t(first)] != of_none) continue;
    const int piece = int(pieces_.size());
    pieces_.push_back({.held_begin = held_.size()});
    found_.assign(1, first), piece_of_[std::size_t(first)] = piece;
    // found_ grows as its particles' neighbors are found.
    for (std::size_t n = 0; n < found_.size(); ++n) {
      const int i = found_[n] / columns_, j = found_[n] % columns_;
      const auto look = [&](int d, int owner_i, int owner_j, int to_i, int to_j) {
        if (!cloth.lattice.has_spring(d, owner_i, owner_j) || !tears.whole(d, owner_i, owner_j)) return;
        int& of = piece_of_[std::size_t(to_i) * std::size_t(columns_) + std::size_t(to_j)];
        if (of == of_fixed)
          held_.push_back({at(to_i, 0, to_j), at(i, 0, j), kind_of(directions[std::size_t(d)]),
                           double(cloth.springs.at(d, owner_i, owner_j))});
        if (of == of_none) of = piece, found_.push_back(to_i * columns_ + to_j);
      };
      for (int d = 0; d < int(directions.size()); ++d) {
        const Direction& to = directions[std::size_t(d)];
        look(d, i, j, i + to.di, j + to.dj);
        look(d, i - to.di, j - to.dj, i - to.di, j - to.dj);
      }
    }
    pieces_.back().particles = double(found_.size()), pieces_.back().held_end = held_.size();
  }
  assert(std::find(piece_of_.begin(), piece_of_.end(), of_none) == piece_of_.end());
}

template <class R>
double BlockDescent<R>::pull_down(const Held& spring, double fallen) const {
  double moved[3], d[3], square = 0;
  for (int c = 0; c < 3; ++c) {
    const std::size_t off = std::size_t(c * component());
    moved[c] = double(q_[spring.fixed + off]) - double(q_[spring.free + off]) + (c == 1 ? fallen : 0);
    d[c] = double(c_[spring.fixed + off]) - double(c_[spring.free + off]) + moved[c];
    square += d[c] * d[c];
  }
  const double length = std::sqrt(square), L = constants_.L, linear = constants_.linear * spring.linear * d[1];
  if (spring.kind == of_bending)
    return length > 0 && length < 2 * L ? constants_.bend * (2 * L / length - 1) * d[1] - linear : -linear;
  const double rest = spring.kind == of_shear ? std::numbers::sqrt2 * L : L;
  const double k = spring.kind == of_shear  ? constants_.shear
                   : spring.kind == of_warp ? constants_.warp
                                            : constants_.weft;
  const double pull = length > rest ? k * (1 - rest / length) * d[1] : 0;
  return -pull - linear - constants_.damping * moved[1];
}

template <class R>
double BlockDescent<R>::slope(const Piece& piece, double share) const {
  assert(piece.particles >= 1 && gravity_ != 0 && share >= 0 && share <= 1);
  const double way = h_ * h_ * gravity_;
  double held = 0;
  for (std::size_t n = piece.held_begin; n < piece.held_end; ++n) held += pull_down(held_[n], share * way);
  return piece.particles * (share - 1) - held / way;
}

template <class R>
void BlockDescent<R>::weigh() {
  for (Piece& piece : pieces_) {
    piece.falls = 0;
    if (gravity_ == 0 || slope(piece, 0) >= 0) continue;
    piece.falls = 1;
    if (slope(piece, 1) <= 0) continue;
    double low = 0, high = 1;
    for (int n = 0; n < 10; ++n) {
      const double middle = (low + high) / 2;
      (slope(piece, middle) < 0 ? low : high) = middle;
    }
    piece.falls = low;
  }
}

template <class R>
void BlockDescent<R>::fall(int begin, int end) {
  for (int i = begin; i < end; ++i)
    for (int j = 0; j < columns_; ++j)
      if (const int piece = piece_of_[std::size_t(i) * std::size_t(columns_) + std::size_t(j)]; piece != of_fixed) {
        assert(piece >= 0 && std::size_t(piece) < pieces_.size());
        q_[at(i, 1, j)] -= R(pieces_[std::size_t(piece)].falls * h_ * h_ * gravity_);
      }
}

template <class R>
std::size_t BlockDescent<R>::bytes() const {
  return (c_.size() + q_.size() + y_.size() + whole_.size() + linear_.size() + free_.size()) * sizeof(R) +
         (piece_of_.capacity() + found_.capacity()) * sizeof(int) + pieces_.capacity() * sizeof(Piece) +
         held_.capacity() * sizeof(Held);
}

template <class R>
void BlockDescent<R>::accelerate(const Field& c_v, const Field& a, int begin, int end) {
  for (int i = begin; i < end; ++i)
    for (int c = 0; c < 3; ++c)
      for (int j = 0; j < columns_; ++j) y_[at(i, c, j)] = R(h_) * c_v.row(i, c)[j] + R(h_ * h_) * a.row(i, c)[j];
}

/// The particles of a row whose columns leave that remainder.
template <class R>
void BlockDescent<R>::descend(int i, int part) {
  assert(i >= 0 && i < rows_ && part >= 0 && part < colors);
  BlockRow<R> row;
  row.count = (columns_ - part + colors - 1) / colors;
  if (row.count <= 0) return;
  row.stride = component(), row.constants = constants_;
  row.c = c_.data() + at(i, 0, part), row.q = q_.data() + at(i, 0, part), row.y = y_.data() + at(i, 0, part);
  row.free = free_.data() + i * component() + place(part);
  const std::ptrdiff_t here = std::ptrdiff_t(at(i, 0, part));
  for (int d = 0; d < int(directions.size()); ++d) {
    const Direction& to = directions[std::size_t(d)];
    const int kind = kind_of(to);
    const std::size_t own = mask_at(i, d, part), others = mask_at(i - to.di, d, part - to.dj);
    const auto linear = [&](std::size_t mask) { return linear_.empty() ? nullptr : linear_.data() + mask; };
    row.links[std::size_t(2 * d)] = {std::ptrdiff_t(at(i + to.di, 0, part + to.dj)) - here, whole_.data() + own, kind,
                                     linear(own)};
    row.links[std::size_t(2 * d + 1)] = {std::ptrdiff_t(at(i - to.di, 0, part - to.dj)) - here, whole_.data() + others,
                                         kind, linear(others)};
  }
  descend_row(row);
}

template <class R>
void BlockDescent<R>::pass(int begin, int end, Team& team) {
  for (int color = 0; color < colors; ++color) {
    // i + 2j ≡ color (mod 5) is j ≡ 3 (color - i).
    for (int i = begin; i < end; ++i) descend(i, 3 * (color + (colors - 1) * i) % colors);
    team.barrier();
  }
}

template <class R>
void BlockDescent<R>::write_positions(Field& x, int begin, int end) const {
  for (int i = begin; i < end; ++i)
    for (int c = 0; c < 3; ++c)
      for (int j = 0; j < columns_; ++j) x.row(i, c)[j] = c_[at(i, c, j)] + q_[at(i, c, j)];
}

template <class R>
void BlockDescent<R>::write_velocities(Field& v, int begin, int end) const {
  assert(h_ > 0);
  const R per_h = R(1 / h_);
  for (int i = begin; i < end; ++i)
    for (int c = 0; c < 3; ++c)
      for (int j = 0; j < columns_; ++j)
        if (free_[std::size_t(i * component() + place(j))] != 0) v.row(i, c)[j] = per_h * q_[at(i, c, j)];
}

template class BlockDescent<float>;
template class BlockDescent<double>;

}  // namespace tyglab::cpu
