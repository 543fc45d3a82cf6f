// `tyglab stability boundary` finds where each explicit method becomes unstable on the taut sheet, where motion is
// linear, and compares the running code with the prediction of linear theory (frequency.h). docs/model.md defines
// unstable: in double, a seeded perturbation of 1e-9 m grows by a factor of 1e5 within 4,000 steps.
#pragma once

#include <string>
#include <vector>

#include "core/analysis/frequency.h"
#include "core/model/preset.h"

namespace tyglab {

inline constexpr double perturbation = 1e-9;  ///< m, root mean square
inline constexpr double growth_that_counts = 1e5;
inline constexpr int steps_that_count = 4000;

/// The taut sheet with that many particles a side: stretched by a tenth over a frame, no gravity, in double.
Preset taut_sheet(int side, double k_s, double k_d, const std::string& integrator);
/// k_d (N s/m) that gives the fastest wave of a taut sheet this ζ.
double damping_for(const Preset& sheet, double zeta);

/// Whether the method is unstable on that sheet. The preset's precision must be double.
bool unstable(const Preset& sheet);

/// One measured limit or growth.
struct BoundaryRow {
  Preset preset;         ///< with the measured dt or k_s
  double predicted = 0;  ///< s, N/m or 1/step
  double measured = 0;
  double any_configuration = 0;  ///< slack scenes: dt by the bound that holds for any configuration, s
  double ratio() const { return measured / predicted; }
};

/// Bisects dt between stable and unstable at the preset's k_s.
BoundaryRow measure_dt(const Preset& sheet);
/// Bisects k_s at the preset's dt.
BoundaryRow measure_k_s(const Preset& sheet);
/// Growth per step (a natural logarithm) of a perturbation in the long run, at the preset's dt, which lets it grow.
BoundaryRow measure_growth(const Preset& sheet);

/// The hanging cloth of `side` x `side`, undamped or not, in double.
Preset slack_cloth(int side, double k_d, const std::string& integrator);
/// Bisects the dt at which it diverges (docs/model.md) within that many steps; predicted as it hangs after 2 s.
BoundaryRow measure_slack(const Preset& cloth, int steps);

/// Everything that `stability boundary` measures.
struct BoundaryCases {
  std::vector<Preset> dt, k_s, growth, slack;
  int slack_steps = 0;  ///< after which a run on a slack scene counts as bounded
};
BoundaryCases boundary_cases(bool quick);

}  // namespace tyglab
