#include "core/engines/still_engine.h"

#include <algorithm>
#include <cassert>

#include "core/integrators/scheme.h"

namespace tyglab {

StillEngine::StillEngine(Engine& of, const Preset& preset, const Lattice& lattice, const Tears& tears)
    : lattice_(lattice),
      lag_(scheme(preset.integrator).keeps_displacement ? of.stored(0, 0).lag : 0),
      stride_(simd::row_stride<double>(lattice.columns)),
      bytes_(of.bytes()),
      threads_(of.threads()),
      threads_at_work_(of.threads_at_work()),
      solves_(of.solves()),
      inner_steps_(of.inner_steps()),
      features_(of.features()),
      name_(of.name()) {
  of.read(state_, tears);
  of.read_raw(raw_, tears);
  assert(state_.x.x.size() == std::size_t(lattice.size()) && raw_.v.z.size() == std::size_t(lattice.size()));
  x_.resize(lattice.rows, stride_);
  const Array<double>* from[] = {&state_.x.x, &state_.x.y, &state_.x.z};
  for (int i = 0; i < lattice.rows; ++i)
    for (int c = 0; c < 3; ++c)
      std::copy_n(from[c]->data() + std::size_t(i) * lattice.columns, lattice.columns, x_.row(i, c));
}

AdvanceResult StillEngine::advance(int, Tears&) {
  AdvanceResult none;
  none.stopped = true;
  return none;
}

PositionView StillEngine::positions() const {
  PositionView view{lattice_.rows, lattice_.columns, 3 * stride_};
  for (int c = 0; c < 3; ++c) view.d[c] = x_.row(0, c);
  return view;
}

StoredParticle StillEngine::stored(int i, int j) const {
  assert(lattice_.contains(i, j));
  const std::size_t p = std::size_t(i) * lattice_.columns + j;
  const VectorField<double>& from = lag_ == 0 ? state_.v : raw_.v;
  const glm::dvec3 v(from.x[p], from.y[p], from.z[p]);
  return {{state_.x.x[p], state_.x.y[p], state_.x.z[p]}, v, v, lag_};
}

}  // namespace tyglab
