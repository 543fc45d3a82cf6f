// What a slider's tooltip says of stability.
#include <doctest/doctest.h>

#include <limits>

#include "app/ui/constants/zones.h"
#include "core/integrators/scheme.h"

namespace tyglab::zone_words_test {

StabilityLimits limits_with(std::vector<ZoneSpan> zones, double k_s, const char* method = "verlet") {
  StabilityLimits limits;
  limits.of.integrator = method, limits.of.k_s = k_s;
  limits.any = is_implicit(scheme(method)) ? std::numeric_limits<double>::infinity() : 0.01;
  limits.zones.emplace("k_s", std::move(zones));
  return limits;
}

TEST_CASE("it says where the method breaks, or where it would hold") {
  const std::vector<ZoneSpan> usual{{0, 80, Zone::stable}, {80, 92.71, Zone::near}, {92.71, 1e6, Zone::unstable}};
  CHECK(zone_words(limits_with(usual, 50), "k_s", "N/m") ==
        "Verlet is unstable above k_s = 92.7 N/m at this dt; implicit Euler is not.");
  CHECK(zone_words(limits_with(usual, 85), "k_s", "N/m").find("is unstable above k_s = 92.7 N/m") != std::string::npos);
  CHECK(zone_words(limits_with(usual, 200), "k_s", "N/m") ==
        "Verlet is unstable here; it is stable below k_s = 92.7 N/m.");
  const std::vector<ZoneSpan> from_below{{0, 3, Zone::unstable}, {3, 1e6, Zone::stable}};
  CHECK(zone_words(limits_with(from_below, 50), "k_s", "N/m").find("is unstable below k_s = 3 N/m") !=
        std::string::npos);
  CHECK(zone_words(limits_with(from_below, 1), "k_s", "N/m") ==
        "Verlet is unstable here; it is stable above k_s = 3 N/m.");
  CHECK(zone_words(limits_with({{0, 1e6, Zone::unstable}}, 50), "k_s", "N/m") ==
        "Verlet is unstable here, whatever k_s is.");
}

TEST_CASE("it says of rest lengths that they move no limit") {
  const auto words = [](Zone zone) {
    StabilityLimits limits;
    limits.of.integrator = "verlet";
    limits.zones.emplace("L", std::vector<ZoneSpan>{{1e-3, 1e3, zone}});
    return zone_words(limits, "L", "m");
  };
  CHECK(words(Zone::stable) ==
        "Verlet is stable at this dt, whatever L is: the largest frequency does not depend on rest lengths.");
  CHECK(words(Zone::unstable) ==
        "Verlet is unstable here, whatever L is: the largest frequency does not depend on rest lengths.");
}

TEST_CASE("it says nothing of constants without zones, and nothing where nothing breaks") {
  CHECK(zone_words(limits_with({{0, 1e6, Zone::stable}}, 50, "implicit_euler"), "k_s", "N/m").empty());
  CHECK(zone_words(limits_with({{0, 1e6, Zone::stable}}, 50), "g", "m/s²").empty());
}

}  // namespace tyglab::zone_words_test
