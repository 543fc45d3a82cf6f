#include "app/commands/command_line.h"

#include <fcntl.h>
#include <unistd.h>

#include <charconv>
#include <cmath>
#include <csignal>
#include <iostream>
#include <new>
#include <optional>

#include "app/commands/interrupt.h"
#include "app/data_files.h"
#include "app/viewport/graphics_error.h"
#include "core/engines/engine.h"
#include "core/notation/preset_io.h"
#include "core/notation/words.h"
#include "core/output/destination.h"

namespace tyglab {
namespace {

/// The number that the whole text is.
std::optional<double> number_in(const std::string& text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (text.empty() || stop != end || error != std::errc{}) return {};
  return value;
}

/// Why a number is refused; empty if it lies within.
std::string range_problem(double value, double lowest, double highest, const std::string& unit) {
  if (value >= lowest && value <= highest) return {};
  return shortest_number(value) + " is not allowed; allowed: " + shortest_number(lowest) + " to " +
         shortest_number(highest) + (unit.empty() ? "" : " " + unit);
}

}  // namespace

void prepare_process() {
  std::signal(SIGXFSZ, SIG_IGN);
  // Descriptors are given out from the lowest: each that was free is taken until the first beyond the three. For
  // reading alone, so that what is written to it fails and is told.
  int descriptor = 0;
  do {
    descriptor = ::open("/dev/null", O_RDONLY);
  } while (descriptor >= 0 && descriptor <= STDERR_FILENO);
  if (descriptor > STDERR_FILENO) ::close(descriptor);
}

int exit_of_parsing(const CLI::App& program, const CLI::ParseError& error) {
  if (program.exit(error) != 0) return exit_command_line;
  return run_action([] { return int(exit_done); });  // which sees that the help has arrived
}

int run_action(const Action& action) {
  const auto say = [](const std::string& what, ExitCode code) {
    std::cerr << "tyglab: " << what << '\n';
    return code;
  };
  try {
    const InterruptExit until_the_work_begins;
    const int code = action();
    flush_standard_output();
    return code;
  } catch (const UsageError& error) {
    return say(error.what(), exit_command_line);
  } catch (const PresetError& error) {
    return say(error.what(), exit_input);
  } catch (const DataFileError& error) {
    return say(error.what(), exit_input);
  } catch (const EngineError& error) {
    return say(error.what(), exit_engine);
  } catch (const GraphicsError& error) {
    return say(error.what(), exit_engine);
  } catch (const OutputError& error) {
    return say(error.what(), exit_output);
  } catch (const std::bad_alloc&) {
    return say("There is not enough memory for a cloth of this size; ask for fewer rows or columns.", exit_engine);
  } catch (const std::exception& error) {
    return say(std::string("A fault in the program: ") + error.what(), exit_violation);
  }
}

std::string counted(std::int64_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

CLI::Validator number_between(double lowest, double highest, const std::string& unit) {
  const auto check = [=](std::string& text) -> std::string {
    const auto value = number_in(text);
    if (!value) return "'" + text + "' is not a number; write it like 1.5 or 2e-3";
    return range_problem(*value, lowest, highest, unit);
  };
  return {check, ""};
}

CLI::Validator whole_number_between(std::int64_t lowest, std::int64_t highest) {
  const auto check = [=](std::string& text) -> std::string {
    const auto value = number_in(text);
    if (!value || (std::isfinite(*value) && *value != std::floor(*value)))
      return "'" + text + "' is not a whole number; write it like 100 or 1e6";
    if (auto problem = range_problem(*value, double(lowest), double(highest), ""); !problem.empty()) return problem;
    text = std::to_string(static_cast<std::int64_t>(*value));
    return {};
  };
  return {check, ""};
}

CLI::Validator not_empty() {
  return {[](std::string& text) { return text.empty() ? std::string("must not be empty") : std::string(); }, ""};
}

}  // namespace tyglab
