#include "app/process/driver_probe.h"

namespace tyglab {

// Drivers are asked here: one that crashes when it is asked for its devices ends the program. What may fail on a
// working device, a program that is built, is tried in a process of its own here too (program_trial.h).
void probe_drivers_in_child() {}

}  // namespace tyglab
