#include "core/cloth/start.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tyglab {
namespace {

struct Angle {
  double sine, cosine;
};

/// Exact at multiples of 90°: a z of 6e-17 m would decide to which side a hanging cloth buckles.
Angle angle(double degrees) {
  const double turn = std::fmod(degrees, 360.0);
  const double quarter = std::fmod(turn, 90.0);
  if (quarter == 0) {
    constexpr double sines[4] = {0, 1, 0, -1};
    const int n = (int(turn / 90.0) + 4) % 4;
    return {sines[n], sines[(n + 1) % 4]};
  }
  const double radians = turn * std::numbers::pi / 180;
  return {std::sin(radians), std::cos(radians)};
}

StateRows weight_row(const Preset& p) {
  return [x = p.x_0 + glm::dvec3(0, p.offset, 0), v = starting_velocity(p)](int, const StateRow& row) {
    for (int c = 0; c < 3; ++c) row.x[c][0] = x[c], row.v[c][0] = v[c];
  };
}

}  // namespace

Lattice lattice_of(const Preset& preset) {
  return preset.kind == Kind::one_weight ? Lattice{1, 1} : Lattice{preset.rows, preset.columns};
}

glm::dvec3 starting_velocity(const Preset& preset) {
  return preset.kind == Kind::one_weight ? glm::dvec3(0, preset.v_0.y, 0) : preset.v_0;
}

StateRows start_rows(const Preset& p) {
  if (p.kind == Kind::one_weight) return weight_row(p);
  const Angle tilt = angle(p.tilt_deg);
  const double spacing = p.initial_stretch * p.L;
  std::vector<double> along(std::size_t(p.columns));
  for (int j = 0; j < p.columns; ++j) along[j] = p.x_0.x + (j - (p.columns - 1) / 2.0) * spacing;
  const bool moves = p.v_0 != glm::dvec3(0);  // otherwise it does not matter who is pinned
  return [=, x_0 = p.x_0, v_0 = p.v_0, along = std::move(along),
          pinned = moves ? pinned_particles(p) : std::vector<std::uint8_t>()](int i, const StateRow& row) {
    const std::size_t columns = along.size();
    std::copy(along.begin(), along.end(), row.x[0]);
    std::fill_n(row.x[1], columns, x_0.y - i * spacing * tilt.sine);
    std::fill_n(row.x[2], columns, x_0.z + i * spacing * tilt.cosine);
    for (int c = 0; c < 3; ++c) {
      std::fill_n(row.v[c], columns, v_0[c]);
      if (pinned.empty()) continue;
      for (std::size_t j = 0; j < columns; ++j)
        if (pinned[i * columns + j] != 0) row.v[c][j] = 0;
    }
  };
}

State start_state(const Preset& p) {
  const Lattice lattice = lattice_of(p);
  State state;
  state.x.resize(std::size_t(lattice.size()));
  state.v.resize(std::size_t(lattice.size()));
  const StateRows rows = start_rows(p);
  for (int i = 0; i < lattice.rows; ++i) {
    const std::size_t at = std::size_t(i) * lattice.columns;
    rows(i, {{&state.x.x[at], &state.x.y[at], &state.x.z[at]}, {&state.v.x[at], &state.v.y[at], &state.v.z[at]}});
  }
  return state;
}

std::vector<std::uint8_t> pinned_particles(const Preset& p) {
  const Lattice lattice = lattice_of(p);
  std::vector<std::uint8_t> mask(std::size_t(lattice.size()), 0);
  if (p.kind == Kind::one_weight) return mask;
  const int bottom = lattice.rows - 1, right = lattice.columns - 1;
  const auto pin = [&](int i, int j) { mask[std::size_t(i) * lattice.columns + j] = 1; };
  const auto pin_row = [&](int i) {
    for (int j = 0; j <= right; ++j) pin(i, j);
  };
  const auto pin_column = [&](int j) {
    for (int i = 0; i <= bottom; ++i) pin(i, j);
  };
  switch (p.pins.mode) {
    case Pins::Mode::none:
      break;
    case Pins::Mode::top_row:
      pin_row(0);
      break;
    case Pins::Mode::top_corners:
      pin(0, 0), pin(0, right);
      break;
    case Pins::Mode::four_corners:
      pin(0, 0), pin(0, right), pin(bottom, 0), pin(bottom, right);
      break;
    case Pins::Mode::left_column:
      pin_column(0);
      break;
    case Pins::Mode::boundary:
      pin_row(0), pin_row(bottom), pin_column(0), pin_column(right);
      break;
    case Pins::Mode::list:
      for (const auto [i, j] : p.pins.list)
        if (lattice.contains(i, j)) pin(i, j);
      break;
  }
  return mask;
}

bool same_pins(const Preset& a, const Preset& b) {
  if (a.kind != b.kind || lattice_of(a) != lattice_of(b)) return false;
  return a.pins == b.pins || pinned_particles(a) == pinned_particles(b);
}

std::vector<int> particles_in(const std::vector<std::uint8_t>& mask) {
  std::vector<int> list;
  for (std::size_t p = 0; p < mask.size(); ++p)
    if (mask[p] != 0) list.push_back(int(p));
  return list;
}

}  // namespace tyglab
