#include "core/engines/cpu/block_descent.h"

#include <algorithm>

namespace tyglab::cpu {

template <class R>
void BlockDescent<R>::prepare(const Cloth<R>& cloth, const Tears& tears, double h, bool changed) {
  const Preset& p = cloth.preset;
  constants_ = {h * h * p.k_s / p.m, h * h * p.k_b / p.m, h * p.k_d / p.m, p.L};
  h_ = h, gravity_ = p.g;
  if (rows_ == 0) {
    const int longest = (cloth.lattice.columns + colors - 1) / colors;
    part_ = lanes + (longest + lanes) / lanes * lanes;
    columns_ = cloth.lattice.columns;
    const std::size_t rows = std::size_t(cloth.lattice.rows) + 2 * ghost_rows, row = std::size_t(component());
    for (Array<R>* field : {&c_, &q_, &y_}) field->assign(3 * rows * row + lanes, R(0));
    whole_.assign(directions.size() * rows * row + lanes, R(0));
    free_.assign(rows * row + lanes, R(0));
    rows_ = cloth.lattice.rows;  // now that all of the memory is there
    changed = true;
  }
  if (changed) make_masks(cloth, tears);
}

template <class R>
void BlockDescent<R>::make_masks(const Cloth<R>& cloth, const Tears& tears) {
  for (int i = 0; i < rows_; ++i)
    for (int j = 0; j < columns_; ++j) {
      const bool fixed = !cloth.fixed.empty() && cloth.fixed[std::size_t(i) * columns_ + j] != 0;
      free_[std::size_t(i * component() + place(j))] = fixed ? R(0) : R(1);
      for (int d = 0; d < int(directions.size()); ++d)
        whole_[mask_at(i, d, j)] = R(cloth.lattice.has_spring(d, i, j) && tears.whole(d, i, j) ? 1 : 0);
    }
}

template <class R>
void BlockDescent<R>::begin(const Field& c_x, const Field& c_v, int begin, int end) {
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
void BlockDescent<R>::accelerate(const Field& c_v, const Field& a, int begin, int end) {
  for (int i = begin; i < end; ++i)
    for (int c = 0; c < 3; ++c)
      for (int j = 0; j < columns_; ++j) y_[at(i, c, j)] = R(h_) * c_v.row(i, c)[j] + R(h_ * h_) * a.row(i, c)[j];
}

/// The particles of a row whose columns leave that remainder.
template <class R>
void BlockDescent<R>::descend(int i, int part) {
  BlockRow<R> row;
  row.count = (columns_ - part + colors - 1) / colors;
  if (row.count <= 0) return;
  row.stride = component(), row.constants = constants_;
  row.c = c_.data() + at(i, 0, part), row.q = q_.data() + at(i, 0, part), row.y = y_.data() + at(i, 0, part);
  row.free = free_.data() + i * component() + place(part);
  const std::ptrdiff_t here = std::ptrdiff_t(at(i, 0, part));
  for (int d = 0; d < int(directions.size()); ++d) {
    const Direction& to = directions[std::size_t(d)];
    const int rest = to.bending ? 2 : to.di != 0 && to.dj != 0 ? 1 : 0;
    row.links[std::size_t(2 * d)] = {std::ptrdiff_t(at(i + to.di, 0, part + to.dj)) - here,
                                     whole_.data() + mask_at(i, d, part), rest};
    row.links[std::size_t(2 * d + 1)] = {std::ptrdiff_t(at(i - to.di, 0, part - to.dj)) - here,
                                         whole_.data() + mask_at(i - to.di, d, part - to.dj), rest};
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
  const R per_h = R(1 / h_);
  for (int i = begin; i < end; ++i)
    for (int c = 0; c < 3; ++c)
      for (int j = 0; j < columns_; ++j)
        if (free_[std::size_t(i * component() + place(j))] != 0) v.row(i, c)[j] = per_h * q_[at(i, c, j)];
}

template class BlockDescent<float>;
template class BlockDescent<double>;

}  // namespace tyglab::cpu
