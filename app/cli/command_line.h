// Common to all commands: exit codes, and the conversion of errors into messages and codes.
#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/cli/film.h"

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

/// An error of the command line that its parser does not detect. `what()` names the correct form.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The action that the command line selects: it does the work and returns the exit code.
using Action = std::function<int()>;

/// Ends the program's parsing: prints help (0) or what is wrong with the command line (2). `words` are those typed
/// after the program's name: a word in the place of a command that is none is named in the message, with the known
/// commands.
int exit_of_parsing(const CLI::App& program, const CLI::ParseError& error, std::span<const std::string> words);
/// The names of a command's own commands.
std::vector<std::string> command_names(const CLI::App& command);
/// Does the work; an error becomes a sentence on stderr and its exit code.
int run_action(const Action& action);

/// "1 step", "2 steps".
std::string counted(std::int64_t count, const std::string& noun);

/// Checks that an option's text is a number in that range, ends included, and describes the range: "0 to 1e9 s". Given
/// to CLI::Option::transform, since it also rewrites whole numbers for the parser, which would read 010 as 8 and not
/// read 1e6 at all.
CLI::Validator number_between(double lowest, double highest, const std::string& unit = {});
CLI::Validator whole_number_between(std::int64_t lowest, std::int64_t highest);
/// Checks that an option's text is not empty, as when a script's variable was never set.
CLI::Validator not_empty();

// --color: the quantity that colors the cloth in pictures and in the window.

/// Adds --color, whose text is the name of a ParticleField (field_called), or empty. `copies`: whether there may be
/// copies, which the distance from a reference needs.
void add_color_option(CLI::App& command, std::string& name, bool copies);

// --size WxH: the size of pictures and of the window.

/// "1280x720". Throws UsageError naming the option unless it is at least that large, and no side over 8192 pixels.
PictureSize parse_size(const std::string& text, PictureSize least);

// Progress of long work with the time left: one line on stderr that is overwritten, on a terminal only.

class Progress {
 public:
  explicit Progress(const std::string& what);
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `done` of the work, 0 to 1. Shown at most five times a second.
  void update(double done);
  /// Clears the line, for other output.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  std::string what_;
  bool terminal_;
  bool shown_ = false;
  Clock::time_point start_ = Clock::now(), last_ = start_;
};

/// "5 s", "2 min 5 s", "1 h 2 min": a duration for people.
std::string duration_text(double seconds);

}  // namespace tyglab
