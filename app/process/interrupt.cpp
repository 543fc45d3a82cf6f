#include "app/process/interrupt.h"

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdint>

#include "app/process/process.h"
#include "core/io/output_file.h"

namespace tyglab {
namespace {

constexpr int exit_interrupted = 130;  // by convention 128 + SIGINT

// A signal handler reaches nothing but globals.
volatile std::sig_atomic_t was_interrupted = 0;
std::atomic<std::int64_t> interrupted_at{0};  // ms

std::int64_t milliseconds() {
  using namespace std::chrono;
  return duration_cast<std::chrono::milliseconds>(steady_clock::now().time_since_epoch()).count();
}

extern "C" void exit_on_interrupt(int) {
  end_at_once("tyglab: Interrupted before it finished.\n", exit_interrupted);
}

extern "C" void note_interrupt(int) {
  // A terminal that closes, or `timeout`, sends two at once: that is one wish.
  constexpr std::int64_t one_wish = 500;  // ms
  if (was_interrupted == 0) {
    interrupted_at = milliseconds();
    was_interrupted = 1;
  } else if (milliseconds() - interrupted_at >= one_wish) {
    end_at_once("\ntyglab: Interrupted twice, so it stopped immediately.\n", exit_interrupted);
  }
}

}  // namespace

InterruptExit::InterruptExit() : handler_(exit_on_interrupt) {}

// Nothing is noted before: a signal that comes while the handler is being installed counts.
InterruptGuard::InterruptGuard() : handler_((was_interrupted = 0, note_interrupt)) {
  stop_waiting_outputs_when(interrupted);
}

bool InterruptGuard::interrupted() {
  return was_interrupted != 0;
}

}  // namespace tyglab
