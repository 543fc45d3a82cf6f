// This process: its streams, its arguments and its end.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tyglab {

/// Gives standard streams that were closed (>&-) to nothing, so that no file that is opened later takes their place;
/// makes writing beyond a limit (ulimit -f) or to nobody (| head) an error that is reported instead of the process's
/// end. On Windows, lets a console show UTF-8.
void secure_standard_streams();

/// The arguments of main() without the program's name, in UTF-8.
std::vector<std::string> program_arguments(int argc, char** argv);

/// Whether the environment names a display; on Windows there always is one.
bool display_is_named();

/// Gives up the console that a program for terminals gets where it is started by a double-click; its last words are
/// kept for show_last_words(). Only Windows does so: elsewhere nothing.
void leave_own_console();
/// Shows in a dialog what went wrong, where it ended with an exit code other than 0 and has no terminal for it.
void show_last_words(int exit_code);

/// Ends the process, after a sentence on standard error. May be called from a signal handler.
[[noreturn]] void end_at_once(std::string_view sentence, int exit_code);

}  // namespace tyglab
