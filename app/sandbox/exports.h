// What the sandbox writes to files: a row each.
#pragma once

#include <filesystem>

#include "app/sandbox/requests.h"

namespace tyglab {

struct Export {
  const char* title;  ///< of the dialog
  const char* file;   ///< proposed
  const char* holds;  ///< what the file will hold, a sentence
  /// Throws OutputError, GraphicsError.
  void (*write)(const App& app, const std::filesystem::path& file);
};

const Export& export_of(ExportSource source);

}  // namespace tyglab
