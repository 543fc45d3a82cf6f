// Sleeps until a number that several threads share changes.
#pragma once

#include <atomic>

namespace tyglab::cpu {

/// Sleeps while `number` is `old`, until wake_one() or wake_all() is called for it. May return earlier.
void sleep_while(const std::atomic<int>& number, int old);
/// To be called after the number has changed.
void wake_one(std::atomic<int>& number);
void wake_all(std::atomic<int>& number);

}  // namespace tyglab::cpu
