// The sandbox: a window for simulating a preset and working with it.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "app/base/messages.h"
#include "app/base/settings.h"
#include "app/platform/platform.h"
#include "app/scene/effects.h"
#include "app/studies/job.h"
#include "app/ui/frame/frame.h"
#include "core/fields/particle_field.h"
#include "core/model/preset.h"

namespace tyglab {

struct Experiment;

struct SandboxOptions {
  Preset preset;
  std::string preset_label;                      ///< shipped name or file name, for the title
  std::shared_ptr<const Experiment> experiment;  ///< to be repeated, from the preset on; null: none
  std::filesystem::path preset_path;             ///< empty if the preset does not come from a user's file
  bool explicit_preset = false;                  ///< otherwise the last session's preset is restored
  int threads = 1;                               ///< of the CPU engine, at most
  bool auto_dt = false;                          ///< dt is chosen and watched (AutoStep)
  int frames = 0;                                ///< ends after that many frames; 0: until the window is closed
  std::filesystem::path screenshot;              ///< PNG of the last frame, empty: none
  std::filesystem::path time_report;             ///< JSON of the frame's cost by part, empty: none
  std::filesystem::path record;                  ///< the experiment, written at the end; empty: none
  std::filesystem::path session_report;          ///< JSON of what goes on, rewritten all the time, empty: none
  std::optional<ParticleField> color;            ///< what colors the cloth; none: as in the last session
  std::optional<Effects::Mode> effects;          ///< none: all with `frames`, else as in the last session
  std::string lab;                               ///< that is begun, by its label; empty: none
  int lab_step = 0;                              ///< its step, counted from 1; 0: where it was left
  bool panels = true;                            ///< are shown
  int width = 0, height = 0;                     ///< of the window; 0: as in the last session
};

/// Runs until the window is closed or the frames are done. Returns an exit code: 0; 5 without a display or OpenGL 3.3;
/// 6 if the screenshot or a report could not be written; 130 when interrupted.
int run_sandbox(const SandboxOptions& options);

// Dear ImGui in the window, as an owning type.

/// Dear ImGui's context with the platform's backend and OpenGL's.
class Gui {
 public:
  explicit Gui(Window& window);
  ~Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;
  /// Shows it what the queue holds, unless the frame is `bare` (Ui::bare()).
  void begin_frame(InputQueue& input, bool bare);
  /// Ends the frame and draws it.
  void draw();
  /// To be called after the font atlas was filled again.
  void fonts_changed();

 private:
  GuiInput input_;
  std::optional<GuiBackend> backend_;
};

// Writes settings to disk while the window is open, so nothing is lost however the window ends.

/// Writes settings beside the frames, within a second of a change.
class SettingsWriter {
 public:
  /// `known`: what this program has read from the file.
  explicit SettingsWriter(Settings known) : known_(std::move(known)) {}
  /// To be called often; `now` is in s. Begins to write what `present` returns where that has changed. Returns
  /// whether there is a message, once, that it cannot be written.
  bool update(double now, const std::function<Settings()>& present, Messages& messages);
  /// Writes the last settings. Throws OutputError.
  void finish(const Settings& last);

 private:
  using Written = std::variant<Settings, std::string>;  ///< what stands in the file now, or why it does not

  /// Takes the outcome of the work, waiting for it; why it failed, or nothing.
  std::string take();

  Settings known_;  ///< as this program read or wrote it last
  Job<Written> job_;
  double next_ = 0;  ///< s, not before which it looks again
  std::string problem_;
};

}  // namespace tyglab
