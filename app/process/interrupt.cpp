#include "app/process/interrupt.h"

#include <csignal>

#include "app/process/process.h"
#include "core/io/output_file.h"

namespace tyglab {
namespace {

constexpr int exit_interrupted = 130;  // by convention 128 + SIGINT

// A signal handler reaches nothing but a global.
volatile std::sig_atomic_t was_interrupted = 0;

extern "C" void exit_on_interrupt(int) {
  end_at_once("tyglab: Interrupted before it finished.\n", exit_interrupted);
}

extern "C" void note_interrupt(int) {
  if (was_interrupted != 0) end_at_once("\ntyglab: Interrupted twice, so it stopped immediately.\n", exit_interrupted);
  was_interrupted = 1;
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
