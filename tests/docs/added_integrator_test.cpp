// The method that docs/adding-an-integrator.md adds is there, in this program alone: it is compiled with the page's
// table. order_test.cpp, compiled beside this file, holds its order with those of all others.
#include <doctest/doctest.h>

#include "core/integrators/scheme.h"
#include "core/integrators/stabilized.h"
#include "core/io/preset_io.h"
#include "core/theory/modes.h"
#include "tests/support/scenes.h"

namespace tyglab::added_integrator_test {

TEST_CASE("the method of the page is in the table, and what is said to follow from it does") {
  REQUIRE(is_integrator("explicit_midpoint"));
  CHECK(integrators_markdown().find("\n## explicit_midpoint\n") != std::string::npos);
  CHECK(parse_preset(R"({"tyglab_preset": 1, "solver": {"integrator": "explicit_midpoint"}})", "page").integrator ==
        "explicit_midpoint");
  // Growth by (hω)⁴/8 a step, as the row says.
  const double h = 0.1;
  CHECK(spectral_radius(amplification(scheme("explicit_midpoint"), h, 0)) - 1 ==
        doctest::Approx(h * h * h * h / 8).epsilon(0.01));
}

}  // namespace tyglab::added_integrator_test
