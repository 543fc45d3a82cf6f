// Temporary folders and the program as a process.
#pragma once

#include <csignal>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tyglab::test {

/// A folder of its own, removed with everything in it at the end of the test.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::filesystem::path operator/(std::string_view name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Whole contents. Fails the test if the file cannot be read.
std::string read_file(const std::filesystem::path& file);
void write_file(const std::filesystem::path& file, std::string_view text);
std::vector<std::string> split(std::string_view text, char separator);
std::vector<std::string> lines(std::string_view text);

struct Outcome {
  int code = -1;    ///< exit code; 128 + number if a signal ended it
  std::string out;  ///< stdout
  std::string err;  ///< stderr
};
/// Runs a program in `folder`, stdin empty, without DISPLAY.
Outcome run(const std::filesystem::path& folder, const std::vector<std::string>& command);
/// Runs the built `tyglab` with these arguments.
Outcome tyglab(const std::filesystem::path& folder, std::vector<std::string> arguments);
/// Starts `tyglab`, waits until it catches the signal and, if one is named, until that file is there, sends the signal
/// after that time, and waits for the end.
Outcome tyglab_interrupted(const std::filesystem::path& folder, std::vector<std::string> arguments,
                           double after_seconds, int signal = SIGINT, const std::filesystem::path& file = {});

}  // namespace tyglab::test
