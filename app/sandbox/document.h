// Presets opened and saved.
#pragma once

#include <filesystem>
#include <string>

#include "core/notation/preset.h"

namespace tyglab {

struct App;

/// Opens a preset; what goes wrong becomes a message and leaves everything as it was.
void open_document(App& app, const std::filesystem::path& file, bool shipped);
/// Takes a preset as the document, at its start. Falls back to the CPU where its engine is not there.
void take_document(App& app, const Preset& preset);
/// Saves to the document's file, or opens the dialog where it has none.
void save_document(App& app);
/// Returns whether it was saved; if not, the save dialog is open again with the reason.
bool save_document_as(App& app, const std::filesystem::path& file, const std::string& name);
/// Makes the simulation of a preset; falls back to the CPU in float where the engine is not there.
void make_simulation(App& app, const Preset& preset);

}  // namespace tyglab
