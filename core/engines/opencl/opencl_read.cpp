// Everything that the host reads from an OpenCL engine.
#include "core/engines/opencl/opencl_engine.h"
#include "core/forces/force.h"

namespace tyglab::opencl {

template <class R>
void OpenClEngine<R>::read_stored(State& state) const {
  const std::size_t n = std::size_t(lattice_.size());
  if (state.v.z.size() != n) state.x.resize(n), state.v.resize(n);  // the last array that gets its memory
  const auto copy = [&](int vector, VectorField<double>& to, double divisor) {
    const R* from = state_.host(vector);
    Array<double>* components[] = {&to.x, &to.y, &to.z};
    for (int i = 0; i < lattice_.rows; ++i)
      for (int c = 0; c < 3; ++c) {
        const R* row = StateView<R>::row(from, state_.stride(), i, c);
        double* out = components[c]->data() + std::size_t(i) * lattice_.columns;
        for (int j = 0; j < lattice_.columns; ++j) out[j] = double(row[j]) / divisor;
      }
  };
  copy(vector_x, state.x, 1), copy(vector_v, state.v, velocity_scale());
}

/// Adds `times`·a to the velocities: in double, since what a float would lose is shown in plots.
template <class R>
void OpenClEngine<R>::add_accelerations(State& state, double times) {
  accelerations();
  R* const a = state_.map(acceleration_.get(), CL_MAP_READ);
  Array<double>* components[] = {&state.v.x, &state.v.y, &state.v.z};
  for (int i = 0; i < lattice_.rows; ++i)
    for (int c = 0; c < 3; ++c) {
      const R* row = StateView<R>::row(a, state_.stride(), i, c);
      double* v = components[c]->data() + std::size_t(i) * lattice_.columns;
      for (int j = 0; j < lattice_.columns; ++j) v[j] += times * row[j];
    }
  state_.unmap(acceleration_.get(), a);
}

template <class R>
void OpenClEngine<R>::read(State& state, const Tears& tears) {
  accept_changes(tears);
  read_stored(state);
  if (lag() != 0) add_accelerations(state, lag());
}

template <class R>
void OpenClEngine<R>::read_raw(State& state, const Tears& tears) {
  if (!scheme_->keeps_displacement) return read(state, tears);
  read_stored(state);
  if (!synchronized_) return;
  // As the method will start.
  accept_changes(tears);
  add_accelerations(state, -scheme_->lag * preset_.dt);
}

template <class R>
PositionView OpenClEngine<R>::positions() const {
  PositionView view{lattice_.rows, lattice_.columns, 3 * state_.stride()};
  const R* x = state_.host(vector_x);
  for (int c = 0; c < 3; ++c) {
    if constexpr (sizeof(R) == 4)
      view.f[c] = StateView<R>::row(x, state_.stride(), 0, c);
    else
      view.d[c] = StateView<R>::row(x, state_.stride(), 0, c);
  }
  return view;
}

template <class R>
StoredParticle OpenClEngine<R>::stored(int i, int j) const {
  const auto at = [&](int vector) { return state_.at(vector, i, j); };
  const double scale = velocity_scale();
  return {at(vector_x), at(vector_v) / scale, at(seen()) / scale, lag()};
}

template <class R>
std::size_t OpenClEngine<R>::bytes() const {
  const std::size_t fields = acceleration_ ? state_.numbers() * sizeof(R) : 0;
  return state_.bytes() + fields + std::size_t(lattice_.size()) + (solver_ ? solver_->bytes() : 0);
}

template <class R>
std::vector<StepFeature> OpenClEngine<R>::features() const {
  const Preset& p = preset_;
  return {{"bending", force::bend.on(p)},
          {"rigidity", force::rigidity.on(p)},
          {"curl", false},
          {"self", false},
          {"damping", force::damping.on(p)},
          {"wind", force::wind.on(p)},
          {"air", force::air.on(p)},
          {"bodies", meets_bodies(p)},
          {"tearing", tears_watched()},
          {"pins", !pinned_.empty()},
          {"hand", held_.particle >= 0}};
}

template <class R>
std::string OpenClEngine<R>::name() const {
  const int units = threads();
  return "OpenCL, " + device_->facts().name + ", " + std::to_string(units) +
         (units == 1 ? " compute unit" : " compute units") +
         (width_ > 1 ? ", vectors of " + std::to_string(width_) : std::string());
}

template class OpenClEngine<float>;
template class OpenClEngine<double>;

}  // namespace tyglab::opencl
