// Questions and file dialogs over everything else.
#pragma once

#include <filesystem>
#include <string>

#include "app/ui/frame/ui_state.h"

namespace tyglab {

struct App;

/// Opens a file dialog.
void open_dialog(App& app, Dialog::Kind kind);
/// Asks a question; `then` is requested when it is answered with yes.
void ask(App& app, Dialog::Kind kind, std::string question, Request then);
/// Opens the save dialog again with what went wrong.
void show_save_problem(App& app, const std::filesystem::path& file, const std::string& name,
                       const std::string& problem);
/// Draws the open dialog, if any.
void dialogs(App& app);

}  // namespace tyglab
