#include "app/cli/progress.h"

#include <cmath>

#include "core/io/system_files.h"
#include "core/io/terminal.h"

namespace tyglab {

Progress::Progress(const std::string& what)
    : what_(in_one_line(what)), terminal_(os::is_terminal(os::standard_error)) {}

void Progress::clear() {
  if (shown_) cursor_output() << '\r' << std::string(what_.size() + 40, ' ') << '\r' << std::flush;
  shown_ = false;
}

void Progress::update(double done) {
  if (!terminal_) return;
  const auto now = Clock::now();
  if (now - last_ < std::chrono::milliseconds(200)) return;
  last_ = now;
  const double passed = std::chrono::duration<double>(now - start_).count();
  std::string line = what_ + ": " + std::to_string(static_cast<int>(100 * done)) + " %";
  if (done > 0) line += ", " + duration_text(passed * (1 - done) / done) + " left";
  line.resize(what_.size() + 40, ' ');
  cursor_output() << '\r' << line << std::flush;
  shown_ = true;
}

std::string duration_text(double seconds) {
  const auto whole = static_cast<long long>(std::ceil(seconds));
  const auto text = [](long long n, const char* unit) { return std::to_string(n) + ' ' + unit; };
  if (whole < 60) return text(whole, "s");
  if (whole < 3600) return text(whole / 60, "min") + ' ' + text(whole % 60, "s");
  return text(whole / 3600, "h") + ' ' + text(whole % 3600 / 60, "min");
}

}  // namespace tyglab
