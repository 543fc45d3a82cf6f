// Opens and saves presets.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/session/rebuild.h"

namespace tyglab {

struct Session;

/// Opens a preset with these settings; an error becomes a message and changes nothing.
void open_document(Session& session, const std::filesystem::path& file, bool shipped,
                   const std::vector<std::string>& settings = {});
/// Requests the preset that a link names (app/base/text.h), with its settings.
void open_link(Session& session, const std::string& link);
/// Opens these constants, which may differ from the saved document, in the background if that takes long. Throws as
/// Simulation does.
void reopen_document(Session& session, const Preset& preset, const Document& document);
/// Makes a built cloth the present one, with the consequences of an edit or of an opened preset.
void take_built(Session& session, std::unique_ptr<Simulation> simulation, BuildOrder order);
/// Why a preset could not be saved.
struct SaveProblem {
  std::filesystem::path file;
  std::string name, why;
};
/// Returns whether it was saved; if not, Session::not_saved holds the reason.
bool save_document_as(Session& session, const std::filesystem::path& file, const std::string& name);
/// The simulation of a preset. If its engine is missing, the CPU engine runs it, and `fallback` is the reason.
std::unique_ptr<Simulation> make_simulation(const Preset& preset, int threads, std::string& fallback);
/// Sets the session to the beginning of a preset: without undo history, with a picked particle and the texture.
void begin_document(Session& session, Document document);

}  // namespace tyglab
