#include "core/forces/linear_springs.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tyglab {
namespace {

constexpr int reach = 2;  // rows from a stencil's owner to its lowest point

/// The direction of the lattice from one point to another, or -1.
int direction_between(const Stencil::Point& from, const Stencil::Point& to) {
  const auto found = std::find_if(directions.begin(), directions.end(), [&](const Direction& d) {
    return d.di == to.di - from.di && d.dj == to.dj - from.dj;
  });
  return found == directions.end() ? -1 : int(found - directions.begin());
}

bool same_row(const Tears& a, const Tears& b, int i) {
  const auto mask = [](const std::uint8_t* row, int j) { return row == nullptr ? std::uint8_t(all_springs) : row[j]; };
  for (int j = 0; j < a.lattice().columns; ++j)
    if (mask(a.row(i), j) != mask(b.row(i), j)) return false;
  return true;
}

/// A spring to the lower left is stored at the column of its lower end.
int column_of(int direction, int j) {
  return j + std::min(0, directions[std::size_t(direction)].dj);
}

}  // namespace

template <class R>
bool LinearSprings<R>::exist(const Preset& preset) {
  return std::any_of(force::all.begin(), force::all.end(),
                     [&](const Force* force) { return force->linear != nullptr && force->on(preset); });
}

template <class R>
auto LinearSprings<R>::shares_of(const Preset& preset, double scale) -> std::vector<Share> {
  std::vector<Share> shares;
  for_each_stencil(preset, [&](const Force& force, const Stencil& stencil) {
    if (force.linear == nullptr) return;
    const double kappa = scale * force.linear(preset, stencil);
    [[maybe_unused]] double weights = 0;
    for (int k = 0; k < stencil.points; ++k) {
      const Stencil::Point& one = stencil.at[std::size_t(k)];
      weights += one.weight;
      for (int l = k + 1; l < stencil.points; ++l) {
        const Stencil::Point& other = stencil.at[std::size_t(l)];
        const double constant = -kappa * one.weight * other.weight;
        const int there = direction_between(one, other), back = direction_between(other, one);
        assert((there >= 0) != (back >= 0));  // or no spring of the lattice joins them
        const Stencil::Point& owner = there >= 0 ? one : other;
        shares.push_back({&stencil, std::max(there, back), owner.di, owner.dj, constant});
      }
    }
    assert(std::abs(weights) < 1e-12);  // or a displacement of the whole would meet a force
  });
  return shares;
}

/// Whether all springs that share in row i's constants are there.
template <class R>
bool LinearSprings<R>::is_regular(const Tears& tears, int i) const {
  const Lattice& lattice = tears.lattice();
  if (i < reach || i + reach + 1 >= lattice.rows) return false;
  if (tears.untorn()) return true;
  const std::uint8_t* first = tears.row(i - reach);
  return std::all_of(first, first + (2 * reach + 1) * lattice.columns,
                     [](std::uint8_t mask) { return mask == all_springs; });
}

template <class R>
void LinearSprings<R>::compute(const Tears& tears, int i, R* to) const {
  std::fill_n(to, pitch(), R(0));
  const Lattice& lattice = tears.lattice();
  for (const Share& share : shares_)
    for (int j = 0; j < lattice.columns; ++j)
      if (share.stencil->acts(tears, i - share.di, j))
        to[share.direction * std::ptrdiff_t(stride_) + column_of(share.direction, j + share.dj)] += R(share.constant);
}

template <class R>
void LinearSprings<R>::follow(const Preset& preset, const Tears& tears, int stride, double scale) {
  if (!exist(preset)) {
    if (!empty()) ++version_;
    block_of_.clear(), data_.clear(), shares_.clear();
    return;
  }
  std::vector<Share> shares = shares_of(preset, scale);
  const Lattice& lattice = tears.lattice();
  const bool all = empty() || shares != shares_ || stride != stride_ || known_.lattice() != lattice ||
                   (tears.untorn() && !known_.untorn());
  if (all) {
    block_of_.clear(), data_.assign(std::size_t(directions.size()) * std::size_t(stride), R(0));
    stride_ = stride, shares_ = std::move(shares), blocks_ = 1;
    compute(Tears(Lattice{2 * reach + 2, lattice.columns}), reach, data_.data());
  } else if (tears == known_) {
    return;
  }
  std::vector<int> block_of = block_of_;
  block_of.resize(std::size_t(lattice.rows), 0);
  for (int i = 0; i < lattice.rows; ++i) {
    int& block = block_of[std::size_t(i)];
    bool changed = all;
    for (int row = std::max(0, i - reach); row <= std::min(lattice.rows - 1, i + reach) && !changed; ++row)
      changed = !same_row(tears, known_, row);
    if (!changed || (block == 0 && is_regular(tears, i))) continue;
    if (block == 0) {
      data_.resize(std::size_t((blocks_ + 1) * pitch()), R(0));
      block = blocks_++;
    }
    compute(tears, i, data_.data() + block * pitch());
  }
  known_ = tears, ++version_;
  block_of_ = std::move(block_of);
}

template <class R>
const R* LinearSprings<R>::row(int i) const {
  if (empty()) return nullptr;
  assert(i >= 0 && std::size_t(i) < block_of_.size());
  return data_.data() + block_of_[std::size_t(i)] * pitch();
}

template <class R>
R LinearSprings<R>::at(int direction, int i, int j) const {
  return empty() ? R(0) : row(i)[direction * std::ptrdiff_t(stride_) + column_of(direction, j)];
}

template class LinearSprings<float>;
template class LinearSprings<double>;

}  // namespace tyglab
