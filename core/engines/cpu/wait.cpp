#include "core/engines/cpu/team.h"

namespace tyglab::cpu {

void sleep_while(const std::atomic<int>& number, int old) {
  number.wait(old);
}

void wake_one(std::atomic<int>& number) {
  number.notify_one();
}

void wake_all(std::atomic<int>& number) {
  number.notify_all();
}

}  // namespace tyglab::cpu
