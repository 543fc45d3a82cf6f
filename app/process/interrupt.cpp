#include "app/process/interrupt.h"

#include <unistd.h>

#include <string_view>

#include "core/io/output_file.h"

namespace tyglab {
namespace {

constexpr int exit_interrupted = 130;  // by convention 128 + SIGINT

// A signal handler reaches nothing but a global.
volatile std::sig_atomic_t was_interrupted = 0;

/// Only what a signal handler may call.
void end_at_once(std::string_view sentence) {
  // Where stderr is gone too there is nobody left to tell.
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, sentence.data(), sentence.size());
  ::_exit(exit_interrupted);
}

extern "C" void exit_on_interrupt(int) {
  end_at_once("tyglab: Interrupted before it finished.\n");
}

extern "C" void note_interrupt(int) {
  if (was_interrupted != 0) end_at_once("\ntyglab: Interrupted twice, so it stopped immediately.\n");
  was_interrupted = 1;
}

}  // namespace

SignalHandler::SignalHandler(void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;  // a write that is interrupted goes on
  sigaction(SIGINT, &action, &old_int_);
  sigaction(SIGTERM, &action, &old_term_);
  sigaction(SIGHUP, &action, &old_hup_);
  if (old_hup_.sa_handler == SIG_IGN) sigaction(SIGHUP, &old_hup_, nullptr);  // nohup stays so
}

SignalHandler::~SignalHandler() {
  sigaction(SIGINT, &old_int_, nullptr);
  sigaction(SIGTERM, &old_term_, nullptr);
  sigaction(SIGHUP, &old_hup_, nullptr);
}

InterruptExit::InterruptExit() : handler_(exit_on_interrupt) {}

// Nothing is noted before: a signal that comes while the handler is being installed counts.
InterruptGuard::InterruptGuard() : handler_((was_interrupted = 0, note_interrupt)) {
  stop_waiting_outputs_when(interrupted);
}

bool InterruptGuard::interrupted() {
  return was_interrupted != 0;
}

}  // namespace tyglab
