// Generates docs/integrators.md from the table of methods.
#pragma once

#include <string>

namespace tyglab {

/// The page, in Markdown.
std::string integrators_markdown();

}  // namespace tyglab
