#include "core/analysis/machine.h"

#include <algorithm>
#include <chrono>
#include <limits>

#include "core/cloth/state.h"
#include "core/engines/cpu/pair_sweep.h"
#include "core/engines/cpu/team.h"
#include "tyglab_version.h"

namespace tyglab {

Machine this_machine() {
  return {processor_name(), processors(), cpu::pair_sweeps<float>().target};
}

std::string build_description() {
#ifdef NDEBUG
  const std::string kind = "Release";
#else
  const std::string kind = "Debug";
#endif
#if defined(__clang__)
  return kind + ", Clang " __clang_version__;
#else
  return kind + ", GCC " __VERSION__;
#endif
}

std::string machine_line() {
  const Machine machine = this_machine();
  return machine.processor + ", " + std::to_string(machine.cores) + (machine.cores == 1 ? " core, " : " cores, ") +
         machine.instruction_set + "; tyglab " TYGLAB_VERSION ", " + build_description();
}

double memory_limit_ns(std::size_t bytes, int threads, int repeats) {
  const std::size_t count = std::max<std::size_t>(bytes / sizeof(float) / threads, 1024);
  const int passes = std::max<int>(1, int((64u << 20) / std::max<std::size_t>(bytes, 1)));
  std::vector<Array<float>> parts(std::size_t(threads), Array<float>(count, 1.0f));
  cpu::Team team(threads);
  double best = std::numeric_limits<double>::infinity();
  for (int n = 0; n < repeats; ++n) {
    const auto start = std::chrono::steady_clock::now();
    team.run([&](int number) {
      float* values = parts[std::size_t(number)].data();
      for (int pass = 0; pass < passes; ++pass) {
        for (std::size_t k = 0; k < count; ++k) values[k] = values[k] * 0.5f + 1.0f;
        asm volatile("" : : "r"(values) : "memory");  // each pass is to reach memory
      }
    });
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
    best = std::min(best, time.count() / passes);
  }
  return best;
}

}  // namespace tyglab
