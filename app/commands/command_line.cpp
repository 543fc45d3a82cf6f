#include "app/commands/command_line.h"

#include <unistd.h>

#include <filesystem>
#include <iostream>
#include <new>

#include "app/data_files.h"
#include "app/viewport/graphics_error.h"
#include "core/engines/engine.h"
#include "core/notation/preset_io.h"

namespace tyglab {
namespace fs = std::filesystem;

int exit_of_parsing(const CLI::App& program, const CLI::ParseError& error) {
  return program.exit(error) == 0 ? exit_done : exit_command_line;
}

int run_action(const Action& action) {
  const auto say = [](const std::string& what, ExitCode code) {
    std::cerr << "tyglab: " << what << '\n';
    return code;
  };
  try {
    const int code = action();
    if (!std::cout.flush()) throw OutputError("standard output cannot be written");
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

void require_writable(const std::string& file) {
  std::error_code error;
  const fs::path path(file);
  if (fs::is_directory(path, error)) throw OutputError(file + ": is a folder; name a file in it");
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, error))
    throw OutputError(file + ": the folder " + folder.string() + " is not there; make it first (mkdir -p)");
  if (::access(folder.c_str(), W_OK) != 0)
    throw OutputError(file + ": nothing may be written in " + folder.string() + "; choose another folder");
}

}  // namespace tyglab
