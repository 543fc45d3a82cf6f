// The output options of a command, all checked before any work starts, and not after hours of it.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace tyglab {

/// Throws UsageError unless a file of --record is called as an experiment, since only its ending tells it from a
/// preset.
void check_record(const std::string& file);

/// One option that names a file. "-" is standard output.
struct Output {
  std::string option;   ///< "--state"
  std::string file;     ///< empty: not asked for
  bool binary = false;  ///< bytes that a terminal cannot show
};

/// A file that a command reads: "the preset", and where it is.
struct Input {
  std::string what;
  std::filesystem::path file;
};

/// Whether both names lead to one file, directly or through links.
bool same_file(const std::filesystem::path& a, const std::filesystem::path& b);
/// Throws UsageError where two outputs would be one file, where one would replace what is read, or where bytes would go
/// to a terminal; OutputError unless each file can be made.
void check_outputs(const std::vector<Output>& outputs, const std::vector<Input>& inputs = {});

/// The stream for messages to people: standard output, or stderr if an output goes to standard output.
std::ostream& people(const std::vector<Output>& outputs);

/// The JSON text of a result file, in UTF-8 whatever the names of files, with a final line feed.
std::string json_text(const nlohmann::ordered_json& json);

/// Throws UsageError if a folder of files is to go to standard output, OutputError if the folder cannot be made.
void make_output_folder(const std::string& option, const std::string& folder);

/// The files of a sequence, named by frame_name().
struct Sequence {
  std::string folder, prefix, extension;
  std::int64_t count = 0;    ///< of frames planned
  std::int64_t written = 0;  ///< of them, the first
};
/// Prints a line on stderr if the folder has other files with such names, left by a longer sequence.
void warn_of_older_frames(const Sequence& sequence);

/// Adds an option that names a file or a folder; an empty name is refused.
CLI::Option* add_output(CLI::App& command, const std::string& option, std::string& file, const std::string& what);

}  // namespace tyglab
