// Dear ImGui in the window, as an owning type.
#pragma once

#include <optional>

#include "app/platform/window.h"
#include "app/ui/frame/gui_input.h"

namespace tyglab {

/// Dear ImGui's context with the platform's backend and OpenGL's.
class Gui {
 public:
  explicit Gui(Window& window);
  ~Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;
  /// Shows it what the queue holds.
  void begin_frame(InputQueue& input);
  /// Ends the frame and draws it.
  void draw();
  /// The font atlas was filled again.
  void fonts_changed();

 private:
  GuiInput input_;
  std::optional<GuiBackend> backend_;
};

}  // namespace tyglab
