// What all commands share: exit codes, and how errors become sentences and codes.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <stdexcept>
#include <string>

namespace tyglab {

/// The program's exit codes, fixed so that scripts can rely on them.
enum ExitCode : int {
  exit_done = 0,
  exit_violation = 1,     ///< an experiment found a violation, or the program found a fault in itself
  exit_command_line = 2,  ///< the command line is wrong, --set included
  exit_input = 3,         ///< a preset or another input file is wrong or missing
  exit_diverged = 4,      ///< `run` or `render` diverged
  exit_engine = 5,        ///< the engine or device asked for is not there
  exit_output = 6,        ///< an output could not be written
  exit_interrupted = 130  ///< Ctrl-C
};

/// The command line is wrong in a way that its parser does not see. `what()` says what to write instead.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What the command line picked: does the work and returns the exit code.
using Action = std::function<int()>;

/// Ends the program's parsing: prints help (0) or what is wrong with the command line (2).
int exit_of_parsing(const CLI::App& program, const CLI::ParseError& error);
/// Does the work; an error becomes a sentence on stderr and its exit code.
int run_action(const Action& action);

/// A check of a number's range that leaves the help text as it is.
template <class T>
CLI::Validator between(T lowest, T highest) {
  return CLI::Range(lowest, highest).description("");
}

/// Throws OutputError unless a file of that name can be made: before hours of work, not after.
void require_writable(const std::string& file);

}  // namespace tyglab
