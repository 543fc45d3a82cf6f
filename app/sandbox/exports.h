// What the sandbox writes as CSV: a row each.
#pragma once

#include <string>

#include "app/sandbox/requests.h"

namespace tyglab {

struct CsvExport {
  const char* title;  ///< of the dialog
  const char* holds;  ///< a sentence
  const char* file;   ///< proposed
  std::string (*text)(App& app);
};

const CsvExport& csv_export(CsvSource source);

}  // namespace tyglab
