// Lets long work be stopped from outside: the work checks a question often.
#pragma once

#include <functional>

namespace tyglab {

/// Whether to stop. Asked from the threads that work, often and for as long as the work lasts, so it must be quick, may
/// be called by any thread and keeps its answer once it is yes. Empty: nobody will stop it.
using Stop = std::function<bool()>;

}  // namespace tyglab
