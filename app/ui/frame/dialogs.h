// Questions and file dialogs above everything else.
#pragma once

#include <filesystem>
#include <string>

#include "app/ui/state/ui.h"

namespace tyglab {

struct Ui;

/// Opens a file dialog.
void open_dialog(Ui& ui, Dialog::Kind kind);
/// Asks a question; `then` is requested when it is answered with yes.
void ask(Ui& ui, Dialog::Kind kind, std::string question, Request then);
/// Opens the save dialog again with what went wrong.
void show_save_problem(Ui& ui, const std::filesystem::path& file, const std::string& name, const std::string& problem);
/// Draws the open dialog, if any.
void dialogs(Ui& ui);

}  // namespace tyglab
