#include "core/engines/cpu/team.h"

#include <emscripten/threading.h>

#include <limits>

// The library's own wait looks again and again, up to 8 ms apart: late, and never at rest.
namespace tyglab::cpu {
namespace {

/// Threads that sleep, anywhere: mostly there is none to be woken. Every atomic operation of WebAssembly is
/// sequentially consistent, so that whoever changes a number sees who sleeps for it, or is seen by them.
std::atomic<int> sleeping{0};

void wake(std::atomic<int>& number, int most) {
  if (sleeping.load() > 0) emscripten_futex_wake(&number, most);
}

}  // namespace

void sleep_while(const std::atomic<int>& number, int old) {
  ++sleeping;
  emscripten_futex_wait(const_cast<std::atomic<int>*>(&number), unsigned(old), std::numeric_limits<double>::infinity());
  --sleeping;
}

void wake_one(std::atomic<int>& number) {
  wake(number, 1);
}

void wake_all(std::atomic<int>& number) {
  wake(number, std::numeric_limits<int>::max());
}

}  // namespace tyglab::cpu
