
#include "core/cloth/state.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <numbers>

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

/// Where particles are at the start.
struct StartPlaces {
  explicit StartPlaces(const Preset& p)
      : x_0(p.x_0), tilt(angle(p.tilt_deg)), spacing(p.initial_stretch * p.L), middle((p.columns - 1) / 2.0) {}
  double x(int j) const { return x_0.x + (j - middle) * spacing; }
  double y(int i) const { return x_0.y - i * spacing * tilt.sine; }
  double z(int i) const { return x_0.z + i * spacing * tilt.cosine; }

  glm::dvec3 x_0;
  Angle tilt;
  double spacing, middle;
};

StateRows weight_row(const Preset& p) {
  return [x = starting_position(p, 0, 0), v = starting_velocity(p)](int, const StateRow& row) {
    for (int c = 0; c < 3; ++c) row.x[c][0] = x[c], row.v[c][0] = v[c];
  };
}

}  // namespace

Lattice lattice_of(const Preset& preset) {
  return preset.kind == Kind::one_weight ? Lattice{1, 1} : Lattice{preset.rows, preset.columns};
}

glm::dvec3 starting_position(const Preset& p, int i, int j) {
  if (p.kind == Kind::one_weight) return p.x_0 + glm::dvec3(0, p.offset, 0);
  const StartPlaces places(p);
  return {places.x(j), places.y(i), places.z(i)};
}

glm::dvec3 starting_velocity(const Preset& preset) {
  return preset.kind == Kind::one_weight ? glm::dvec3(0, preset.v_0.y, 0) : preset.v_0;
}

StateRows start_rows(const Preset& p) {
  if (p.kind == Kind::one_weight) return weight_row(p);
  const StartPlaces places(p);
  std::vector<double> along(std::size_t(p.columns));
  for (int j = 0; j < p.columns; ++j) along[j] = places.x(j);
  const bool moves = p.v_0 != glm::dvec3(0);  // otherwise it does not matter who is pinned
  return [=, v_0 = p.v_0, along = std::move(along), pinned = moves ? pinned_particles(p) : std::vector<std::uint8_t>()](
             int i, const StateRow& row) {
    const std::size_t columns = along.size();
    std::copy(along.begin(), along.end(), row.x[0]);
    std::fill_n(row.x[1], columns, places.y(i));
    std::fill_n(row.x[2], columns, places.z(i));
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

std::vector<std::uint8_t> particles_at(const Lattice& lattice, Pins::Mode mode, std::span<const Pins::Site> sites) {
  std::vector<std::uint8_t> mask(std::size_t(lattice.size()), 0);
  const int bottom = lattice.rows - 1, right = lattice.columns - 1;
  const auto pin = [&](int i, int j) { mask[std::size_t(i) * lattice.columns + j] = 1; };
  const auto pin_row = [&](int i) {
    for (int j = 0; j <= right; ++j) pin(i, j);
  };
  const auto pin_column = [&](int j) {
    for (int i = 0; i <= bottom; ++i) pin(i, j);
  };
  switch (mode) {
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
      for (const auto [i, j] : sites)
        if (lattice.contains(i, j)) pin(i, j);
      break;
  }
  return mask;
}

std::vector<std::uint8_t> pinned_particles(const Preset& p) {
  return particles_at(lattice_of(p), p.kind == Kind::cloth ? p.pins.mode : Pins::Mode::none, p.pins.list);
}

std::vector<bool> moves_pins(const Preset& p) {
  std::vector<bool> moves(p.pins.motions.size(), true);
  if (p.kind != Kind::cloth || moves.empty()) return moves;
  const Lattice lattice = lattice_of(p);
  const std::vector<std::uint8_t> pinned = pinned_particles(p);
  std::map<Pins::Mode, bool> named;
  for (std::size_t n = 0; n < moves.size(); ++n) {
    const Pins::Motion& motion = p.pins.motions[n];
    if (motion.mode == Pins::Mode::list) {
      moves[n] = std::any_of(motion.list.begin(), motion.list.end(), [&](const Pins::Site& site) {
        return lattice.contains(site.i, site.j) && pinned[std::size_t(site.i) * lattice.columns + site.j] != 0;
      });
      continue;
    }
    const auto [known, fresh] = named.try_emplace(motion.mode);
    if (fresh) {
      const std::vector<std::uint8_t> picked = particles_at(lattice, motion.mode, {});
      for (std::size_t k = 0; k < picked.size(); ++k) known->second |= picked[k] != 0 && pinned[k] != 0;
    }
    moves[n] = known->second;
  }
  return moves;
}

bool same_pins(const Preset& a, const Preset& b) {
  if (a.kind != b.kind || lattice_of(a) != lattice_of(b)) return false;
  return a.pins == b.pins || (a.pins.motions == b.pins.motions && pinned_particles(a) == pinned_particles(b));
}

std::vector<int> particles_in(const std::vector<std::uint8_t>& mask) {
  std::vector<int> list;
  for (std::size_t p = 0; p < mask.size(); ++p)
    if (mask[p] != 0) list.push_back(int(p));
  return list;
}

/// Sweeps load whole vectors of masks, of a pair of rows and of the next one.
static std::size_t sweep_margin(const Lattice& lattice) {
  return 2 * std::size_t(lattice.columns) + 128;
}

Tears::Tears(const Lattice& lattice, std::shared_ptr<const Mesh> mesh) : lattice_(lattice), mesh_(std::move(mesh)) {
  assert(mesh_ && lattice_.sites() == mesh_->sites() && lattice_.size() >= mesh_->particles());
  masks_.assign(std::size_t(lattice_.size()) + sweep_margin(lattice_), all_springs);
  const auto lose = [&](int i, int j, unsigned springs) {
    if (lattice_.contains(i, j)) masks_[index(i, j)] &= std::uint8_t(~springs);
  };
  // Springs that a site owns or ends, and bending springs over it.
  const auto lose_all = [&](int i, int j) {
    lose(i, j, all_springs);
    lose(i, j - 1, bit_E | bit_EE), lose(i, j - 2, bit_EE);
    lose(i - 1, j, bit_S | bit_SS), lose(i - 2, j, bit_SS);
    lose(i - 1, j - 1, bit_SE), lose(i - 1, j + 1, bit_SW);
  };
  for (const int site : mesh_->parted_sites()) lose_all(site / lattice_.columns, site % lattice_.columns);
  for (int i = lattice_.rows - lattice_.copy_rows; i < lattice_.rows; ++i)
    for (int j = 0; j < lattice_.columns; ++j) lose_all(i, j);
  torn_ = mesh_->copies();
}

bool Tears::tear(int direction, int i, int j) {
  assert(!mesh_);
  if (!lattice_.has_spring(direction, i, j) || !whole(direction, i, j)) return false;
  if (masks_.empty()) masks_.assign(std::size_t(lattice_.size()) + sweep_margin(lattice_), all_springs);
  masks_[index(i, j)] &= std::uint8_t(~(1u << direction));
  ++torn_;
  // A bending spring lies over two E (or two S) springs: over the torn one and its neighbor on either side.
  if (direction == 0) {
    masks_[index(i, j)] &= std::uint8_t(~bit_EE);
    if (j > 0) masks_[index(i, j - 1)] &= std::uint8_t(~bit_EE);
  } else if (direction == 1) {
    masks_[index(i, j)] &= std::uint8_t(~bit_SS);
    if (i > 0) masks_[index(i - 1, j)] &= std::uint8_t(~bit_SS);
  }
  return true;
}

bool Tears::triangle_whole(int i, int j, int which) const {
  if (masks_.empty()) return true;
  assert((which == 0 || which == 1) && lattice_.contains(i + 1, j + 1));
  const auto& corners = quad_triangles[(i + j) & 1][which];
  for (int e = 0; e < 3; ++e) {
    const Corner a = corners[e], b = corners[(e + 1) % 3];
    // The owner of the edge is its upper end, or its left end within a row.
    const bool a_owns = a.di < b.di || (a.di == b.di && a.dj < b.dj);
    const Corner from = a_owns ? a : b, to = a_owns ? b : a;
    const int di = to.di - from.di, dj = to.dj - from.dj;
    const int direction = di == 0 ? 0 : dj == 0 ? 1 : dj > 0 ? 2 : 3;
    if (!whole(direction, i + from.di, j + from.dj)) return false;
  }
  return true;
}

}  // namespace tyglab
