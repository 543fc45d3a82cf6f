#include "app/platform/advice.h"

namespace tyglab {

const char* driver_advice() {
  return "Install a driver (on Debian, libgl1-mesa-dri draws on the CPU).";
}

const char* display_advice() {
  return "Start Tyglab in a desktop session or under xvfb-run, or use tyglab render, which needs no display.";
}

}  // namespace tyglab
