// The fastest oscillation of the cloth in its present shape, and hence the stability limit of a method. The linearized
// force F = -K δx - C δv has the springs that act at present, with exact derivatives; pinned and held particles are
// fixed. The Lanczos method finds the extreme modes from products with K and C (stiffness.h).
#pragma once

#include <vector>

#include "core/forces/linear_springs.h"
#include "core/model/preset.h"
#include "core/simd/row_field.h"
#include "core/simulation.h"
#include "core/theory/modes.h"

namespace tyglab {

/// The accuracy required of a mode: |A u - λ u| over the largest λ. λ itself is then better by about as much again.
inline constexpr double live_tolerance = 2e-2;
inline constexpr double exact_tolerance = 1e-5;

/// The cloth's K and C as it stands, over its mass.
class Linearisation {
 public:
  /// Its modes throw Stopped soon after `stop` says so.
  explicit Linearisation(const Simulation& simulation, Stop stop = {});

  /// The mode in which `stiffness`·K + `damping`·C is largest; stiffness >= 0.
  Mode extreme(double stiffness, double damping, double tolerance) const;
  /// Its value alone for K or for C, which takes half the time.
  double largest_stiffness(double tolerance) const;
  double largest_damping(double tolerance) const;
  bool damped() const { return damped_; }

 private:
  using Field = simd::RowField<double>;
  struct Tridiagonal;
  void linearise(const Preset& preset, const Tears& tears, const LinearSprings<double>& springs, const Field& x,
                 int direction, int i);
  Array<double> combined(double stiffness, double damping) const;
  Field beginning() const;
  bool all_fixed() const { return int(fixed_.size()) == rows_ * columns_; }
  double iterate(const Array<double>& a, double tolerance, std::vector<double>& s) const;
  /// q = A p, 0 where particles are fixed; returns p·q.
  double multiply(const Array<double>& a, const Field& p, Field& q) const;
  bool next(const Array<double>& a, Field& before, Field& now, Field& product, Tridiagonal& t) const;
  double inner(const Field& a, const Field& b) const;

  Stop stop_;
  int rows_, columns_, stride_;
  bool damped_;
  Mode weight_;  ///< the mass on a spring's, which is no lattice
  bool lattice_;
  double curl_ = 0;             ///< what F_curl adds to K/m at most
  std::vector<int> fixed_;      ///< i·columns + j
  Array<double> coefficients_;  ///< of K/m, as in stiffness.h
  Array<double> damping_;       ///< k_d/m of every whole stretch spring; laid out as the coefficients' t
};

/// The extreme modes: the fastest first, and in a damped cloth those in which K and C weigh differently, down to the
/// most damped and the least. A method's worst mode is one of them or between two.
std::vector<Mode> extreme_modes(const Linearisation& cloth, double tolerance);
/// The fastest mode, with the largest damping of any mode: quicker, and safe for methods that damping makes less
/// stable.
Mode fastest_mode(const Linearisation& cloth, double tolerance);

}  // namespace tyglab
