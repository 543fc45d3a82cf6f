#include "core/fields/particle_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "core/forces/parted.h"

namespace tyglab {
namespace {

constexpr std::array<FieldInfo, 5> infos{
    {{ParticleField::tension, "tension", "Tension", "F_s", "N", false,
      "The largest force of the stretch springs at a particle: a spring tears where it exceeds F_max."},
     {ParticleField::strain, "strain", "Strain", "", "", true,
      "Mean relative elongation of the stretch springs at a particle; below 0 they are shorter than at rest."},
     {ParticleField::speed, "speed", "Speed", "v", "m/s", false, "How fast a particle moves."},
     {ParticleField::kinetic, "kinetic", "Kinetic energy", "", "J", false, "m v²/2 of a particle."},
     {ParticleField::distance, "distance", "Distance from the reference", "", "m", false,
      "Distance of a particle from the same particle of the reference copy."}}};

/// What the springs say of one row of particles: of each of the eight directions those that are whole.
template <class R>
class RowOfSprings {
 public:
  RowOfSprings(const Preset& preset, const Tears& tears, const PositionView& view)
      : p_(preset), tears_(tears), lattice_(tears.lattice()), view_(view), values_(size()), counts_(size()) {}

  /// Values of the row's particles, valid until the next call.
  const R* read(ParticleField field, int i) {
    std::fill(values_.begin(), values_.end(), R(0));
    if (field == ParticleField::strain) std::fill(counts_.begin(), counts_.end(), R(0));
    for (int d = 0; d < stretch_directions; ++d) {
      add(field, i, d, true);
      add(field, i, d, false);
    }
    if (field == ParticleField::strain)
      for (std::size_t j = 0; j < size(); ++j) values_[j] /= std::max(counts_[j], R(1));
    return values_.data();
  }

 private:
  std::size_t size() const { return std::size_t(lattice_.columns); }
  const R* const* components() const {
    if constexpr (sizeof(R) == sizeof(float))
      return view_.f;
    else
      return view_.d;
  }

  /// The springs of direction d that particles of row i own, or else those that end at them.
  void add(ParticleField field, int i, int d, bool owns) {
    const Direction& to = directions[std::size_t(d)];
    const int di = owns ? to.di : -to.di, dj = owns ? to.dj : -to.dj;  // to the other end
    if (i + di < 0 || i + di >= lattice_.rows) return;
    const std::size_t row = std::size_t(i) * std::size_t(view_.stride);
    const R* const* x = components();
    FieldSprings<R> springs{{x[0] + row, x[1] + row, x[2] + row},
                            std::ptrdiff_t(di) * view_.stride + dj,
                            std::max(0, -dj),
                            lattice_.columns - std::max(0, dj),
                            spring_constant(p_, to),
                            to.rest * p_.L};
    const std::uint8_t* masks = tears_.row(owns ? i : i + di);
    if (masks == nullptr) return take(field, springs);
    const int owner = owns ? 0 : dj;  // columns from a particle to the owner
    const int end = springs.end;
    for (int j = springs.begin; j < end;) {  // from tear to tear
      int next = j;
      while (next < end && (masks[next + owner] >> d & 1) != 0) ++next;
      springs.begin = j, springs.end = next;
      if (next > j) take(field, springs);
      j = next + 1;
    }
  }

  void take(ParticleField field, const FieldSprings<R>& springs) {
    if (field == ParticleField::tension) return raise_to_tension(springs, values_.data());
    add_strain(springs, values_.data());
    for (int j = springs.begin; j < springs.end; ++j) counts_[std::size_t(j)] += 1;
  }

  const Preset& p_;
  const Tears& tears_;
  const Lattice& lattice_;
  const PositionView& view_;
  std::vector<R> values_, counts_;
};

template <class R>
void read_springs(ParticleField field, const Simulation& cloth, const DrawnSites& sites, float* to) {
  const PositionView view = cloth.positions();
  RowOfSprings<R> row(cloth.preset(), cloth.tears(), view);
  for (int i = 0; i < sites.rows(); ++i) {
    const R* values = row.read(field, sites.row(i));
    for (int j = 0; j < sites.columns(); ++j) *to++ = float(values[sites.column(j)]);
  }
}

/// The same of all particles of a cloth that has parted, spring by spring.
void read_springs_of_parted(ParticleField field, const Simulation& cloth, std::vector<float>& values) {
  const Preset& p = cloth.preset();
  const Tears& tears = cloth.tears();
  const Lattice& lattice = tears.lattice();
  const PositionView view = cloth.positions();
  std::fill(values.begin(), values.end(), 0.f);
  std::vector<int> counts(values.size(), 0);
  const auto place = [&](int n) { return view.at(n / lattice.columns, n % lattice.columns); };
  const auto add = [&](int direction, int a, int b) {
    const Direction& to = directions[std::size_t(direction)];
    const double rest = to.rest * p.L, longer = glm::distance(place(a), place(b)) - rest;
    for (const int n : {a, b}) {
      float& value = values[std::size_t(n)];
      if (field == ParticleField::tension)
        value = std::max(value, float(spring_constant(p, to) * std::max(longer, 0.0)));
      else
        value += float(longer / rest), ++counts[std::size_t(n)];
    }
  };
  for (int d = 0; d < stretch_directions; ++d)
    for (int i = 0; i < lattice.rows; ++i)
      for (int j = 0; j < lattice.columns; ++j) {
        const Direction& to = directions[std::size_t(d)];
        if (lattice.has_spring(d, i, j) && tears.whole(d, i, j))
          add(d, i * lattice.columns + j, (i + to.di) * lattice.columns + j + to.dj);
      }
  for (const LooseSpring& spring : loose_springs(tears, 0, stretch_directions))
    add(spring.spring.direction, spring.a, spring.b);
  for (std::size_t n = 0; field == ParticleField::strain && n < values.size(); ++n)
    values[n] /= float(std::max(counts[n], 1));
}

/// value(p) of each site's particle, by its index in a dense state.
template <class Value>
void read_each(const DrawnSites& sites, float* to, const Value& value) {
  for (int i = 0; i < sites.rows(); ++i) {
    const std::size_t row = std::size_t(sites.row(i)) * std::size_t(sites.whole.columns);
    for (int j = 0; j < sites.columns(); ++j) *to++ = float(value(row + std::size_t(sites.column(j))));
  }
}

double speed_squared(const State& state, std::size_t p) {
  const double x = state.v.x[p], y = state.v.y[p], z = state.v.z[p];
  return x * x + y * y + z * z;
}

void read_distance(Simulation& cloth, Simulation& reference, const DrawnSites& sites, float* to) {
  const State &a = cloth.read(), &b = reference.read();
  const double ahead = &cloth == &reference ? 0 : reference.time() - cloth.time();
  const auto all = std::size_t(cloth.lattice().sites().size());
  read_each(sites, to, [&](std::size_t p) {
    if (p >= all) return std::numeric_limits<double>::quiet_NaN();  // copies of two cloths are no pairs
    const double x = a.x.x[p] + ahead * a.v.x[p] - b.x.x[p], y = a.x.y[p] + ahead * a.v.y[p] - b.x.y[p],
                 z = a.x.z[p] + ahead * a.v.z[p] - b.x.z[p];
    return std::sqrt(x * x + y * y + z * z);
  });
}

void take_sizes(std::span<const float> values, FieldSpan& span) {
  constexpr std::size_t most_samples = 5000;
  constexpr double nearly_all = 0.98, half = 0.5;
  std::vector<float> sizes;
  // An odd step, so that a sample does not stay in a few columns.
  for (std::size_t p = 0, step = values.size() / most_samples | 1; p < values.size(); p += step)
    if (std::isfinite(values[p])) sizes.push_back(std::abs(values[p]));
  const auto below = [&](double share) {
    if (sizes.empty()) return 0.f;
    const auto at = sizes.begin() + std::ptrdiff_t(share * double(sizes.size() - 1));
    std::nth_element(sizes.begin(), at, sizes.end());
    return *at;
  };
  span.usual = below(nearly_all), span.middle = below(half);
}

}  // namespace

std::span<const FieldInfo> particle_fields() {
  return infos;
}

const FieldInfo& info(ParticleField field) {
  return infos[std::size_t(field)];
}

std::optional<ParticleField> field_called(std::string_view name) {
  for (const FieldInfo& field : infos)
    if (field.name == name) return field.field;
  return std::nullopt;
}

namespace {
void read_all(ParticleField field, Simulation& cloth, Simulation* reference, const DrawnSites& sites,
              std::vector<float>& values) {
  values.resize(std::size_t(sites.rows()) * std::size_t(sites.columns()));
  const bool parted = cloth.tears().mesh() != nullptr && sites.every == 1;
  switch (field) {
    case ParticleField::tension:
    case ParticleField::strain:
      if (parted) return read_springs_of_parted(field, cloth, values);
      return cloth.positions().f[0] != nullptr ? read_springs<float>(field, cloth, sites, values.data())
                                               : read_springs<double>(field, cloth, sites, values.data());
    case ParticleField::speed: {
      const State& state = cloth.read();
      return read_each(sites, values.data(), [&](std::size_t p) { return std::sqrt(speed_squared(state, p)); });
    }
    case ParticleField::kinetic: {
      const State& state = cloth.read();
      const double half = cloth.preset().m / 2;
      return read_each(sites, values.data(),
                       [&](std::size_t p) { return half * cloth.tears().share(int(p)) * speed_squared(state, p); });
    }
    case ParticleField::distance:
      if (reference == nullptr || reference->lattice().sites() != cloth.lattice().sites())
        return std::fill(values.begin(), values.end(), std::numeric_limits<float>::quiet_NaN());
      return read_distance(cloth, *reference, sites, values.data());
  }
}

}  // namespace

DrawnSites drawn_sites(const Simulation& cloth, int every) {
  return {every > 1 ? cloth.lattice().sites() : cloth.lattice(), every};
}

void read_field(ParticleField field, Simulation& cloth, Simulation* reference, const DrawnSites& sites,
                std::vector<float>& values) {
  read_all(field, cloth, reference, sites, values);
  // Where there is no particle there is no value.
  if (sites.every == 1 && sites.whole == cloth.lattice())
    std::fill(values.begin() + cloth.tears().particles(), values.end(), std::numeric_limits<float>::quiet_NaN());
}

std::optional<FieldSpan> span_of(std::span<const float> values) {
  constexpr float most = std::numeric_limits<float>::max();
  FieldSpan span{most, -most, 0, 0};
  for (const float value : values) {
    const bool finite = std::abs(value) <= most;  // false for NaN too
    span.least = finite && value < span.least ? value : span.least;
    span.most = finite && value > span.most ? value : span.most;
  }
  if (span.least > span.most) return std::nullopt;
  take_sizes(values, span);
  return span;
}

}  // namespace tyglab
