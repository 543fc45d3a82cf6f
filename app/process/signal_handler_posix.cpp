#include <csignal>

#include "app/process/interrupt.h"

namespace tyglab {

struct SignalHandler::Before {
  struct sigaction interrupt, terminate, hang_up;
};

SignalHandler::SignalHandler(void (*handler)(int)) : before_(std::make_unique<Before>()) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;  // a write that is interrupted goes on
  sigaction(SIGINT, &action, &before_->interrupt);
  sigaction(SIGTERM, &action, &before_->terminate);
  sigaction(SIGHUP, &action, &before_->hang_up);
  if (before_->hang_up.sa_handler == SIG_IGN) sigaction(SIGHUP, &before_->hang_up, nullptr);  // nohup stays so
}

SignalHandler::~SignalHandler() {
  sigaction(SIGINT, &before_->interrupt, nullptr);
  sigaction(SIGTERM, &before_->terminate, nullptr);
  sigaction(SIGHUP, &before_->hang_up, nullptr);
}

}  // namespace tyglab
