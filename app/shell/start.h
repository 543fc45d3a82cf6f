// What the sandbox begins with, before there is a window.
#pragma once

#include "app/shell/sandbox.h"
#include "app/ui/app.h"

namespace tyglab {

/// The settings, which size the window, and what the command line says.
App start_app(const SandboxOptions& options);

}  // namespace tyglab
