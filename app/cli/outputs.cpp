#include "app/cli/outputs.h"

#include <iostream>
#include <nlohmann/json.hpp>

#include "app/cli/command_line.h"
#include "core/io/destination.h"
#include "core/io/files.h"
#include "core/io/output_file.h"
#include "core/io/system_files.h"

namespace tyglab {
namespace fs = std::filesystem;
namespace {

/// A file that would be replaced or made, as opposed to a pipe or a device, which takes what comes.
bool is_plain(const fs::path& file) {
  std::error_code error;
  return !is_standard_output(file) && (fs::is_regular_file(file, error) || !fs::exists(file, error));
}

}  // namespace

bool same_file(const fs::path& a, const fs::path& b) {
  if (is_standard_output(a) || is_standard_output(b)) return is_standard_output(a) && is_standard_output(b);
  return is_plain(a) && is_plain(b) && output_place(a) == output_place(b);
}

void check_outputs(const std::vector<Output>& outputs, const fs::path& input) {
  const std::string incomplete = ".incomplete";
  for (auto a = outputs.begin(); a != outputs.end(); ++a) {
    if (a->file.empty()) continue;
    if (a->binary && is_standard_output(a->file) && os::is_terminal(os::standard_output))
      throw UsageError(a->option +
                       " -: standard output is a terminal, which cannot show such a file; redirect it to a "
                       "file (> F) or pipe it to a program (| …)");
    for (auto b = outputs.begin(); b != a; ++b)
      if (!b->file.empty() && same_file(a->file, b->file))
        throw UsageError(b->option + " and " + a->option + ": both go to " + output_name(a->file) +
                         "; use a different file for one of them");
    for (auto b = outputs.begin(); b != a; ++b)
      if (!b->file.empty() && (same_file(a->file + incomplete, b->file) || same_file(b->file + incomplete, a->file)))
        throw UsageError(b->option + " and " + a->option +
                         ": one of them is written under the name of the other until " +
                         "it is whole; use a name that does not end in " + incomplete);
    if (!input.empty() && same_file(a->file, input))
      throw UsageError(a->option + " " + a->file + ": would overwrite the preset that is read; use another file");
    check_output(a->file);
  }
}

std::ostream& people(const std::vector<Output>& outputs) {
  for (const Output& output : outputs)
    if (is_standard_output(output.file)) return std::cerr;
  return std::cout;
}

std::string json_text(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void make_output_folder(const std::string& option, const std::string& folder) {
  if (is_standard_output(folder))
    throw UsageError(option + " -: several files cannot go to standard output; name a folder");
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    throw OutputError(folder + ": is not a folder; name one, or one that is to be made");
  fs::create_directories(folder, error);
  if (error) throw OutputError(folder + ": the folder cannot be created: " + error.message());
  if (!os::may_write_into(folder)) throw OutputError(folder + ": is not writable; choose another folder");
}

CLI::Option* add_output(CLI::App& command, const std::string& option, std::string& file, const std::string& what) {
  return command.add_option(option, file, what)->check(not_empty());
}

}  // namespace tyglab
