
#include "app/cli/command_line.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <iostream>
#include <new>
#include <optional>
#include <sstream>

#include "app/base/files.h"
#include "app/cli/preset_argument.h"
#include "app/process/interrupt.h"
#include "app/process/process.h"
#include "app/render/gl_objects.h"
#include "app/session/lab.h"
#include "core/engines/engine.h"
#include "core/fields/particle_field.h"
#include "core/io/output_file.h"
#include "core/io/preset_io.h"
#include "core/io/system_files.h"
#include "core/io/terminal.h"
#include "core/model/notation.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

/// One line, whatever names stand in it.
void complain(std::string what) {
  std::replace(what.begin(), what.end(), '\n', ' ');
  std::cerr << "tyglab: " << what << '\n';
}

/// The number that the whole text is.
std::optional<double> number_in(const std::string& text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = read_number(text.data(), end, value);
  if (text.empty() || stop != end || error != std::errc{}) return {};
  return value;
}

/// Why a number is refused; empty if it lies within.
std::string range_problem(double value, double lowest, double highest, const std::string& unit) {
  if (value >= lowest && value <= highest) return {};
  return shortest_number(value) + " is not allowed; allowed: " + shortest_number(lowest) + " to " +
         shortest_number(highest) + (unit.empty() ? "" : " " + unit);
}

/// What is wrong with the first word that should be a command and is none, or with the lack of one; empty if nothing
/// is.
std::string command_problem(const CLI::App& program, std::span<const std::string> words) {
  const CLI::App* at = &program;
  std::string typed;
  for (const std::string& word : words) {
    const std::vector<std::string> names = command_names(*at);
    if (names.empty() || word.starts_with('-')) return {};
    if (std::find(names.begin(), names.end(), word) != names.end()) {
      at = at->get_subcommand(word);
      typed += (typed.empty() ? "" : " ") + word;
      continue;
    }
    const std::vector<std::string_view> known(names.begin(), names.end());
    const auto near = nearest(word, known);
    const std::string meant = near ? " Did you mean '" + std::string(*near) + "'?" : "";
    if (at != &program) return typed + ": '" + word + "' is not one of its commands: " + joined(names) + "." + meant;
    // Beside commands, the program itself takes presets.
    if (!near || is_preset(word)) return {};
    return "'" + word + "' is neither a command nor a preset." + meant;
  }
  if (at->get_require_subcommand_min() == 0) return {};
  return typed + ": needs one of its commands: " + joined(command_names(*at)) + ".";
}

/// The command that was typed.
const CLI::App& parsed_command(const CLI::App& program) {
  const CLI::App* at = &program;
  for (auto next = at->get_subcommands(); !next.empty(); next = at->get_subcommands()) at = next.front();
  return *at;
}

/// " Did you mean --seconds?", of the options of a command; empty if none is near.
std::string meant_option(const CLI::App& command, const std::string& typed) {
  if (!typed.starts_with("--")) return {};
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  const std::vector<std::string_view> known(names.begin(), names.end());
  const auto near = nearest(typed.substr(0, typed.find('=')), known);
  return near ? " Did you mean " + std::string(*near) + "?" : "";
}

/// What CLI11 lists from the last to the first, in the order in which it was typed.
std::string unexpected(const CLI::App& program, const CLI::ExtrasError& error) {
  const std::string text = error.what();
  std::istringstream words(text.substr(std::min(text.find(": "), text.size() - 2) + 2));
  std::string list, meant;
  for (std::string word; words >> word;) {
    list = word + (list.empty() ? "" : " ") + list;
    if (const std::string option = meant_option(parsed_command(program), word); !option.empty()) meant = option;
  }
  return "Not expected here: " + list + "." + meant +
         " `tyglab COMMAND --help` lists the options of a command; they come after it, as in `tyglab run denim "
         "--steps 4`.";
}

/// What CLI11 says in words of its own; empty for all else.
std::string in_plain_words(const CLI::ParseError& error) {
  const std::string text = error.what();
  const std::size_t twice = text.find(": At Most 1 required"), both = text.find(" excludes ");
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr && twice != std::string::npos)
    return text.substr(0, twice) + ": given more than once; use it once.";
  if (dynamic_cast<const CLI::ExcludesError*>(&error) != nullptr && both != std::string::npos)
    return text.substr(0, both) + " and " + text.substr(both + 10) + " cannot be combined.";
  return {};
}

/// What went wrong, and in a sentence of its own what limit of memory there is.
std::string with_memory_limit(std::string what) {
  const std::string limit = memory_limit_words();
  if (!limit.empty() && !what.ends_with('.')) what += '.';
  return what + limit;
}

}  // namespace

std::vector<std::string> command_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* each : command.get_subcommands([](const CLI::App* each) { return !each->get_group().empty(); }))
    names.push_back(each->get_name());
  return names;
}

int exit_of_parsing(const CLI::App& program, const CLI::ParseError& error, std::span<const std::string> words) {
  return run_action([&]() -> int {
    if (error.get_exit_code() != 0) {
      if (const std::string problem = command_problem(program, words); !problem.empty()) {
        complain(problem);
        return exit_command_line;
      }
    }
    if (const auto* extras = dynamic_cast<const CLI::ExtrasError*>(&error)) {
      complain(unexpected(program, *extras));
      return exit_command_line;
    }
    if (const std::string problem = in_plain_words(error); !problem.empty()) {
      complain(problem);
      return exit_command_line;
    }
    if (error.get_exit_code() == 0) return program.exit(error), exit_done;  // help, the version
    complain(std::string(error.what()) + ". `tyglab COMMAND --help` describes a command.");
    return exit_command_line;
  });
}

int run_action(const Action& action) {
  const auto say = [](const std::string& what, ExitCode code) {
    complain(what);
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
  } catch (const LabError& error) {
    return say(error.what(), exit_input);
  } catch (const DataFileError& error) {
    return say(error.what(), exit_input);
  } catch (const EngineError& error) {
    return say(with_memory_limit(error.what()), exit_engine);
  } catch (const GraphicsError& error) {
    return say(with_memory_limit(error.what()), exit_engine);
  } catch (const OutputError& error) {
    return say(error.what(), InterruptGuard::interrupted() ? exit_interrupted : exit_output);
  } catch (const std::bad_alloc&) {
    return say("There is not enough memory for a cloth of this size; use fewer rows or columns." + memory_limit_words(),
               exit_engine);
  } catch (const std::exception& error) {
    return say(std::string("Internal error: ") + error.what(), exit_violation);
  }
}

std::string counted(std::int64_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

CLI::Validator number_between(double lowest, double highest, const std::string& unit) {
  assert(lowest <= highest);
  const auto check = [=](std::string& text) -> std::string {
    const auto value = number_in(text);
    if (!value) return "'" + text + "' is not a number; write it like 1.5 or 2e-3";
    return range_problem(*value, lowest, highest, unit);
  };
  return {check, ""};
}

CLI::Validator whole_number_between(std::int64_t lowest, std::int64_t highest) {
  assert(lowest <= highest);
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

void add_color_option(CLI::App& command, std::string& name, bool copies) {
  std::vector<std::string> names;
  for (const FieldInfo& field : particle_fields()) {
    if (field.field == ParticleField::distance && !copies) continue;
    names.emplace_back(field.name);
  }
  command.add_option("--color", name, "Colors the cloth by a value of each particle, with a legend")
      ->type_name(joined(names, "|"))
      ->check(CLI::IsMember(names).description(""));
}

PictureSize parse_size(const std::string& text, PictureSize least) {
  constexpr int most = 8192;
  PictureSize size;
  const char* end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width);
  const bool cross = width.ec == std::errc{} && width.ptr != end && *width.ptr == 'x';
  const auto height = std::from_chars(cross ? width.ptr + 1 : end, end, size.height);
  const bool whole = cross && height.ec == std::errc{} && height.ptr == end;
  if (!whole || size.width < least.width || size.height < least.height || std::max(size.width, size.height) > most)
    throw UsageError("--size " + text + ": must be WIDTHxHEIGHT in pixels, such as 1280x720; at least " +
                     std::to_string(least.width) + "x" + std::to_string(least.height) + ", and each at most " +
                     std::to_string(most));
  return size;
}

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
