// The sweep over one row of particles, in SIMD: forces of the springs and triangles that the row owns, and the update
// of the row. Springs are owned by their upper end, so once row i is done the force on it is complete and it is
// overwritten at once: a sweep runs in place, computes each spring once, and a never travels through memory.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tyglab::cpu {

/// What a scene needs; worked out once when something changes, and a template argument of the sweep, so that what is
/// off costs nothing.
enum Feature : unsigned { bending = 1, damping = 2, feature_sets = 4 };

/// What happens with the force on the row.
enum class Update : unsigned {
  displacement,  ///< v += force_to_v·F, x += v: Verlet, whose v is a displacement
  general,       ///< x += v_to_x·v + force_to_x·F, v += force_to_v·F
  force,         ///< F is stored in f[0]: for schemes with more vectors, bodies, readouts
  count
};

/// One row for the sweep. Arrays begin at the row's first particle and go on for two more rows of `stride` elements;
/// columns beyond the cloth up to the end of a vector are there, hold 0 in v, and stay as they are.
template <class R>
struct RowTask {
  R* x[3];
  R* v[3];
  R* f[3][3];  ///< force rows i, i+1, i+2, components x, y, z; i+2 is begun here
  std::ptrdiff_t stride;
  int columns;
  int rows_below;             ///< 0, 1, or 2 and more
  const std::uint8_t* whole;  ///< tear masks of the row (and the next), or nullptr while untorn
  const std::uint8_t* fixed;  ///< non-zero at pinned and held particles of the row, or nullptr; F is then kept in f[0]
  double L, k_s, k_b, k_d;    ///< k_d divided by dt where v holds displacements
  double weight;              ///< m·g, N
  double W[3];
  double v_to_x, force_to_x, force_to_v;
  double dt_v;     ///< what v must be multiplied with to be a way, m: dt, or 1 for displacements
  int parity;      ///< of the row's number: which diagonals the triangles have
  R* largest_way;  ///< `lanes` numbers: the largest |component| of a way so far (m), where the update watches
};

/// The functions for one precision, for the best instruction set of this machine.
template <class R>
struct RowSweeps {
  using Function = void (*)(const RowTask<R>&);
  /// Indexed [features][update]. A way that is not finite makes largest_way ∞ or NaN.
  Function sweep[feature_sets][std::size_t(Update::count)];
  /// Adds the wind on the triangles between this row and the next to f[0] and f[1].
  Function wind;
  int lanes;
  const char* target;
};

template <class R>
RowSweeps<R> row_sweeps();

inline constexpr int widest_vector = 64;  ///< bytes; arrays are aligned to it

}  // namespace tyglab::cpu
