// The state of the particles as a structure of arrays.
#pragma once

#include <cstddef>
#include <functional>
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

/// Three components of one quantity over all particles.
template <class T>
struct VectorField {
  Array<T> x, y, z;
  void resize(std::size_t n) { x.assign(n, T(0)), y.assign(n, T(0)), z.assign(n, T(0)); }
  std::size_t bytes() const { return 3 * x.size() * sizeof(T); }
};

/// Positions (m) and velocities (m/s) in double, dense (index i·columns + j): for files, readouts, changes of engine.
struct State {
  VectorField<double> x, v;
};

/// One row of a state: three components of x (m) and of v (m/s), each a value a column.
struct StateRow {
  double* x[3];
  double* v[3];
};
/// Writes row i. So a large state can be handed over without standing in memory as a whole; called for different rows
/// at the same time.
using StateRows = std::function<void(int i, const StateRow& row)>;
/// The rows of a state; it must outlive them.
StateRows rows_of(const State& state, int columns);

}  // namespace tyglab
