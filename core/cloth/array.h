// Arrays for SIMD. A header of its own: the sweeps, which take minutes to compile, need no other part of the state.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace tyglab {

/// Allocator for cache-line (and SIMD) aligned arrays.
template <class T>
struct AlignedAllocator {
  using value_type = T;
  static constexpr std::align_val_t alignment{64};
  AlignedAllocator() = default;
  template <class U>
  AlignedAllocator(const AlignedAllocator<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), alignment)); }
  void deallocate(T* p, std::size_t) { ::operator delete(p, alignment); }
  bool operator==(const AlignedAllocator&) const { return true; }
};

template <class T>
using Array = std::vector<T, AlignedAllocator<T>>;

}  // namespace tyglab
