// What took long to find out of a device (built programs, measured times), kept on disk from run to run: in
// XDG_CACHE_HOME/tyglab, or ~/.cache/tyglab. What cannot be read or written is as if it were not there.
#pragma once

#include <string>

namespace tyglab::opencl {

/// What was kept under that key, which says all that it depends on (device, driver, options, text); empty if nothing
/// was.
std::string kept_on_disk(const std::string& key);
void keep_on_disk(const std::string& key, const std::string& content);

}  // namespace tyglab::opencl
