#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/engines/cpu/pair_sweep_float.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/engines/cpu/pair_sweep-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tyglab::cpu::HWY_NAMESPACE {

PairSweeps<float> table_float() {
  return table<float>();
}

}  // namespace tyglab::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tyglab::cpu {

HWY_EXPORT(table_float);

template <>
PairSweeps<float> pair_sweeps<float>() {
  return HWY_DYNAMIC_DISPATCH(table_float)();
}

}  // namespace tyglab::cpu
#endif
