// Names of files that are made of names that people give.
#include "app/base/files.h"

#include <doctest/doctest.h>

#include <string>

namespace tyglab::file_names_test {

TEST_CASE("letters lose their marks, and all that is no letter becomes one line") {
  CHECK(plain_file_name("Övning å, 2") == "ovning_a_2");
  CHECK(plain_file_name("Älg & Ærlig – straße") == "alg_arlig_strase");
  CHECK(plain_file_name("  Soft   cloth!  ") == "soft_cloth");
  CHECK(plain_file_name("O\u0308vning") == "ovning");  // a mark behind its letter
  CHECK(plain_file_name("Łódź") == "lodz");
  CHECK(plain_file_name("布").empty());
  CHECK(plain_file_name("布 2") == "2");
  CHECK(plain_file_name("..").empty());
  CHECK(plain_file_name("a\xff\xc3z") == "a_z");  // no UTF-8
}

}  // namespace tyglab::file_names_test
