// What colors the cloth, held against the read-out's forces spring by spring.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/fields/particle_field.h"
#include "core/forces/readout.h"
#include "tests/support/scenes.h"

namespace tyglab::particle_field_test {

std::vector<float> field_of(ParticleField field, Simulation& cloth, int every = 1, Simulation* reference = nullptr) {
  std::vector<float> values;
  read_field(field, cloth, reference, {cloth.lattice(), every}, values);
  return values;
}

/// The stretch springs at a particle, by the read-out.
std::vector<StencilForce> springs_at(Simulation& cloth, int i, int j) {
  const State& state = cloth.read();
  Neighborhood near(i, j);
  const Lattice& lattice = cloth.lattice();
  for (int di = -Neighborhood::reach; di <= Neighborhood::reach; ++di)
    for (int dj = -Neighborhood::reach; dj <= Neighborhood::reach; ++dj)
      if (lattice.contains(i + di, j + dj)) {
        const auto p = std::size_t(i + di) * std::size_t(lattice.columns) + std::size_t(j + dj);
        near.x(i + di, j + dj) = test::position(state, p), near.v(i + di, j + dj) = test::velocity(state, p);
      }
  std::vector<StencilForce> springs = stencils_on_particle(cloth.preset(), cloth.tears(), near, i, j);
  std::erase_if(springs, [](const StencilForce& one) { return one.force != &force::stretch; });
  return springs;
}

void check_springs(Simulation& cloth, double epsilon) {
  const std::vector<float> tension = field_of(ParticleField::tension, cloth);
  const std::vector<float> strain = field_of(ParticleField::strain, cloth);
  const Preset& preset = cloth.preset();
  double farthest = 0;
  for (int i = 0; i < preset.rows; ++i)
    for (int j = 0; j < preset.columns; ++j) {
      double largest = 0, sum = 0;
      const auto springs = springs_at(cloth, i, j);
      for (const StencilForce& spring : springs) {
        largest = std::max(largest, glm::length(spring.F));
        sum += (spring.length - spring.rest) / spring.rest;
      }
      const auto p = std::size_t(i) * std::size_t(preset.columns) + std::size_t(j);
      farthest = std::max(farthest, std::abs(double(tension[p]) - largest) / (preset.k_s * preset.L));
      farthest = std::max(farthest, std::abs(double(strain[p]) - sum / std::max(1.0, double(springs.size()))));
    }
  CHECK(farthest < epsilon);
}

TEST_CASE("tension and strain are those of the read-out's springs, in both precisions, whole and torn") {
  for (const Precision precision : {Precision::float_, Precision::double_})
    for (const auto& [rows, columns] : {std::pair{9, 37}, {40, 3}, {2, 1}}) {
      CAPTURE(columns);
      Preset preset = test::cloth(rows, columns);
      preset.precision = precision;
      Simulation cloth(preset);
      test::load(cloth, test::crumpled(preset, 5));
      const double epsilon = precision == Precision::float_ ? 3e-6 : 1e-6;
      check_springs(cloth, epsilon);
      std::vector<Pins::Site> path;
      for (int j = 0; j < columns; ++j) path.push_back({rows / 2, j});
      cloth.apply(edit::Cut{path});
      check_springs(cloth, epsilon);
    }
}

TEST_CASE("a spring that is at the edge of tearing has F_max as its tension") {
  Preset preset = test::quiet_cloth(2, 1);
  preset.k_s = 40;
  Simulation cloth(preset);
  State state = start_state(preset);
  state.x.x[1] = state.x.x[0], state.x.z[1] = state.x.z[0];
  state.x.y[1] = state.x.y[0] - 1.25 * preset.L;
  test::load(cloth, state);
  for (const float value : field_of(ParticleField::tension, cloth))
    CHECK(value == doctest::Approx(40 * 0.25 * preset.L));
  for (const float value : field_of(ParticleField::strain, cloth)) CHECK(value == doctest::Approx(0.25));
}

TEST_CASE("speed and kinetic energy are the state's; their sum is the ledger's kinetic energy") {
  const Preset preset = test::quiet_cloth(6, 7);
  Simulation cloth(preset);
  test::load(cloth, test::crumpled(preset, 3));
  const std::vector<float> speed = field_of(ParticleField::speed, cloth);
  const std::vector<float> kinetic = field_of(ParticleField::kinetic, cloth);
  double sum = 0;
  for (std::size_t p = 0; p < speed.size(); ++p) {
    CHECK(speed[p] == doctest::Approx(glm::length(test::velocity(cloth.read(), p))));
    sum += kinetic[p];
  }
  CHECK(sum == doctest::Approx(cloth.energy().energy.kinetic).epsilon(1e-6));
}

TEST_CASE("the distance is that to the reference, none to itself, and no number without one") {
  const Preset preset = test::cloth(5, 6);
  Simulation cloth(preset), other(preset), larger(test::cloth(6, 6));
  State state = start_state(preset);
  state.x.z[7] += 0.125;
  test::load(other, state);
  const std::vector<float> away = field_of(ParticleField::distance, cloth, 1, &other);
  for (std::size_t p = 0; p < away.size(); ++p) CHECK(away[p] == doctest::Approx(p == 7 ? 0.125 : 0));
  for (const float value : field_of(ParticleField::distance, cloth, 1, &cloth)) CHECK(value == 0);
  for (Simulation* none : {static_cast<Simulation*>(nullptr), &larger}) {
    const auto values = field_of(ParticleField::distance, cloth, 1, none);
    CHECK(std::isnan(values.front()));
    CHECK_FALSE(span_of(values).has_value());
  }
}

TEST_CASE("a few values far beyond the others do not count as usual") {
  std::vector<float> values(1000, 0.5f);
  values[3] = -40, values[500] = 80, values[700] = NAN;
  const auto span = span_of(values);
  REQUIRE(span);
  CHECK(span->least == -40);
  CHECK(span->most == 80);
  CHECK(span->usual == 0.5f);
}

TEST_CASE("of a cloth that is drawn in part, those particles are read") {
  const Preset preset = test::cloth(10, 12);
  Simulation cloth(preset);
  test::load(cloth, test::crumpled(preset, 9));
  const DrawnSites sites{cloth.lattice(), 4};
  CHECK(sites.rows() == 4);
  CHECK(sites.columns() == 4);
  for (const FieldInfo& field : particle_fields()) {
    CHECK(field_called(field.name) == field.field);
    if (field.field == ParticleField::distance) continue;
    const std::vector<float> all = field_of(field.field, cloth), part = field_of(field.field, cloth, 4);
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        CHECK(part[std::size_t(i * 4 + j)] == all[std::size_t(sites.row(i) * 12 + sites.column(j))]);
  }
  CHECK_FALSE(field_called("colour").has_value());
}

}  // namespace tyglab::particle_field_test
