// Presets opened and saved.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "app/render/cloth_texture.h"
#include "app/session/rebuild.h"

namespace tyglab {

struct App;

/// Opens a preset, with these settings made in it; what goes wrong becomes a message and leaves everything as it was.
void open_document(App& app, const std::filesystem::path& file, bool shipped,
                   const std::vector<std::string>& settings = {});
/// Takes what has been built as the present cloth; what follows belongs to an edit, or to a preset that is opened.
void take_built(App& app, std::unique_ptr<Simulation> simulation, const BuildOrder& order);
/// Saves to the document's file, or opens the dialog where it has none.
void save_document(App& app);
/// Returns whether it was saved; if not, the save dialog is open again with the reason.
bool save_document_as(App& app, const std::filesystem::path& file, const std::string& name);
/// A preset's simulation. Where its engine is not there, the CPU runs it, and `fallback` says why.
std::unique_ptr<Simulation> make_simulation(const Preset& preset, int threads, std::string& fallback);
/// The picture that a preset's cloth shows, or a sentence about what is wrong with it.
using FoundPicture = std::variant<ClothPicture, std::string>;
FoundPicture find_picture(const Preset& preset);
/// Puts the sandbox at the beginning of a preset: nothing to undo, a particle picked, its picture, its view.
void begin_document(App& app, const Document& document, const FoundPicture& picture);

}  // namespace tyglab
