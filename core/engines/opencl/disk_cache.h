// Built programs, kept on disk from run to run: in XDG_CACHE_HOME/tyglab, or ~/.cache/tyglab. What cannot be read or
// written is as if it were not there.
#pragma once

#include <string>

namespace tyglab::opencl {

/// What was kept under that key (device, driver, options, text); empty if nothing was.
std::string cached_program(const std::string& key);
void cache_program(const std::string& key, const std::string& binary);

}  // namespace tyglab::opencl
