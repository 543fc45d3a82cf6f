#include "app/base/files.h"

#include <doctest/doctest.h>
#include <chrono>

#include "tests/support/files.h"

namespace tyglab::file_stamp_test {

TEST_CASE("a file's stamp changes with its content, and one that is not there has none") {
  const test::TemporaryFolder folder;
  CHECK_FALSE(stamp_of(folder / "a.png").has_value());
  CHECK_FALSE(stamp_of(folder.path()).has_value());
  test::write_file(folder / "a.png", "one");
  const auto first = stamp_of(folder / "a.png");
  REQUIRE(first.has_value());
  CHECK(stamp_of(folder / "a.png") == first);
  test::write_file(folder / "b.png", "one");
  CHECK(stamp_of(folder / "b.png") != first);
  test::write_file(folder / "a.png", "four");
  CHECK(stamp_of(folder / "a.png") != first);
  // As long as before, later.
  test::write_file(folder / "a.png", "two");
  std::filesystem::last_write_time(folder / "a.png", first->written + std::chrono::seconds(1));
  CHECK(stamp_of(folder / "a.png") != first);
}

}  // namespace tyglab::file_stamp_test
