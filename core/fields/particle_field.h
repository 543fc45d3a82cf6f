// One number per particle that colors the cloth: tension or strain of its springs, its motion, or its distance from a
// reference.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/cloth/lattice.h"
#include "core/simulation.h"

namespace tyglab {

enum class ParticleField { tension, strain, speed, kinetic, distance };

struct FieldInfo {
  ParticleField field;
  std::string_view name;    ///< "tension", on the command line and in settings
  std::string_view title;   ///< "Largest tension"
  std::string_view symbol;  ///< of the notation table, typeset; empty: none
  std::string_view unit;    ///< empty: a plain number
  bool is_signed = false;   ///< less than 0 means something, and 0 is in the middle
  std::string_view help;    ///< a sentence
};

/// In the order of the enumerators.
std::span<const FieldInfo> particle_fields();
const FieldInfo& info(ParticleField field);
/// The field of that name; none if there is none.
std::optional<ParticleField> field_called(std::string_view name);

/// The places at which a cloth has values to be drawn: every n-th row and column of its sites, or all particles, the
/// copies of a cloth that has parted among them.
DrawnSites drawn_sites(const Simulation& cloth, int every);

/// Works out a field at each of the sites, row after row, with the formulas of the read-out: the largest F_s of the
/// stretch springs at a particle (N, what F_max is compared with), their mean strain (below 0: shorter than at rest),
/// speed |v| (m/s), m v²/2 (J), distance to the same particle of `reference` (m, at its time: carried there with the
/// velocities, as rms_distance()). `reference` is needed by ParticleField::distance alone; without one, or where its
/// lattice differs, its values are not numbers. Tension and strain look at positions alone, in the engine's own memory.
void read_field(ParticleField field, Simulation& cloth, Simulation* reference, const DrawnSites& sites,
                std::vector<float>& values);

/// Between what the values that are numbers lie, and a size that all but two in a hundred of them stay below, by a
/// sample of some thousands: what is far beyond (a pinned corner) is not to decide a scale. Half of them are below the
/// middle.
struct FieldSpan {
  float least, most, usual, middle;
};
/// None where no value is a number.
std::optional<FieldSpan> span_of(std::span<const float> values);

// Adds the springs of one direction to the particles of a row, in SIMD: the inner loop of tension and strain.

/// Springs between the particles begin <= j < end of a row and those that stand at j + other of the same arrays.
template <class R>
struct FieldSprings {
  const R* x[3];
  std::ptrdiff_t other;
  int begin, end;
  double k, rest;  ///< N/m, m
};

/// largest[j] becomes F_s (2.5) of the spring, N, where that is more.
void raise_to_tension(const FieldSprings<float>& springs, float* largest);
void raise_to_tension(const FieldSprings<double>& springs, double* largest);
/// Adds the strain, (|x_ij| - rest) / rest, to sum[j].
void add_strain(const FieldSprings<float>& springs, float* sum);
void add_strain(const FieldSprings<double>& springs, double* sum);

}  // namespace tyglab
