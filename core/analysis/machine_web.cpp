#include "core/analysis/machine.h"

namespace tyglab {

std::string processor_name() {
  return "unknown processor";  // which a browser does not tell
}

int processors() {
  return 1;  // a page's memory belongs to one thread
}

}  // namespace tyglab
