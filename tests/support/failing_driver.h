// How a test tells the layer of the OpenCL loader that lets drivers fail (failing_driver.cpp).
#pragma once

#include <cstdint>

extern "C" {
/// Calls are counted from now on, and fail from the n-th on; n = 0: none fails. Of the layer, which the loader has in
/// memory: to be found by its name.
void tyglab_fail_driver_from(std::int64_t n);
/// Since then.
std::int64_t tyglab_driver_calls();
}

namespace tyglab::test {

/// The same through the loader; without the layer nothing fails, and nothing is counted.
bool driver_layer_loaded();
void fail_driver_from(std::int64_t n);
std::int64_t driver_calls();

}  // namespace tyglab::test
