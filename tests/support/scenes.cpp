#include "tests/support/scenes.h"

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>

namespace tyglab::test {

std::uint64_t Random::next() {
  std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

double Random::uniform(double low, double high) {
  return low + (high - low) * double(next() >> 11) * 0x1p-53;
}

Preset cloth(int rows, int columns, const std::string& integrator) {
  Preset preset;
  preset.rows = rows;
  preset.columns = columns;
  preset.integrator = integrator;
  preset.dt = integrator == "verlet" ? 1e-3 : 1e-4;
  preset.precision = Precision::double_;
  return preset;
}

Preset quiet_cloth(int rows, int columns, const std::string& integrator) {
  Preset preset = cloth(rows, columns, integrator);
  preset.g = 0;
  preset.k_b = 0;
  preset.k_d = 0;
  preset.tilt_deg = 90;
  preset.pins.mode = Pins::Mode::none;
  return preset;
}

Preset one_weight(const std::string& integrator) {
  Preset preset;
  preset.kind = Kind::one_weight;
  preset.integrator = integrator;
  preset.precision = Precision::double_;
  preset.m = 0.1;
  preset.k = 40;
  preset.k_d = 0;
  return preset;
}

State crumpled(const Preset& preset, std::uint64_t seed, double amount, double speed) {
  State state = start_state(preset);
  const auto pinned = pinned_particles(preset);
  Random random(seed);
  for (std::size_t p = 0; p < pinned.size(); ++p) {
    if (pinned[p] != 0) continue;
    for (auto* x : {&state.x.x, &state.x.y, &state.x.z}) (*x)[p] += preset.L * random.uniform(-amount, amount);
    for (auto* v : {&state.v.x, &state.v.y, &state.v.z}) (*v)[p] += random.uniform(-speed, speed);
  }
  return state;
}

void load(Simulation& simulation, const State& state) {
  simulation.load(state);
}

void load(oracle::Cloth& cloth, const State& state) {
  for (int i = 0; i < cloth.rows(); ++i) {
    for (int j = 0; j < cloth.columns(); ++j) {
      cloth.at(i, j).x = position(state, std::size_t(i) * cloth.columns() + j);
      cloth.at(i, j).v = velocity(state, std::size_t(i) * cloth.columns() + j);
    }
  }
  cloth.start();
}

glm::dvec3 position(const State& state, std::size_t p) {
  return {state.x.x[p], state.x.y[p], state.x.z[p]};
}
glm::dvec3 velocity(const State& state, std::size_t p) {
  return {state.v.x[p], state.v.y[p], state.v.z[p]};
}

namespace {

template <class Of, class OfOracle>
double largest_distance(const State& state, const oracle::Cloth& cloth, Of of, OfOracle of_oracle) {
  double largest = 0;
  for (int i = 0; i < cloth.rows(); ++i) {
    for (int j = 0; j < cloth.columns(); ++j) {
      const double d = glm::length(of(state, std::size_t(i) * cloth.columns() + j) - of_oracle(cloth.at(i, j)));
      if (!(d < std::numeric_limits<double>::infinity())) return std::numeric_limits<double>::infinity();
      largest = std::max(largest, d);
    }
  }
  return largest;
}

}  // namespace

double distance(Simulation& simulation, const oracle::Cloth& cloth) {
  return largest_distance(simulation.read(), cloth, position, [](const oracle::Particle& p) { return p.x; });
}

double velocity_distance(Simulation& simulation, const oracle::Cloth& cloth) {
  return largest_distance(simulation.read_raw(), cloth, velocity, [](const oracle::Particle& p) { return p.v; });
}

bool all_finite(const State& state) {
  for (const auto* field : {&state.x, &state.v}) {
    for (const auto* array : {&field->x, &field->y, &field->z}) {
      for (const double value : *array) {
        if (!std::isfinite(value)) return false;
      }
    }
  }
  return true;
}

bool identical(const State& a, const State& b) {
  const auto same = [](const Array<double>& p, const Array<double>& q) {
    return p.size() == q.size() && std::memcmp(p.data(), q.data(), p.size() * sizeof(double)) == 0;
  };
  return same(a.x.x, b.x.x) && same(a.x.y, b.x.y) && same(a.x.z, b.x.z) && same(a.v.x, b.v.x) && same(a.v.y, b.v.y) &&
         same(a.v.z, b.v.z);
}

}  // namespace tyglab::test
