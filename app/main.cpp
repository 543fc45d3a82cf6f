// The main function of the tyglab binary.
#include "app/cli/commands/commands.h"

int main(int argc, char** argv) {
  return tyglab::run_command_line(argc, argv);
}
