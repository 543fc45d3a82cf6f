// A limit of memory (ulimit -v): graphics and OpenCL drivers crash where they are refused memory, and the limit is why.
#pragma once

#include <string>

namespace tyglab {

/// " This process may use 400 MB of memory at most (ulimit -v); raise that limit." Empty where there is none.
std::string memory_limit_words();

/// Where there is such a limit, a crash from here on ends the program with a sentence that tells it and exit code 5.
void explain_crashes_under_limit();

/// In a child process: a crash is for its parent to see.
void leave_crashes_to_parent();

}  // namespace tyglab
