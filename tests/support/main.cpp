#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#ifdef TYGLAB_ADDRESS_SANITIZED
#include <sanitizer/lsan_interface.h>
#endif

#include "tests/support/devices.h"

int main(int argc, char** argv) {
  tyglab::test::probe_drivers_in_child();
  const int code = doctest::Context(argc, argv).run();
#ifdef TYGLAB_ADDRESS_SANITIZED
  // Not at the end of the process, when LeakSanitizer has crashed among threads of OpenCL drivers that were ending too.
  __lsan_do_leak_check();
#endif
  return code;
}
