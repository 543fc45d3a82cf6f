#include "app/process/print_in_child.h"

namespace tyglab {

std::string print_in_child(void (*print)()) {
  print();
  return {};
}

}  // namespace tyglab
