// Describes the machine and the build of a measurement.
#pragma once

#include <string>

namespace tyglab {

struct Machine {
  std::string processor;        ///< processor_name()
  int cores = 1;                ///< processors()
  std::string instruction_set;  ///< that the CPU engine picked
};
Machine this_machine();

/// The processor's model as the system names it.
std::string processor_name();

/// Processors that this process may run on, at least 1.
int processors();

/// "Release, GCC 12.2.0": how this program was built.
std::string build_description();

/// "AMD EPYC, 2 cores, AVX-512; tyglab 0.2.0, Release, GCC 12.2.0"
std::string machine_line();

/// Nanoseconds to read and write `bytes` once, in place, by `threads` threads over a working set of that size: the time
/// that a step's memory traffic takes at least. Best of `repeats`.
double memory_limit_ns(std::size_t bytes, int threads, int repeats);

}  // namespace tyglab
