// Figure 3.2 live: companions of the mass on a spring that use the report's other methods, and its exact motion.
#pragma once

#include <array>
#include <memory>
#include <string_view>

#include "core/simulation.h"

namespace tyglab {

class ReferenceCurves {
 public:
  /// The curves, in the colors of figure 3.2; the last is the closed form.
  static constexpr std::array<std::string_view, 4> curves{"euler", "improved_euler", "verlet", "exact"};
  static constexpr std::array<std::string_view, 4> titles{"Euler", "improved Euler", "Verlet", "exact"};
  using Heights = std::array<double, curves.size()>;

  /// Makes the `steps` that the weight has just made, with its constants and dt, from where it began; returns y by each
  /// curve, m: not a number once a companion has diverged. Where the weight has moved unseen, its constants may have
  /// changed on the way: all begin again from where it is, or from its start where it has made no other steps.
  Heights follow(Simulation& weight, std::int64_t steps);
  void clear() { companions_ = {}; }

 private:
  void begin(const Simulation& weight, double y, double v, double t);
  void take_constants(const Preset& preset);

  std::array<std::unique_ptr<Simulation>, curves.size() - 1> companions_;
  Preset of_;  ///< the weight's constants as they were last seen
  std::int64_t steps_ = 0;
  double t_ = 0;        ///< s, of the last call
  Preset exact_;        ///< whose start is the exact motion's last start
  double exact_t_ = 0;  ///< s, when that was
};

}  // namespace tyglab
