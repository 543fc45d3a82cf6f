#include "core/cloth/state.h"

#include <algorithm>
#include <cassert>

namespace tyglab {

StateRows rows_of(const State& state, int columns) {
  assert(columns > 0 && state.x.x.size() % std::size_t(columns) == 0);
  assert(state.x.y.size() == state.x.x.size() && state.x.z.size() == state.x.x.size());
  assert(state.v.x.size() == state.x.x.size() && state.v.y.size() == state.x.x.size() &&
         state.v.z.size() == state.x.x.size());
  return [&state, columns](int i, const StateRow& row) {
    const auto copy = [&](const VectorField<double>& from, double* const* to) {
      const Array<double>* components[] = {&from.x, &from.y, &from.z};
      for (int c = 0; c < 3; ++c) std::copy_n(components[c]->data() + std::size_t(i) * columns, columns, to[c]);
    };
    copy(state.x, row.x), copy(state.v, row.v);
  };
}

}  // namespace tyglab
