// What a simulated second of a copy costs: its computing, and not what it waits for.
#include <doctest/doctest.h>

#include <chrono>
#include <thread>

#include "core/lockstep.h"
#include "tests/support/scenes.h"

namespace tyglab::copy_costs_test {

TEST_CASE("the cost of a copy counts no time in which its thread has no processor") {
  Simulation original(test::cloth(6, 6));
  Lockstep copies;
  copies.add(original, {});
  constexpr double slept_s = 0.3;
  double slept = 0;
  copies.stop_when([&] {
    if (slept == 0) std::this_thread::sleep_for(std::chrono::duration<double>(slept = slept_s));
    return false;
  });
  const double simulated = 4 * original.preset().dt;
  original.advance(4);
  copies.follow(original.time());
  REQUIRE(slept == slept_s);
  CHECK(copies[0].cost.per_second() > 0);
  CHECK(copies[0].cost.per_second() < slept_s / simulated);
}

}  // namespace tyglab::copy_costs_test
