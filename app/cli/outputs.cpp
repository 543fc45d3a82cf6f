#include "app/cli/outputs.h"

#include <iostream>
#include <nlohmann/json.hpp>
#include <set>

#include "app/base/experiment_file.h"
#include "app/cli/command_line.h"
#include "core/io/output_file.h"
#include "core/io/system_files.h"
#include "core/io/terminal.h"
#include "core/output/obj.h"

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

void check_outputs(const std::vector<Output>& outputs, const std::vector<Input>& inputs) {
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
                         "it is complete; use a name that does not end in " + incomplete);
    for (const Input& input : inputs)
      if (!input.file.empty() && same_file(a->file, input.file))
        throw UsageError(a->option + " " + a->file + ": would overwrite " + input.what +
                         " that is read; use another file");
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
    throw OutputError(folder + ": is not a folder; name an existing or a new folder");
  fs::create_directories(folder, error);
  if (error) throw OutputError(folder + ": the folder cannot be created: " + error.message());
  if (!os::may_write_into(folder)) throw OutputError(folder + ": is not writable; choose another folder");
}

void warn_of_older_frames(const Sequence& sequence) {
  std::set<std::string> own;
  for (std::int64_t n = 0; n < sequence.written; ++n)
    own.insert(frame_name(sequence.prefix, n, sequence.count, sequence.extension));
  std::int64_t older = 0;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(sequence.folder, error)) {
    const std::string name = entry.path().filename().string();
    older += is_frame_name(name, sequence.prefix, sequence.extension) && !own.contains(name);
  }
  if (older == 0) return;
  std::cerr << "tyglab: " << in_one_line(sequence.folder) << " also holds " << counted(older, "frame")
            << " of an earlier sequence of " << in_one_line(sequence.prefix) << "; remove "
            << (older == 1 ? "it" : "them") << ", or use an empty folder.\n";
}

CLI::Option* add_output(CLI::App& command, const std::string& option, std::string& file, const std::string& what) {
  return command.add_option(option, file, what)
      ->check(not_empty())
      ->check(CLI::Validator(
          [](std::string& text) {
            return text.starts_with("--") ? text + " looks like an option; name a file, or ./" + text + " if it is one"
                                          : std::string();
          },
          ""));
}

void check_record(const std::string& file) {
  if (!file.empty() && !is_standard_output(file) && !os::is_stream(file) && !is_experiment(file))
    throw UsageError("--record " + file + ": an experiment is called NAME.tyglab; change the ending");
}

}  // namespace tyglab
