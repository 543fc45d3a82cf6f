#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/engines/cpu/pair_sweep_double.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/engines/cpu/pair_sweep-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tyglab::cpu::HWY_NAMESPACE {

PairSweeps<double> table_double() {
  return table<double>();
}

}  // namespace tyglab::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tyglab::cpu {

HWY_EXPORT(table_double);

template <>
PairSweeps<double> pair_sweeps<double>() {
  return HWY_DYNAMIC_DISPATCH(table_double)();
}

}  // namespace tyglab::cpu
#endif
