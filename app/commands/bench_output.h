// What the benchmarks say alike: the machine and build that figures belong to.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace tyglab {

/// "AMD EPYC, 2 cores, AVX-512; tyglab 0.1.0, Release, GCC 12.2.0"
std::string machine_line();

/// The frame of a benchmark's JSON: its name, the machine, the version and build, and the rows under "runs".
nlohmann::ordered_json bench_json(const std::string& benchmark, nlohmann::ordered_json runs);

/// The exit code of a benchmark under an InterruptGuard; says so if Ctrl-C ended it.
int bench_exit();

}  // namespace tyglab
