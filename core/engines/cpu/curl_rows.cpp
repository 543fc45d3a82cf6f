#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/engines/cpu/curl_rows.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <cassert>
#include <cstddef>

#include "core/engines/cpu/curl_rows.h"
#include "core/simd/simd-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tyglab::cpu::HWY_NAMESPACE {
using namespace tyglab::simd::HWY_NAMESPACE;

template <class D, class R = hn::TFromD<D>>
HWY_INLINE void add_block(const TetrahedraRow<R>& row, int j) {
  using L = Lanes<D>;
  using V = Vec3<D>;
  const auto at = [&](const typename TetrahedraRow<R>::Point& point)
                      HWY_ATTR { return V::load(point.x + j, row.stride); };
  const auto subtract = [&](const typename TetrahedraRow<R>::Point& point, V force) HWY_ATTR {
    R* f = point.f + j;
    for (const L part : {force.x, force.y, force.z}) {
      hn::StoreU((L::load(f) - part).v, D(), f);
      f += row.stride;
    }
  };
  const V x = at(row.at), a = at(row.ahead) - x, b = at(row.behind) - x;
  const V t = L::load(row.weights + j) * (at(row.beside) - x);
  const V on_ahead = cross(t, b), on_behind = cross(a, t), on_beside = L::load(row.weights + j) * cross(b, a);
  subtract(row.ahead, on_ahead), subtract(row.behind, on_behind), subtract(row.beside, on_beside);
  subtract(row.at, V() - (on_ahead + on_behind + on_beside));
}

template <class R>
void add_row(const TetrahedraRow<R>& row) {
  using D = hn::ScalableTag<R>;
  constexpr int lanes = int(hn::MaxLanes(D()));
  int j = row.begin;
  for (; j + lanes <= row.end; j += lanes) add_block<D>(row, j);
  for (; j < row.end; ++j) add_block<hn::CappedTag<R, 1>>(row, j);
}

void add_floats(const TetrahedraRow<float>& row) {
  add_row(row);
}
void add_doubles(const TetrahedraRow<double>& row) {
  add_row(row);
}

}  // namespace tyglab::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tyglab::cpu {

HWY_EXPORT(add_floats);
HWY_EXPORT(add_doubles);

template <>
void add_tetrahedra(const TetrahedraRow<float>& row) {
  HWY_DYNAMIC_DISPATCH(add_floats)(row);
}
template <>
void add_tetrahedra(const TetrahedraRow<double>& row) {
  HWY_DYNAMIC_DISPATCH(add_doubles)(row);
}

}  // namespace tyglab::cpu
#endif
