#include "app/process/memory_limit.h"

namespace tyglab {

// There is no such limit.
std::string memory_limit_words() {
  return {};
}

CrashExplainer::CrashExplainer() = default;
CrashExplainer::~CrashExplainer() = default;

void leave_crashes_to_parent() {}

}  // namespace tyglab
