// Exponential decay with identical bits on every system.
#pragma once

namespace tyglab {

/// What an exponential decay keeps and loses, as shares of 1.
struct Decay {
  double kept = 1;  ///< e^-x
  double lost = 0;  ///< 1 - e^-x, with all its digits where x is small
};

/// The decay over x >= 0, the time divided by the time constant. Both shares are rounded correctly, but for ties within
/// 2^-80 of their values, by additions and multiplications alone: std::exp and std::expm1 differ in their last bit
/// between the C libraries of Linux, Windows and browsers.
Decay decay_over(double x);

}  // namespace tyglab
