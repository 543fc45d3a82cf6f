// Zones of stability along a constant.
#include "core/theory/zones.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/theory/advice.h"
#include "tests/support/scenes.h"

namespace tyglab::zones_test {

Preset undamped(const char* method) {
  Preset preset = test::cloth(8, 8, method);
  preset.k_s = 50, preset.k_b = 5, preset.k_d = 0, preset.m = 3e-4, preset.dt = 1e-3;
  return preset;
}

/// Where the zone becomes unstable.
double breaks_at(const std::vector<ZoneSpan>& zones) {
  const auto at = std::find_if(zones.begin(), zones.end(), [](const ZoneSpan& z) { return z.zone == Zone::unstable; });
  REQUIRE(at != zones.end());
  return at->from;
}

TEST_CASE("without damping Verlet breaks where dt² (12 k_s + 8 k_b)/m is 4, along every constant") {
  const Preset p = undamped("verlet");
  CHECK(zone_of(p) == Zone::stable);
  const double top = 4 * p.m / (p.dt * p.dt);
  CHECK(breaks_at(stability_zones(p, &Preset::k_s, 0.05, 5e4)) ==
        doctest::Approx((top - 8 * p.k_b) / 12).epsilon(2e-3));
  CHECK(breaks_at(stability_zones(p, &Preset::k_b, 0.05, 5e4)) ==
        doctest::Approx((top - 12 * p.k_s) / 8).epsilon(2e-3));
  CHECK(breaks_at(stability_zones(p, &Preset::dt, 1e-6, 1)) == doctest::Approx(stable_dt(p, "verlet")).epsilon(2e-3));
  const auto masses = stability_zones(p, &Preset::m, 1e-7, 1);
  CHECK(masses.front().zone == Zone::unstable);
  CHECK(masses.front().to == doctest::Approx(p.dt * p.dt * (12 * p.k_s + 8 * p.k_b) / 4).epsilon(2e-3));
}

TEST_CASE("zones cover the span without gaps, stable, near, unstable") {
  const Preset p = undamped("verlet");
  const auto zones = stability_zones(p, &Preset::k_s, 0.05, 5e4);
  REQUIRE(zones.size() == 3);
  CHECK(zones[0].from == 0);
  CHECK(zones[2].to == 5e4);
  for (std::size_t n = 1; n < zones.size(); ++n) CHECK(zones[n].from == zones[n - 1].to);
  CHECK(zones[1].zone == Zone::near);
  // dt is 0.9 of the limit where k is 0.81 of what it breaks at.
  const double top = 4 * p.m / (p.dt * p.dt);
  CHECK(zones[1].from == doctest::Approx((0.81 * top - 8 * p.k_b) / 12).epsilon(3e-3));
}

TEST_CASE("rest lengths move no limit: one zone, that of the other constants") {
  Preset p = undamped("verlet");
  for (const double k_s : {p.k_s, 4 * p.m / (p.dt * p.dt)}) {
    p.k_s = k_s;
    const auto zones = stability_zones(p, &Preset::L, 1e-4, 10);
    REQUIRE(zones.size() == 1);
    CHECK(zones.front().zone == zone_of(p));
  }
}

TEST_CASE("damping that heals Euler, and too much of it, both show") {
  Preset p = undamped("euler");
  p.dt = 1e-4;
  const auto zones = stability_zones(p, &Preset::k_d, 1e-6, 10);
  CHECK(zones.front().zone == Zone::unstable);
  CHECK(zones.back().zone == Zone::unstable);
  CHECK(std::any_of(zones.begin(), zones.end(), [](const ZoneSpan& z) { return z.zone == Zone::stable; }));
}

TEST_CASE("methods without a limit are stable all along") {
  for (const char* method : {"implicit_euler", "tr_bdf2", "dopri5", "xpbd"}) {
    const auto zones = stability_zones(undamped(method), &Preset::k_s, 0.05, 1e9);
    REQUIRE(zones.size() == 1);
    CHECK(zones.front().zone == Zone::stable);
  }
}

}  // namespace tyglab::zones_test
