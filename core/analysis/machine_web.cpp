#include <algorithm>
#include <thread>

#include "core/analysis/machine.h"

namespace tyglab {

std::string processor_name() {
  return "unknown processor";  // which a browser does not tell
}

int processors() {
  // 1 where a page's memory belongs to one thread. Browsers count hyperthreads, and start a worker for each thread.
  return std::clamp(int(std::thread::hardware_concurrency()), 1, 4);
}

}  // namespace tyglab
