// Memory limits (ulimit -v): graphics and OpenCL drivers crash when memory is refused, and the limit is the reason.
#pragma once

#include <string>

namespace tyglab {

/// " This process may use 400 MB of memory at most (ulimit -v); raise that limit." Empty where there is none.
std::string memory_limit_words();

/// While one lives, where there is such a limit, a crash, or a driver that ends the program by itself, ends it with a
/// sentence that tells the limit and exit code 5.
class CrashExplainer {
 public:
  CrashExplainer();
  ~CrashExplainer();
  CrashExplainer(const CrashExplainer&) = delete;
  CrashExplainer& operator=(const CrashExplainer&) = delete;
};

/// In a child process: a crash is for its parent to see.
void leave_crashes_to_parent();

}  // namespace tyglab
