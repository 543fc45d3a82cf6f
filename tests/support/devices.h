// Whether there is an OpenCL device to test on.
#pragma once

namespace tyglab::test {

/// Says plainly, once a program, where there is none.
bool device_there();

}  // namespace tyglab::test
