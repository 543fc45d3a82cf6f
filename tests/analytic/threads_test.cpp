// Springs along rows (weft), down columns (warp) and across (shear) with constants of their own.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/engines/plain/plain_cloth.h"
#include "core/forces/force.h"
#include "core/integrators/scheme.h"
#include "core/io/preset_io.h"
#include "core/model/notation.h"
#include "core/theory/advice.h"
#include "core/theory/modes.h"
#include "tests/support/scenes.h"

namespace tyglab::threads_test {

TEST_CASE("an evenly stretched cloth holds ½ k (s − 1)² L² in each spring along, down and twice that across") {
  Preset preset = test::quiet_cloth(5, 8);
  preset.k_weft = 30, preset.k_warp = 90, preset.k_shear = 7, preset.initial_stretch = 1.2;
  Simulation simulation(preset);
  simulation.enable_ledger(true);
  const double each = 0.2 * 0.2 * preset.L * preset.L / 2;
  const double wanted = each * (30 * 5 * 7 + 90 * 4 * 8 + 7 * 2 * 2 * 4 * 7);
  CHECK(simulation.ledger()->energy.of[force::stretch] / wanted == doctest::Approx(1).epsilon(1e-12));
}

TEST_CASE("constants of their own that are k_s change no bit in any method") {
  for (const Scheme& method : schemes())
    for (const Precision precision : {Precision::float_, Precision::double_}) {
      CAPTURE(std::string(method.name));
      Preset preset = test::cloth(11, 9, std::string(method.name));
      preset.precision = precision, preset.F_max = 0.3;
      Preset own = preset;
      own.k_warp = own.k_weft = own.k_shear = preset.k_s;
      Simulation one(preset), other(own);
      one.advance(60), other.advance(60);
      CHECK(test::identical(one.read(), other.read()));
      own.k_shear /= 3;
      Simulation softer(own);
      softer.advance(60);
      CHECK_FALSE(test::identical(one.read(), softer.read()));
    }
}

TEST_CASE("implicit methods agree on warp, weft and diagonals of their own, soft or stiff, and without diagonals") {
  for (const double k : {30.0, 3e4})
    for (const double shear : {0.0, 0.1}) {
      Preset preset = test::cloth(12, 11, "implicit_euler");
      preset.k_warp = 2 * k, preset.k_weft = k, preset.k_shear = shear * k, preset.dt = 5e-3, preset.iterations = 1000;
      const State start = test::crumpled(preset, 4, 0.2, 0.3);
      const auto stepped = [&](const char* method) {
        Preset p = preset;
        p.integrator = method;
        Simulation simulation(p);
        test::load(simulation, start);
        simulation.advance(1);
        return simulation.read();
      };
      const State newton = stepped("implicit_euler");
      CAPTURE(k);
      CAPTURE(shear);
      double moved = 0;
      for (std::size_t p = 0; p < start.x.x.size(); ++p)
        moved = std::max(moved, glm::distance(test::position(start, p), test::position(newton, p)));
      plain::Vector x(start.x.x.size()), v(x.size());
      for (std::size_t p = 0; p < x.size(); ++p) x[p] = test::position(newton, p), v[p] = test::velocity(newton, p);
      const plain::Vector F = plain::forces(preset, Tears(lattice_of(preset)), x, v);
      const auto pinned = pinned_particles(preset);
      double left = 0, most = 0;
      for (std::size_t p = 0; p < x.size(); ++p) {
        if (pinned[p] != 0) continue;
        const glm::dvec3 change = v[p] - test::velocity(start, p);
        left = std::max(left, glm::length(change - preset.dt / preset.m * F[p])),
        most = std::max(most, glm::length(change));
      }
      CHECK(left < 1e-4 * most);
      if (k > 1e3) continue;  // the others need many more passes
      for (const char* method : {"vbd", "projective_dynamics"}) {
        const State other = stepped(method);
        double apart = 0;
        for (std::size_t p = 0; p < start.x.x.size(); ++p)
          apart = std::max(apart, glm::distance(test::position(other, p), test::position(newton, p)));
        CHECK(apart < 1e-3 * moved);
      }
    }
}

TEST_CASE("the largest eigenvalue of the springs is that of k_s where all are alike, and above any wave's") {
  Preset preset = test::quiet_cloth(16, 16);
  CHECK(any_configuration(preset).stiffness == 12 * preset.k_s / preset.m);
  for (const auto& [weft, warp, shear] : {std::array{1.0, 2.0, 3.0}, {5.0, 4.0, 0.0}, {0.0, 10.0, 1.0}}) {
    const SpringConstants k{weft, warp, shear, 0};
    double most = 0;
    for (double a = 0; a < 1.58; a += 0.02)
      for (double b = 0; b < 1.58; b += 0.02)
        most = std::max(most, 4 * weft * std::pow(std::sin(a), 2) + 4 * warp * std::pow(std::sin(b), 2) +
                                  4 * shear * (std::pow(std::sin(a + b), 2) + std::pow(std::sin(a - b), 2)));
    CHECK(most <= k.largest_stretch_eigenvalue());
    CHECK(most > 0.999 * k.largest_stretch_eigenvalue());
  }
  preset.k_warp = 4 * preset.k_s;
  CHECK(stable_dt(preset, "verlet") / stable_dt(test::quiet_cloth(16, 16), "verlet") ==
        doctest::Approx(std::sqrt(12.0 / 24)));
}

TEST_CASE("files leave out what is as k_s, and read k_s in its place; no number stands for that") {
  Preset preset = test::cloth(4, 4);
  CHECK(preset_to_json(preset).find("k_warp") == std::string::npos);
  preset.k_warp = 0, preset.k_shear = 12.5;
  const std::string text = preset_to_json(preset);
  CHECK(text.find("\"k_warp\": 0") != std::string::npos);
  CHECK(text.find("k_weft") == std::string::npos);
  CHECK(parse_preset(text, "a test") == preset);
  const auto set = [&](const char* key, const char* value) {
    return with_parsed_settings(preset, {{std::string(key) + "=" + value, key, value}});
  };
  CHECK(set("k_warp", "k_s").k_warp == left_out);
  CHECK(set("k_weft", "0").k_weft == 0);
  for (const char* wrong : {"-1", "k_b", "true"}) {
    CAPTURE(std::string(wrong));
    CHECK_THROWS_AS(set("k_warp", wrong), PresetError);
  }
  CHECK(check_preset(preset).empty());
  CHECK(nearest_allowed(Preset{}).k_warp == left_out);
  const auto settings = settings_between(preset, Preset{});
  CHECK(std::find(settings.begin(), settings.end(), "k_warp=k_s") != settings.end());
}

TEST_CASE("a finer cloth keeps them") {
  Preset preset = test::cloth(9, 9);
  preset.k_warp = 70, preset.k_shear = 3;
  const Preset fine = with_resolution(preset, 2);
  CHECK(fine.k_warp == 70);
  CHECK(fine.k_shear == 3);
  CHECK(fine.k_weft == left_out);
  CHECK(with_resolution(preset, 2).air_density == preset.air_density);
}

}  // namespace tyglab::threads_test
