#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/energy/spring_sums.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/energy/energy.h"

HWY_BEFORE_NAMESPACE();
namespace tyglab::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Adds the springs of particles j … j + lanes - 1.
template <class D>
struct Sums {
  using V = hn::Vec<D>;
  V longer, shorter, speed;

  HWY_INLINE Sums() : longer(hn::Zero(D())), shorter(hn::Zero(D())), speed(hn::Zero(D())) {}

  HWY_INLINE void add(const SpringRow& row, int j) {
    V way = hn::Zero(D()), change = hn::Zero(D());
    for (int c = 0; c < 3; ++c) {
      const V dx = hn::Sub(hn::LoadU(D(), row.x[c] + j + row.other), hn::LoadU(D(), row.x[c] + j));
      const V dv = hn::Sub(hn::LoadU(D(), row.v[c] + j + row.other), hn::LoadU(D(), row.v[c] + j));
      way = hn::MulAdd(dx, dx, way);
      change = hn::MulAdd(dv, dv, change);
    }
    const V over = hn::Sub(hn::Sqrt(way), hn::Set(D(), row.rest));
    const V pulled = hn::Max(over, hn::Zero(D())), pushed = hn::Min(over, hn::Zero(D()));
    longer = hn::MulAdd(pulled, pulled, longer);
    shorter = hn::MulAdd(pushed, pushed, shorter);
    speed = hn::Add(speed, change);
  }
  HWY_INLINE void add_to(SpringSums& all) const {
    all.longer += hn::GetLane(hn::SumOfLanes(D(), longer));
    all.shorter += hn::GetLane(hn::SumOfLanes(D(), shorter));
    all.speed += hn::GetLane(hn::SumOfLanes(D(), speed));
  }
};

SpringSums sums(const SpringRow& row) {
  using Wide = hn::ScalableTag<double>;
  using One = hn::CappedTag<double, 1>;
  const int lanes = int(hn::Lanes(Wide()));
  SpringSums all;
  Sums<Wide> wide;
  Sums<One> one;
  int j = row.begin;
  for (; j + lanes <= row.end; j += lanes) wide.add(row, j);
  for (; j < row.end; ++j) one.add(row, j);  // nothing behind the row may be read
  wide.add_to(all), one.add_to(all);
  return all;
}

}  // namespace tyglab::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tyglab {

HWY_EXPORT(sums);

SpringSums spring_sums(const SpringRow& row) {
  return HWY_DYNAMIC_DISPATCH(sums)(row);
}

}  // namespace tyglab
#endif
