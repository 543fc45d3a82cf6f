#include "app/platform/advice.h"

namespace tyglab {

const char* driver_advice() {
  return "Install the newest driver of the graphics card's maker. Over a remote desktop and in virtual machines there "
         "is "
         "often none; all commands but tyglab render work without it (tyglab --help).";
}

const char* display_advice() {
  return "Start Tyglab in a desktop session, or use its commands (tyglab --help).";
}

}  // namespace tyglab
