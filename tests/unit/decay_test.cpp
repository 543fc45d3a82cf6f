// The exponential decay against the C library's in a wider type.
#include "core/integrators/stabilized.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/scenes.h"

namespace tyglab::decay_test {

/// How far `value` is from `exact`, in units of value's last place.
double units(double value, long double exact) {
  const double place = std::nextafter(value, std::numeric_limits<double>::infinity()) - value;
  return double(std::abs((long double)value - exact) / place);
}

TEST_CASE("both shares of a decay are rounded correctly, as far as 64 bits can tell") {
  static_assert(std::numeric_limits<long double>::digits >= 64);
  // The wider function may itself be off by a unit of its last place, which is 2^-11 of ours.
  const double most = 0.5 + std::pow(2.0, -10);
  test::Random random(5);
  double worst_kept = 0, worst_lost = 0;
  for (int n = 0; n < 20000; ++n) {
    const double x = std::pow(10.0, random.uniform(-12, 2.5));
    const Decay decay = decay_over(x);
    worst_kept = std::max(worst_kept, units(decay.kept, std::exp(-(long double)x)));
    worst_lost = std::max(worst_lost, units(decay.lost, -std::expm1(-(long double)x)));
  }
  CHECK(worst_kept <= most);
  CHECK(worst_lost <= most);
  CHECK(std::max(worst_kept, worst_lost) > 0.49);  // so that a measure which always says 0 is seen
}

TEST_CASE("the ends of the range of decays") {
  CHECK(decay_over(0).kept == 1);
  CHECK(decay_over(0).lost == 0);
  CHECK(decay_over(1e-300).lost == 1e-300);
  CHECK(decay_over(1e-300).kept == 1);
  for (const double x : {746.0, 1e300, std::numeric_limits<double>::infinity()}) {
    CHECK(decay_over(x).kept == 0);
    CHECK(decay_over(x).lost == 1);
  }
  CHECK(decay_over(745).kept > 0);
}

}  // namespace tyglab::decay_test
