// What a slider's tooltip says of stability.
#include <doctest/doctest.h>

#include <limits>

#include "app/ui/constants/constants_panel.h"
#include "core/integrators/scheme.h"

namespace tyglab::zone_words_test {

StabilityLimits limits_with(std::vector<ZoneSpan> zones, double k_s, const char* method = "verlet") {
  StabilityLimits limits;
  limits.of.integrator = method, limits.of.k_s = k_s, limits.of.dt = 0.0115;
  limits.any = is_implicit(scheme(method)) ? std::numeric_limits<double>::infinity() : 0.01;
  limits.every = 3 * limits.any, limits.now = 0.0125;
  limits.zones.emplace("k_s", std::move(zones));
  return limits;
}

TEST_CASE("it says in which zone the value is, by how much, and where all zones lie") {
  const std::vector<ZoneSpan> usual{
      {0, 133.3, Zone::stable}, {133.3, 1600, Zone::depends}, {1600, 1e6, Zone::unstable}};
  const std::string part = ": dt is 115 % of the worst-case limit, 92 % of this cloth's as it hangs now.\n",
                    where =
                        "Verlet at this dt, as k_s grows: stable in any shape up to 133 N/m, depends on the shape up "
                        "to 1600 N/m, unstable in every shape above that.";
  CHECK(zone_words(limits_with(usual, 180), "k_s", "N/m") == "Depends on the shape" + part + where);
  CHECK(zone_words(limits_with(usual, 50), "k_s", "N/m") == "Stable in any shape" + part + where);
  CHECK(zone_words(limits_with(usual, 5000), "k_s", "N/m") == "Unstable in every shape" + part + where);
}

TEST_CASE("where one zone is all there is, it says so") {
  StabilityLimits limits = limits_with({{0, 1e6, Zone::unstable}}, 50);
  limits.any = limits.every = 0;  // Euler's, without damping
  CHECK(zone_words(limits, "k_s", "N/m") ==
        "Unstable in every shape.\nVerlet at this dt: unstable in every shape, whatever k_s is.");
}

TEST_CASE("of a mass on a spring it speaks of no shape") {
  StabilityLimits limits = limits_with({}, 50);
  limits.of.kind = Kind::one_weight, limits.of.k = 2;
  limits.zones.emplace("k", std::vector<ZoneSpan>{{0, 4, Zone::stable}, {4, 1e6, Zone::unstable}});
  CHECK(zone_words(limits, "k", "N/m") ==
        "Stable: dt is 115 % of the limit.\nVerlet at this dt, as k grows: stable up to 4 N/m, unstable above that.");
}

TEST_CASE("it says of rest lengths that they move no limit") {
  StabilityLimits limits = limits_with({}, 50);
  limits.zones.emplace("L", std::vector<ZoneSpan>{{1e-3, 1e3, Zone::depends}});
  const std::string words = zone_words(limits, "L", "m");
  CHECK(
      words.ends_with("Verlet at this dt: depends on the shape, whatever L is: the largest frequency does not depend "
                      "on rest lengths."));
}

TEST_CASE("it says nothing of constants without zones, and nothing where nothing breaks") {
  CHECK(zone_words(limits_with({{0, 1e6, Zone::stable}}, 50, "implicit_euler"), "k_s", "N/m").empty());
  CHECK(zone_words(limits_with({{0, 1e6, Zone::stable}}, 50), "g", "m/s²").empty());
}

}  // namespace tyglab::zone_words_test
