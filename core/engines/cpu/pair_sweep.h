// The sweep over a pair of rows, in SIMD, computes the forces of the springs and triangles that the two rows own, and
// updates both rows. The upper end of a spring owns it, so once a pair is done its force is complete and it is
// overwritten at once: a sweep runs in place, computes each spring once, and never stores accelerations. Two rows at a
// time keep the reactions of the upper row on the lower in registers.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tyglab::cpu {

/// What a scene needs. A template argument of the sweep, so that what is off costs nothing.
/// `threads`: warp, weft and shear differ.
enum Feature : unsigned { bending = 1, damping = 2, wind = 4, linear = 8, air = 16, threads = 32, feature_sets = 64 };

/// What is done with the force on a row.
enum class Update : unsigned {
  displacement,  ///< v += force_to_v·F, x += v: Verlet, whose v is a displacement
  general,       ///< x += v_to_x·v + force_to_x·F, v += force_to_v·F
  force          ///< F replaces f[0] and f[1]: for schemes with more vectors, and for readouts
};

/// Two rows for the sweep, the upper one even. Vectors of particles are laid out as in row_field.h and begin
/// at the pair's first particle; two more rows follow. Columns beyond the cloth up to the end of a vector exist,
/// are 0 in v, and stay as they are; so does the lower row if the cloth ends above it.
template <class R>
struct PairTask {
  R* x;
  R* v;
  R* f[4];  ///< rows i … i+3: reactions to forces on the rows above, to be subtracted; those on i+2 and i+3 are begun
            ///< here
  std::ptrdiff_t stride;  ///< elements from one component of a row to the next; 3 strides to the next row
  int columns;
  int rows_below;                ///< rows of the cloth under the upper row
  const std::uint8_t* whole;     ///< tear masks of row i, the next two behind it, or nullptr while untorn
  const std::uint8_t* fixed[2];  ///< non-zero at pinned and held particles; nullptr: none in that row. f[0], f[1] then
                                 ///< keep the force on them
  double L, weft, warp, shear, bend, k_d;  ///< k_d divided by dt where v holds displacements
  const R* linear[2];                      ///< of the two rows, as in LinearSprings; used with the feature of that name
  double weight;                           ///< m·g, N
  double W[3];
  /// Of the air (force.h), for velocities as v has them: its velocity, what |u·n| and |n||u| are multiplied by to
  /// resist a corner across and along a triangle, and the most of both.
  double u[3], air_across, air_along, air_most;
  double v_to_x, force_to_x, force_to_v;
  Update update;
  double dt_v;          ///< factor from v to a displacement, m: dt, or 1 where v is one
  R* max_displacement;  ///< `lanes` numbers: the largest |component| of a displacement so far, m, if the update watches
};

/// The sweeps for one precision, for the best instruction set of this machine.
template <class R>
struct PairSweeps {
  using Function = void (*)(const PairTask<R>&);
  /// Verlet's update is compiled in. The others are looked up in the task for each row, which costs next to nothing and
  /// keeps builds short. A displacement that is not finite makes max_displacement ∞ or NaN.
  struct OfFeatures {
    Function displacement, other;
  };
  OfFeatures sweep[feature_sets];
  int lanes;
  const char* target;  ///< the instruction set: "AVX-512", "AVX2" …
};

template <class R>
PairSweeps<R> pair_sweeps();

}  // namespace tyglab::cpu
