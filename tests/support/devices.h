// Whether there is an OpenCL device to test on.
#pragma once

namespace tyglab::test {

bool device_there();
/// Skips the test case if there is none: `if (test::skipped_without_device()) return;`.
bool skipped_without_device();

}  // namespace tyglab::test
