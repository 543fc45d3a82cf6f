#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/energy/spring_sums.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/energy/spring_sums.h"

HWY_BEFORE_NAMESPACE();
namespace tyglab::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

SpringSums sums(const SpringRow& row) {
  constexpr hn::ScalableTag<double> d;
  const int lanes = int(hn::Lanes(d));
  const auto rest = hn::Set(d, row.rest), zero = hn::Zero(d);
  auto longer = zero, shorter = zero, speed = zero;
  for (int j = row.begin; j < row.end; j += lanes) {
    const auto inside = hn::FirstN(d, std::size_t(row.end - j));
    auto way = zero, change = zero;
    for (int c = 0; c < 3; ++c) {
      const auto dx =
          hn::Sub(hn::MaskedLoad(inside, d, row.x[c] + j + row.other), hn::MaskedLoad(inside, d, row.x[c] + j));
      const auto dv =
          hn::Sub(hn::MaskedLoad(inside, d, row.v[c] + j + row.other), hn::MaskedLoad(inside, d, row.v[c] + j));
      way = hn::MulAdd(dx, dx, way);
      change = hn::MulAdd(dv, dv, change);
    }
    const auto over = hn::IfThenElseZero(inside, hn::Sub(hn::Sqrt(way), rest));
    const auto pulled = hn::Max(over, zero), pushed = hn::Min(over, zero);
    longer = hn::MulAdd(pulled, pulled, longer);
    shorter = hn::MulAdd(pushed, pushed, shorter);
    speed = hn::Add(speed, change);
  }
  const auto sum = [&](auto v) { return hn::GetLane(hn::SumOfLanes(d, v)); };
  return {sum(longer), sum(shorter), sum(speed)};
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
