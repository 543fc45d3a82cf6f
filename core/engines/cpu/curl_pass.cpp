#include <algorithm>
#include <cassert>
#include <cstddef>

#include "core/engines/cpu/curl_rows.h"
#include "core/forces/force.h"

namespace tyglab::cpu {

template <class R>
void CurlPass<R>::allocate(const Preset& p) {
  if (force::curl.on(p)) weights_.resize(std::size_t(p.columns));
}

template <class R>
void CurlPass<R>::begin(const Preset& p, bool acts) {
  warp_ = weft_ = 0;
  if (!acts || !force::curl.on(p)) return;
  assert(weights_.size() == std::size_t(p.columns));
  warp_ = p.B * p.kappa_warp / (2 * p.L * p.L), weft_ = p.B * p.kappa_weft / (2 * p.L * p.L);
}

template <class R>
void CurlPass<R>::add(const Tears& tears, int i, const R* x, std::ptrdiff_t stride, R* const (&f)[4]) {
  constexpr Half down_right{1, 0, 1}, down_left{1, 0, -1}, right_down{0, 1, 1}, right_up{0, 1, -1};
  for (int top = i; top < std::min(i + 2, tears.lattice().rows); ++top) {
    if (warp_ != 0)
      add_half(tears, down_right, i, top + 1, x, stride, f), add_half(tears, down_left, i, top + 1, x, stride, f);
    if (weft_ != 0)
      add_half(tears, right_down, i, top, x, stride, f), add_half(tears, right_up, i, top + 1, x, stride, f);
  }
}

template <class R>
void CurlPass<R>::add_half(const Tears& tears, const Half& half, int i, int center, const R* x, std::ptrdiff_t stride,
                           R* const (&f)[4]) {
  const auto [di, dj, side] = half;
  const int beside_di = dj * side, beside_dj = di * side, rows = tears.lattice().rows;
  if (center + di >= rows || center + beside_di >= rows) return;
  weigh(tears, half, center);
  const auto point = [&](int row, int column) -> typename TetrahedraRow<R>::Point {
    assert(row >= i && row < i + 4);
    return {x + 3 * (row - i) * stride + column, f[row - i] + column};
  };
  const int columns = tears.lattice().columns;
  add_tetrahedra(TetrahedraRow<R>{point(center, 0), point(center + di, dj), point(center - di, -dj),
                                  point(center + beside_di, beside_dj), stride, weights_.data(),
                                  std::max(dj, -beside_dj), columns - std::max(dj, beside_dj)});
}

/// As the stencils of curl.cpp have it.
template <class R>
void CurlPass<R>::weigh(const Tears& tears, const Half& half, int i) {
  const auto [di, dj, side] = half;
  const double whole = 2 * side * (di != 0 ? warp_ : -weft_);
  const int along = di != 0 ? 1 : 0, across = 1 - along;
  const Lattice& lattice = tears.lattice();
  if (tears.untorn()) {
    const bool between = di != 0 || (i > 0 && i + 1 < lattice.rows);
    std::fill(weights_.begin(), weights_.end(), R(between ? whole / 2 : whole));
    if (di != 0) weights_.front() = weights_.back() = R(whole);
    return;
  }
  const auto joined = [&](int direction, int pi, int pj) {
    return lattice.has_spring(direction, pi, pj) && tears.whole(direction, pi, pj);
  };
  for (int j = 0; j < lattice.columns; ++j) {
    const bool acts = joined(along, i, j) && joined(along, i - di, j - dj);
    const bool ahead = joined(across, i, j), behind = joined(across, i - dj, j - di);
    const bool beside = side > 0 ? ahead : behind;
    weights_[std::size_t(j)] = R(acts && beside ? (ahead && behind ? whole / 2 : whole) : 0);
  }
}

template class CurlPass<float>;
template class CurlPass<double>;

}  // namespace tyglab::cpu
