// The start of a window: settings, options, the first cloth and its picture; and the state that the window saves for
// the next start.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "app/base/files.h"
#include "app/base/settings.h"
#include "app/render/cloth_texture.h"
#include "app/shell/sandbox.h"
#include "app/ui/state/ui.h"

namespace tyglab {

/// The settings of earlier sessions; what is wrong with them becomes a message.
Settings settings_for(const SandboxOptions& options, Messages& messages);
/// Applies options and settings to session, scene and panels.
void take_options(const SandboxOptions& options, Ui& ui);

/// Stores the state for the next session in the settings.
void remember_session(Ui& ui);

/// The picture that a preset's cloth shows, or a sentence about what is wrong with it.
using FoundPicture = std::variant<ClothPicture, std::string>;
FoundPicture find_picture(const std::string& texture);

/// The first cloth in the window and its picture.
struct InitialScene {
  std::shared_ptr<Simulation> simulation;
  std::string fallback;  ///< why it runs on another engine than it asks for; empty: it does not
  FoundPicture picture;
  std::optional<FileStamp> picture_file;  ///< as it was before it was read
};
/// Builds it while the window opens. `whole`: on the preset's own engine; a device that shares buffers with OpenGL
/// needs the window first, and then there is no simulation yet. Otherwise the CPU engine shows what is to run on a
/// device.
InitialScene build_initial_scene(const Preset& preset, int threads, bool whole);

}  // namespace tyglab
