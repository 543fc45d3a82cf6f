// This process: its memory and its limits.
#pragma once

#include <cstddef>
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
/// Shows the error message in a dialog if the program ended with an exit code other than 0 and has no terminal.
void show_last_words(int exit_code);

/// Ends the process, after a sentence on standard error. May be called from a signal handler.
[[noreturn]] void end_at_once(std::string_view sentence, int exit_code);

// Controls how the C library's heap returns memory.

/// From this size on a block is returned to the system as soon as it is freed.
inline constexpr std::size_t large_block = std::size_t(4) << 20;

/// Keeps it so for the rest of the process, where the C library is glibc. By itself that raises its limit to the size
/// of the largest block that was freed, up to 32 MB, and puts later blocks of that size among the small ones: pictures
/// of fonts, arrays of cloths and studies then leave holes that small blocks fill, and a window that is used for
/// minutes keeps most of what it ever needed at once. To be called while there is one thread.
void return_large_blocks();

// Memory limits (ulimit -v): graphics and OpenCL drivers crash when memory is refused, and the limit is the reason.

/// " This process may use 400 MB of memory at most (ulimit -v); raise that limit." Empty where there is none.
std::string memory_limit_words();

/// While one lives, where there is such a limit, a crash, or a driver that ends the program by itself, ends it with a
/// sentence that tells the limit and exit code 5.
class CrashExplainer {
 public:
  CrashExplainer();
  ~CrashExplainer();
  CrashExplainer(const CrashExplainer&) = delete;
  CrashExplainer& operator=(const CrashExplainer&) = delete;
};

/// In a child process: a crash is for its parent to see.
void leave_crashes_to_parent();

}  // namespace tyglab
