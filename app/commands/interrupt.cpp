#include "app/commands/interrupt.h"

namespace tyglab {
namespace {

// A signal handler reaches nothing but a global.
volatile std::sig_atomic_t was_interrupted = 0;

extern "C" void note_interrupt(int) {
  was_interrupted = 1;
}

}  // namespace

InterruptGuard::InterruptGuard() {
  was_interrupted = 0;
  struct sigaction action = {};
  action.sa_handler = note_interrupt;
  // The handler goes after the first signal; a write that it interrupts goes on.
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  sigaction(SIGINT, &action, &old_int_);
  sigaction(SIGTERM, &action, &old_term_);
}

InterruptGuard::~InterruptGuard() {
  sigaction(SIGINT, &old_int_, nullptr);
  sigaction(SIGTERM, &old_term_, nullptr);
}

bool InterruptGuard::interrupted() {
  return was_interrupted != 0;
}

}  // namespace tyglab
