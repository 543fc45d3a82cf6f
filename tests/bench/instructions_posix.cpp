#include "tests/bench/instructions.h"

#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "app/process/program_run.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

namespace fs = std::filesystem;

/// The program of that name on PATH; empty if there is none.
fs::path on_path(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (const fs::path file = fs::path(folder) / name; access(file.c_str(), X_OK) == 0) return file;
  return {};
}

/// Whether a program, which prints nothing then, ended well.
bool run_silently(const std::vector<std::string>& command) {
  return run_program(command.front(), command).code == 0;
}

/// A new file in the system's folder for temporary ones, removed at the end; no path if none could be made.
class TemporaryFile {
 public:
  TemporaryFile() : path_((fs::temp_directory_path() / "tyglab-callgrind.XXXXXX").string()) {
    if (const int descriptor = mkstemp(path_.data()); descriptor >= 0)
      close(descriptor);
    else
      path_.clear();
  }
  ~TemporaryFile() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// Only what the engine does is counted: libraries measure the clock while they start, in loops that never take the
/// same number of turns.
const char* const counted_function = "--toggle-collect=tyglab::SkipCase::advance(int)";

/// The number behind "totals: " in what callgrind wrote; empty if nothing was counted, as in a program without symbols.
std::optional<double> total_in(const std::string& file) {
  std::ifstream in(file);
  const std::string key = "totals: ";
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(key))
      if (const double total = std::stod(line.substr(key.size())); total > 0) return total;
  return {};
}

}  // namespace

InstructionCounter::InstructionCounter(fs::path tyglab) : tyglab_(std::move(tyglab)), valgrind_(on_path("valgrind")) {}

std::string InstructionCounter::instruction_set() const {
  const TemporaryFile file;
  if (!available() || file.path().empty() ||
      !run_silently({valgrind_, "--tool=none", tyglab_, "bench", "skip", "--only", "bending:on", "--side", "16",
                     "--steps", "1", "--json", file.path()}))
    return {};
  std::ifstream in(file.path());
  return nlohmann::json::parse(in)["machine"]["instruction_set"];
}

std::optional<double> InstructionCounter::per_particle_step(const CountedCase& which) const {
  const TemporaryFile counts;
  if (!available() || counts.path().empty() ||
      !run_silently({valgrind_, "--tool=callgrind", "--callgrind-out-file=" + counts.path(), "--collect-atstart=no",
                     counted_function, tyglab_, "bench", "skip", "--only",
                     which.feature + ":" + std::string(name_of(which.state)), "--precision",
                     std::string(name_of(which.precision)), "--side", std::to_string(side), "--steps",
                     std::to_string(steps)}))
    return {};
  const auto total = total_in(counts.path());
  if (!total) return {};
  return *total / steps / (side * side);
}

}  // namespace tyglab
