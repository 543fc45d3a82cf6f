#include <windows.h>

#include <atomic>
#include <csignal>

#include "app/process/interrupt.h"

namespace tyglab {
namespace {

std::atomic<void (*)(int)> present = nullptr;

/// In a thread of its own, which Windows makes.
BOOL WINAPI on_console_event(DWORD event) {
  const auto handler = present.load();
  if (handler == nullptr) return FALSE;
  handler(SIGINT);
  // Of a console that is closed or a session that ends, Windows ends the process when this returns, or after seconds.
  constexpr DWORD time_to_end = 4000;  // ms
  if (event != CTRL_C_EVENT && event != CTRL_BREAK_EVENT) ::Sleep(time_to_end);
  return TRUE;
}

}  // namespace

struct SignalHandler::Before {
  void (*handler)(int);
};

SignalHandler::SignalHandler(void (*handler)(int))
    : before_(std::make_unique<Before>(Before{present.exchange(handler)})) {
  [[maybe_unused]] static const BOOL installed = ::SetConsoleCtrlHandler(on_console_event, TRUE);
}

SignalHandler::~SignalHandler() {
  present = before_->handler;
}

}  // namespace tyglab
