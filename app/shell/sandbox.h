// The sandbox: a window for simulating a preset and working with it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/scene/effects.h"
#include "core/fields/particle_field.h"
#include "core/model/preset.h"

namespace tyglab {

struct SandboxOptions {
  Preset preset;
  std::string preset_label;              ///< shipped name or file name, for the title
  std::filesystem::path preset_path;     ///< empty if the preset does not come from a user's file
  bool explicit_preset = false;          ///< otherwise the last session's preset is restored
  int threads = 1;                       ///< of the CPU engine, at most
  bool auto_dt = false;                  ///< dt is chosen and watched (AutoStep)
  int frames = 0;                        ///< ends after that many frames; 0: until the window is closed
  std::filesystem::path screenshot;      ///< PNG of the last frame, empty: none
  std::filesystem::path time_report;     ///< JSON of the frame's cost by part, empty: none
  std::filesystem::path session_report;  ///< JSON of what goes on, rewritten all the time, empty: none
  std::optional<ParticleField> color;    ///< what colors the cloth; none: as in the last session
  std::optional<Effects::Mode> effects;  ///< none: all with `frames`, else as in the last session
  std::string lab;                       ///< that is begun, by its label; empty: none
  bool panels = true;                    ///< are shown
  int width = 0, height = 0;             ///< of the window; 0: as in the last session
};

/// Runs until the window is closed or the frames are done. Returns an exit code: 0; 5 without a display or OpenGL 3.3;
/// 6 if the screenshot or a report could not be written; 130 when interrupted.
int run_sandbox(const SandboxOptions& options);

}  // namespace tyglab
