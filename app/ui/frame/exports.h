// What the sandbox writes to files: a row each.
#pragma once

#include <filesystem>

#include "app/session/requests.h"

namespace tyglab {

struct Export {
  const char* title;  ///< of the dialog
  const char* holds;  ///< a sentence
  const char* file;   ///< proposed
  /// Throws OutputError, GraphicsError.
  void (*write)(App& app, const std::filesystem::path& file);
};

const Export& export_of(ExportSource source);

}  // namespace tyglab
