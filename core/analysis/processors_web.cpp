#include "core/analysis/machine.h"

namespace tyglab {

int processors() {
  return 1;  // a page's memory belongs to one thread
}

}  // namespace tyglab
