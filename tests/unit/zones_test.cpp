// Zones of stability along a constant.
#include "core/theory/zones.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/integrators/scheme.h"
#include "core/theory/advice.h"
#include "core/theory/modes.h"
#include "tests/support/scenes.h"

namespace tyglab::zones_test {

Preset undamped(const char* method) {
  Preset preset = test::cloth(8, 8, method);
  preset.k_s = 50, preset.k_b = 5, preset.k_d = 0, preset.m = 3e-4, preset.dt = 1e-3;
  return preset;
}

/// Where a zone begins.
double begins(const std::vector<ZoneSpan>& zones, Zone zone) {
  const auto at = std::find_if(zones.begin(), zones.end(), [&](const ZoneSpan& z) { return z.zone == zone; });
  REQUIRE(at != zones.end());
  return at->from;
}

/// The zones in their order.
std::vector<Zone> order(const std::vector<ZoneSpan>& zones) {
  std::vector<Zone> all;
  for (const ZoneSpan& span : zones) all.push_back(span.zone);
  return all;
}

const std::vector<Zone> three{Zone::stable, Zone::depends, Zone::unstable};

TEST_CASE("without damping Verlet is stable in any shape while dt² (12 k_s + 8 k_b)/m < 4, and in none above 4 m/k_s") {
  const Preset p = undamped("verlet");
  CHECK(zone_of(p) == Zone::stable);
  const double top = 4 * p.m / (p.dt * p.dt);
  const auto k_s = stability_zones(p, &Preset::k_s, 0.05, 5e4);
  CHECK(begins(k_s, Zone::depends) == doctest::Approx((top - 8 * p.k_b) / 12).epsilon(2e-3));
  CHECK(begins(k_s, Zone::unstable) == doctest::Approx(top).epsilon(2e-3));
  const auto k_b = stability_zones(p, &Preset::k_b, 0.05, 5e4);
  CHECK(begins(k_b, Zone::depends) == doctest::Approx((top - 12 * p.k_s) / 8).epsilon(2e-3));
  CHECK(k_b.back().zone == Zone::depends);  // bending springs need not push, and k_s alone is soft enough
  const auto dt = stability_zones(p, &Preset::dt, 1e-6, 1);
  CHECK(order(dt) == three);
  CHECK(begins(dt, Zone::depends) == doctest::Approx(stable_dt(p, "verlet")).epsilon(2e-3));
  CHECK(begins(dt, Zone::unstable) == doctest::Approx(2 * std::sqrt(p.m / p.k_s)).epsilon(2e-3));
  CHECK(every_shape_limit(p) == doctest::Approx(2 * std::sqrt(p.m / p.k_s)).epsilon(2e-3));
  const auto m = stability_zones(p, &Preset::m, 1e-7, 1);
  CHECK(m.front().zone == Zone::unstable);
  CHECK(m.front().to == doctest::Approx(p.dt * p.dt * p.k_s / 4).epsilon(2e-3));
  CHECK(m.back().from == doctest::Approx(p.dt * p.dt * (12 * p.k_s + 8 * p.k_b) / 4).epsilon(2e-3));
}

TEST_CASE("zones cover the span without gaps, and the present one is where the value lies") {
  const Preset p = undamped("verlet");
  const auto zones = stability_zones(p, &Preset::k_s, 0.05, 5e4);
  CHECK(order(zones) == three);
  CHECK(zones.front().from == 0);
  CHECK(zones.back().to == 5e4);
  for (std::size_t n = 1; n < zones.size(); ++n) CHECK(zones[n].from == zones[n - 1].to);
  for (const ZoneSpan& span : zones) {
    Preset there = p;
    there.k_s = std::max((span.from + span.to) / 2, 0.1);
    CHECK(zone_of(there) == span.zone);
  }
}

TEST_CASE("damping acts in every shape: 8 springs at a particle inside, 12 k_d/m in the worst mode") {
  Preset p = undamped("verlet");
  p.k_s = p.k_b = 1e-6, p.k_d = 0.01;
  CHECK(stable_dt(p, "verlet") == doctest::Approx(2 * p.m / (12 * p.k_d)).epsilon(2e-3));
  CHECK(every_shape_limit(p) == doctest::Approx(2 * p.m / (8 * p.k_d)).epsilon(2e-3));
  p.columns = 1;  // a thread: two springs at a particle
  CHECK(every_shape_limit(p) == doctest::Approx(2 * p.m / (2 * p.k_d)).epsilon(2e-3));
}

TEST_CASE("where damping alone is worse than damped stiffness, the worst case is the slack cloth") {
  Preset p = undamped("rk4");
  p.k_b = 0, p.k_d = std::sqrt(p.k_s * p.m / 3);  // critical at 12 k_s/m and 12 k_d/m
  constexpr double real_axis = 2.785;             // of Runge-Kutta 4
  CHECK(stable_dt(p, "rk4") == doctest::Approx(real_axis * p.m / (12 * p.k_d)).epsilon(2e-3));
  CHECK(dt_crit(scheme("rk4"), std::vector<Mode>{any_configuration(p)}) > 1.5 * stable_dt(p, "rk4"));
  const double verlet = dt_crit(scheme("verlet"), std::vector<Mode>{any_configuration(p)});
  CHECK(stable_dt(p, "verlet") == verlet);  // to the bit: more of either is worse for it
}

TEST_CASE("a method that is stable at no dt without damping is unstable in every shape there") {
  for (const char* method : {"euler", "improved_euler"}) {
    CHECK(every_shape_limit(undamped(method)) == 0);
    const auto zones = stability_zones(undamped(method), &Preset::dt, 1e-6, 1);
    REQUIRE(zones.size() == 1);
    CHECK(zones.front().zone == Zone::unstable);
  }
}

TEST_CASE("of a mass on a spring nothing depends on the shape") {
  Preset p = test::one_weight();
  for (const double k_d : {0.0, 0.1}) {
    p.k_d = k_d;
    const auto zones = stability_zones(p, &Preset::dt, 1e-6, 1e3);
    CHECK(order(zones) == std::vector<Zone>{Zone::stable, Zone::unstable});
    CHECK(every_shape_limit(p) == doctest::Approx(stable_dt(p, p.integrator)).epsilon(2e-3));
  }
  CHECK(zone_name(Zone::unstable, p.kind) == "unstable");
  CHECK(zone_name(Zone::unstable, Kind::cloth) == "unstable in every shape");
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

TEST_CASE("only constants that act have zones: k_s has none where each direction has its own") {
  Preset p = undamped("verlet");
  const auto has = [&](std::string_view key) {
    const auto zoned = zoned_constants(p);
    return std::count_if(zoned.begin(), zoned.end(), [&](const ZonedConstant& of) { return of.key == key; });
  };
  CHECK(has("k_s") == 1);
  CHECK(has("k_warp") == 0);
  p.k_warp = p.k_weft = 200;
  CHECK(has("k_s") == 1);
  CHECK(has("k_warp") == 1);
  p.k_shear = 10;
  CHECK(has("k_s") == 0);
  for (const char* key : {"dt", "k_warp", "k_weft", "k_shear", "k_b", "k_d", "m"}) CHECK(has(key) == 1);
}

TEST_CASE("methods without a limit are stable all along") {
  for (const char* method : {"implicit_euler", "tr_bdf2", "dopri5", "projective_dynamics", "vbd", "xpbd"}) {
    const auto zones = stability_zones(undamped(method), &Preset::k_s, 0.05, 1e9);
    REQUIRE(zones.size() == 1);
    CHECK(zones.front().zone == Zone::stable);
  }
}

TEST_CASE("working zones out ends soon once it is stopped, and takes a bounded number of borders") {
  for (const char* method : {"verlet", "rk4", "rkn4"}) {
    CAPTURE(std::string(method));
    Preset p = undamped(method);
    p.k_d = 0.002;
    int asked = 0;
    const auto whole = stability_zones(p, &Preset::dt, 1e-8, 1e4, [&] { return ++asked < 0; });
    CHECK(asked >= 40);
    CHECK(asked <= 40 * 9);
    CHECK(order(whole) == three);
    int until = 0;
    stability_zones(p, &Preset::dt, 1e-8, 1e4, [&] { return ++until > 0; });
    CHECK(until <= 2);
  }
}

}  // namespace tyglab::zones_test
