#include "core/integrators/stabilized.h"

#include <cmath>

namespace tyglab {
namespace {

/// A number as the sum of two doubles of which the second is below half a unit in the last place of the first: some 104
/// bits (T. J. Dekker, Numerische Mathematik 18, 1971). The compiler must not contract products and sums.
struct DoubleDouble {
  double high = 0, low = 0;
};

/// high + low, where |high| >= |low|.
DoubleDouble normalized(double high, double low) {
  const double sum = high + low;
  return {sum, low - (sum - high)};
}

/// a + b, exactly.
DoubleDouble exact_sum(double a, double b) {
  const double sum = a + b, of_b = sum - a;
  return {sum, (a - (sum - of_b)) + (b - of_b)};
}

/// The upper 26 bits of a.
double upper_half(double a) {
  constexpr double split = 134217729;  // 2^27 + 1
  const double shifted = split * a;
  return shifted - (shifted - a);
}

/// a b, exactly.
DoubleDouble exact_product(double a, double b) {
  const double product = a * b, a1 = upper_half(a), b1 = upper_half(b), a2 = a - a1, b2 = b - b1;
  return {product, ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2};
}

DoubleDouble operator*(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble product = exact_product(a.high, b.high);
  return normalized(product.high, product.low + (a.high * b.low + a.low * b.high));
}

DoubleDouble operator/(DoubleDouble a, double b) {
  const double quotient = a.high / b;
  const DoubleDouble back = exact_product(quotient, b);
  return normalized(quotient, ((a.high - back.high) - back.low + a.low) / b);
}

/// a - b.
DoubleDouble difference(double a, DoubleDouble b) {
  const DoubleDouble rough = exact_sum(a, -b.high);
  return normalized(rough.high, rough.low - b.low);
}

}  // namespace

Decay decay_over(double x) {
  constexpr double nothing_left = 746;  // e^-746 is below the smallest double
  if (!(x < nothing_left)) return {0, 1};
  constexpr int terms = 14;  // of the series, for x <= 1/64: the rest is below 2^-120
  int doublings = 0;
  for (; x > 1.0 / 64; x /= 2) ++doublings;
  // 1 - e^-x = x (1 - x/2 (1 - x/3 (…)))
  DoubleDouble series{1, 0};
  for (int n = terms; n >= 2; --n) series = difference(1, DoubleDouble{x, 0} * series / n);
  DoubleDouble lost = DoubleDouble{x, 0} * series, kept = difference(1, lost);
  for (; doublings > 0; --doublings) {
    lost = lost * difference(2, lost);  // 1 - e^-2x = (1 - e^-x)(2 - (1 - e^-x))
    kept = kept * kept;
  }
  return {kept.high, lost.high};
}

}  // namespace tyglab
