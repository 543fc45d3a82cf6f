// `tyglab bench throughput --beside-load` as a process: valid rows, whatever the times are.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "tests/support/files.h"

namespace tyglab::throughput_test {

TEST_CASE("throughput beside load pairs one thread with several at every size") {
  const test::TemporaryFolder folder;
  const auto outcome = test::tyglab(folder.path(), {"bench", "throughput", "--quick", "--beside-load", "--repeats", "1",
                                                    "--threads", "2", "--json", "-"});
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  const auto all = nlohmann::json::parse(outcome.out);
  CHECK(all["benchmark"] == "throughput");
  const int busy = all["machine"]["cores"].get<int>() - 1;
  const auto& rows = all["runs"];
  REQUIRE(rows.size() == 6);
  for (std::size_t n = 0; n < rows.size(); ++n) {
    const auto& row = rows[n];
    CAPTURE(row.dump());
    for (const char* number : {"ns_per_particle_step", "ns_lowest", "ns_highest", "bytes_per_particle"})
      CHECK(row[number] > 0.0);
    CHECK(row["engine"] == "cpu");
    CHECK(row["beside_load"] == busy);
    CHECK(row["repeats"] == 1);
    CHECK(row["rows"] == rows[n / 2 * 2]["rows"]);
    // A cloth of 32 x 32 is too small for two.
    CHECK(row["threads"] == (n % 2 == 1 && row["rows"] > 32 ? 2 : 1));
    CHECK(row["over_register_limit"].is_null());
    if (n % 2 == 0)
      CHECK(row["over_one_thread"] == 1);
    else
      CHECK(row["over_one_thread"] > 0.0);
  }
  CHECK(rows[0]["rows"] == 32);
  CHECK(rows[5]["rows"] == 512);

  const auto refused = test::tyglab(folder.path(), {"bench", "throughput", "--beside-load", "--png", "picture.png"});
  CHECK(refused.code == 2);
  CHECK(refused.err.find("--beside-load") != std::string::npos);
}

}  // namespace tyglab::throughput_test
