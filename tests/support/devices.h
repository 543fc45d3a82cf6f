// Whether there is an OpenCL device to test on.
#pragma once

namespace tyglab::test {

/// Asks drivers for their devices in a process of its own first, as the program does: pocl aborts where /sys is not
/// mounted. What crashes there counts as no device.
void probe_drivers_in_child();
bool device_there();
/// Skips the test case if there is none: `if (test::skipped_without_device()) return;`.
bool skipped_without_device();

}  // namespace tyglab::test
