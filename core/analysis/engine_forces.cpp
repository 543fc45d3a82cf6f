#include "core/analysis/engine_forces.h"

#include <algorithm>

#include "core/cloth/state.h"

namespace tyglab {

template <class R>
EngineForces<R>::EngineForces(const Preset& preset) : tears_(lattice_of(preset)) {
  cloth_.preset = preset;
  cloth_.lattice = lattice_of(preset);
  cloth_.dt = preset.dt;
  cloth_.stride = simd::row_stride<R>(cloth_.lattice.columns);
  cloth_.sweeps = cpu::pair_sweeps<R>();
  cloth_.features = cpu::features_of(preset);
  cloth_.vectors.resize(2);
  int lead = 0;  // apart in their pages, as in the engine
  for (auto* field : {&cloth_.vector(vector_x), &cloth_.vector(vector_v), &out_}) {
    field->resize(cloth_.lattice.rows + 3, cloth_.stride, lead);
    lead += 23;
  }
  cloth_.fixed = pinned_particles(preset);
  cloth_.fixed.resize(cloth_.fixed.size() + simd::widest_vector, 0);
  cloth_.fixed_begin = {0};
  for (int i = 0; i < cloth_.lattice.rows; ++i) {
    for (int j = 0; j < cloth_.lattice.columns; ++j)
      if (cloth_.fixed[std::size_t(i) * cloth_.lattice.columns + j] != 0) cloth_.fixed_columns.push_back(j);
    cloth_.fixed_begin.push_back(int(cloth_.fixed_columns.size()));
  }
  half_ = std::size_t(cloth_.lattice.rows) * out_.pitch();
  look_.position = vector_x, look_.velocity = vector_v, look_.k_d = preset.k_d;
  band_ = std::make_unique<cpu::Band<R>>(cloth_, 0, cloth_.lattice.rows);
}

template <class R>
typename EngineForces<R>::Vector EngineForces<R>::start() const {
  const State state = start_state(cloth_.preset);
  Vector all(2 * half_, R(0));
  const Array<double>* components[] = {&state.x.x, &state.x.y, &state.x.z, &state.v.x, &state.v.y, &state.v.z};
  const Lattice lattice = cloth_.lattice;
  for (int n = 0; n < 6; ++n)
    for (int i = 0; i < lattice.rows; ++i)
      for (int j = 0; j < lattice.columns; ++j)
        all[(n / 3) * half_ + (std::size_t(i) * 3 + n % 3) * cloth_.stride + j] =
            R((*components[n])[std::size_t(i) * lattice.columns + j]);
  return all;
}

template <class R>
void EngineForces<R>::accelerations(const R* x, const R* v, R* a) {
  ++evaluations_;
  std::copy_n(x, half_, cloth_.vector(vector_x).row(0));
  std::copy_n(v, half_, cloth_.vector(vector_v).row(0));
  band_->accelerations(look_, tears_, out_);
  std::copy_n(out_.row(0), half_, a);
}

template <class R>
void EngineForces<R>::derivative(const Vector& state, Vector& change) {
  std::copy_n(state.data() + half_, half_, change.data());
  accelerations(state.data(), state.data() + half_, change.data() + half_);
}

template <class R>
glm::dvec3 EngineForces<R>::position(const Vector& state, int particle) const {
  const int i = particle / cloth_.lattice.columns, j = particle % cloth_.lattice.columns;
  const R* row = state.data() + std::size_t(i) * 3 * cloth_.stride + j;
  return {row[0], row[cloth_.stride], row[2 * cloth_.stride]};
}

template class EngineForces<float>;
template class EngineForces<double>;

}  // namespace tyglab
