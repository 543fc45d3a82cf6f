// `tyglab bench contact`: valid rows, whatever the times are, and the hash grid that it compares with.
#include "tests/bench/contact.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "core/contact/self_contact.h"
#include "core/simulation.h"
#include "tests/support/files.h"

namespace tyglab::contact_test {

TEST_CASE("bench contact: a row for each size") {
  const test::TemporaryFolder folder;
  const auto outcome = test::tyglab(folder.path(), {"bench", "contact", "--quick", "--json", "contact.json"});
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  const auto all = nlohmann::json::parse(test::read_file(folder / "contact.json"));
  CHECK(all["benchmark"] == "contact");
  REQUIRE(all["runs"].size() == 2);
  for (const auto& run : all["runs"]) {
    CAPTURE(run.dump());
    CHECK(run["rows"] == run["columns"]);
    for (const char* number : {"ns_off", "ns_apart", "ns_pile", "ns_hash_grid", "pairs_per_particle",
                               "bytes_apart_per_particle", "bytes_pile_per_particle"})
      CHECK(run[number] > 0.0);
  }
  const auto refused = test::tyglab(folder.path(), {"bench", "contact", "--quick", "--side", "9"});
  CHECK(refused.code == 2);
}

TEST_CASE("the hash grid of bench contact finds as many pairs as the lists, and the sheet is a pile") {
  const Preset preset = crumpling_sheet(24);
  Simulation pile(preset);
  pile.load(crumpling_start(preset));
  for (int look = 0; look < 4; ++look) {
    pile.advance(100);
    const State state = pile.read();
    std::vector<glm::dvec3> x;
    for (std::size_t p = 0; p < state.x.x.size(); ++p) x.emplace_back(state.x.x[p], state.x.y[p], state.x.z[p]);
    NearPairs lists(pile.lattice());
    lists.set_distances(preset.L, 0.4 * preset.L);
    lists.follow(pile.tears(), x);
    for (const double below : {0.2 * preset.L, 0.4 * preset.L}) {
      std::int64_t pairs = 0;
      lists.measure(below, x, [&](const auto&, const Gap&, double) { ++pairs; });
      CHECK(pairs == pairs_by_hash_grid(x, pile.lattice(), below));
      if (look == 3 && below > 0.3 * preset.L) CHECK(pairs > pile.lattice().size() / 10);
    }
  }
  CHECK_FALSE(pile.divergence());
}

}  // namespace tyglab::contact_test
