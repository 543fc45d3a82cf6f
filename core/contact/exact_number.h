// Numbers without rounding, for the rare cases that floating point cannot decide.
#pragma once

#include <cstdint>
#include <vector>

namespace tyglab {

/// A binary fraction of any length: sums, differences and products of finite doubles, exact over their whole range.
class ExactNumber {
 public:
  ExactNumber() = default;
  /// `value` must be finite.
  explicit ExactNumber(double value);

  /// -1, 0 or 1.
  int sign() const { return limbs_.empty() ? 0 : negative_ ? -1 : 1; }

  friend ExactNumber operator+(const ExactNumber& a, const ExactNumber& b);
  friend ExactNumber operator-(const ExactNumber& a, const ExactNumber& b);
  friend ExactNumber operator*(const ExactNumber& a, const ExactNumber& b);

 private:
  using Limbs = std::vector<std::uint32_t>;

  /// The limbs as multiples of 2^(32·exponent), which may not exceed the number's own.
  Limbs limbs_from(int exponent) const;
  void trim();

  // ± Σ limbs[n]·2^(32·(n + exponent)), the last limb not 0.
  Limbs limbs_;
  int exponent_ = 0;
  bool negative_ = false;
};

}  // namespace tyglab
