// Tyglab's one binary.
#include "app/cli/commands/program.h"

int main(int argc, char** argv) {
  return tyglab::run_program(argc, argv);
}
