// Figure 3.2 live: companions of the one weight that the report's other methods move, and its exact motion.
#pragma once

#include <array>
#include <memory>
#include <string_view>

#include "core/simulation.h"

namespace tyglab {

class Figure {
 public:
  /// The curves, in the colours of figure 3.2; the last is the closed form.
  static constexpr std::array<std::string_view, 4> curves{"euler", "improved_euler", "verlet", "exact"};
  static constexpr std::array<std::string_view, 4> titles{"Euler", "improved Euler", "Verlet", "exact"};
  using Heights = std::array<double, curves.size()>;

  /// Makes the steps that the weight has made since the last call, with its constants and dt, from where it began;
  /// returns y by each curve, m: not a number once a companion has diverged.
  Heights follow(Simulation& weight);
  void clear() { companions_ = {}; }

 private:
  void begin(Simulation& weight);
  void take_constants(const Preset& preset);

  std::array<std::unique_ptr<Simulation>, curves.size() - 1> companions_;
  Preset of_;  ///< the weight's constants as they were last seen
  std::int64_t steps_ = 0;
  double t_ = 0;        ///< s, of the last call
  Preset exact_;        ///< whose start is the exact motion's last start
  double exact_t_ = 0;  ///< s, when that was
};

}  // namespace tyglab
