// The options of a command that name files to be written, checked before any work: not after hours of it.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iosfwd>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace tyglab {

/// One option that names a file. "-" is standard output.
struct Output {
  std::string option;   ///< "--state"
  std::string file;     ///< empty: not asked for
  bool binary = false;  ///< bytes that a terminal cannot show
};

/// Whether both would be one file, by whatever names and links.
bool same_file(const std::filesystem::path& a, const std::filesystem::path& b);
/// Throws UsageError where two outputs would be one file, where one would replace the preset that is read (`input`), or
/// where bytes would go to a terminal; OutputError unless each file can be made.
void check_outputs(const std::vector<Output>& outputs, const std::filesystem::path& input = {});

/// Where sentences for people go: to standard output, or to stderr if an output goes to the former.
std::ostream& people(const std::vector<Output>& outputs);

/// What a file of figures for programs holds: in UTF-8 whatever files are called, with a line's end.
std::string json_text(const nlohmann::ordered_json& json);

/// Throws UsageError if a folder of files is to go to standard output, OutputError if the folder cannot be made.
void make_output_folder(const std::string& option, const std::string& folder);

/// Adds an option that names a file or a folder; an empty name is refused.
CLI::Option* add_output(CLI::App& command, const std::string& option, std::string& file, const std::string& what);

}  // namespace tyglab
