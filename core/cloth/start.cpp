#include "core/cloth/start.h"

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

bool pinned_by_name(const Preset& p, int i, int j) {
  const bool top = i == 0, bottom = i == p.rows - 1, left = j == 0, right = j == p.columns - 1;
  switch (p.pins.mode) {
    case Pins::Mode::top_row:
      return top;
    case Pins::Mode::top_corners:
      return top && (left || right);
    case Pins::Mode::four_corners:
      return (top || bottom) && (left || right);
    case Pins::Mode::left_column:
      return left;
    case Pins::Mode::boundary:
      return top || bottom || left || right;
    case Pins::Mode::none:
    case Pins::Mode::list:
      return false;
  }
  return false;
}

}  // namespace

Lattice lattice_of(const Preset& preset) {
  return preset.kind == Kind::one_weight ? Lattice{1, 1} : Lattice{preset.rows, preset.columns};
}

State start_state(const Preset& p) {
  const Lattice lattice = lattice_of(p);
  State state;
  state.x.resize(std::size_t(lattice.size()));
  state.v.resize(std::size_t(lattice.size()));
  if (p.kind == Kind::one_weight) {
    state.x.x[0] = p.x_0.x, state.x.y[0] = p.x_0.y + p.offset, state.x.z[0] = p.x_0.z;
    state.v.y[0] = p.v_0.y;
    return state;
  }
  const auto [sine, cosine] = angle(p.tilt_deg);
  const auto pinned = pinned_particles(p);
  const double spacing = p.initial_stretch * p.L;
  for (int i = 0; i < lattice.rows; ++i)
    for (int j = 0; j < lattice.columns; ++j) {
      const std::size_t n = std::size_t(i) * lattice.columns + j;
      state.x.x[n] = p.x_0.x + (j - (lattice.columns - 1) / 2.0) * spacing;
      state.x.y[n] = p.x_0.y - i * spacing * sine;
      state.x.z[n] = p.x_0.z + i * spacing * cosine;
      if (pinned[n]) continue;
      state.v.x[n] = p.v_0.x, state.v.y[n] = p.v_0.y, state.v.z[n] = p.v_0.z;
    }
  return state;
}

std::vector<std::uint8_t> pinned_particles(const Preset& p) {
  const Lattice lattice = lattice_of(p);
  std::vector<std::uint8_t> mask(std::size_t(lattice.size()), 0);
  if (p.kind == Kind::one_weight) return mask;
  for (int i = 0; i < lattice.rows; ++i)
    for (int j = 0; j < lattice.columns; ++j) mask[std::size_t(i) * lattice.columns + j] = pinned_by_name(p, i, j);
  if (p.pins.mode == Pins::Mode::list)
    for (const auto [i, j] : p.pins.list)
      if (lattice.contains(i, j)) mask[std::size_t(i) * lattice.columns + j] = 1;
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
