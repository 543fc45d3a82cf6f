#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include "tests/support/devices.h"

int main(int argc, char** argv) {
  tyglab::test::probe_drivers_in_child();
  return doctest::Context(argc, argv).run();
}
