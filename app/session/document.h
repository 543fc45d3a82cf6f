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

/// Opens a preset, with these settings made in it; what goes wrong becomes a message and leaves everything as it was.
void open_document(Session& session, const std::filesystem::path& file, bool shipped,
                   const std::vector<std::string>& settings = {});
/// Asks for the preset that a link names (app/base/text.h), with its settings.
void open_link(Session& session, const std::string& link);
/// Opens these constants, which may differ from what the document has saved, beside the frames where that takes long.
/// Throws as Simulation does.
void reopen_document(Session& session, const Preset& preset, const Document& document);
/// Takes what has been built as the present cloth; what follows belongs to an edit, or to a preset that is opened.
void take_built(Session& session, std::unique_ptr<Simulation> simulation, BuildOrder order);
/// Why a preset could not be saved.
struct SaveProblem {
  std::filesystem::path file;
  std::string name, why;
};
/// Returns whether it was saved; if not, Session::not_saved holds the reason.
bool save_document_as(Session& session, const std::filesystem::path& file, const std::string& name);
/// A preset's simulation. Where its engine is not there, the CPU runs it, and `fallback` says why.
std::unique_ptr<Simulation> make_simulation(const Preset& preset, int threads, std::string& fallback);
/// Puts the session at the beginning of a preset: nothing to undo, a particle picked, its texture shown.
void begin_document(Session& session, Document document);

}  // namespace tyglab
