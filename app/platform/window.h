// The window with its OpenGL context. Its implementation depends on the platform: GLFW on desktops
// (app/platform/desktop), a page's canvas in a browser (app/platform/web).
#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <string>

#include "app/base/input.h"
#include "app/base/settings.h"
#include "app/render/image.h"

namespace tyglab {

/// Whether a window can be opened here.
bool display_there();

/// s since some moment of this program: the time of events and frames.
double window_time();

/// One window with a current OpenGL context: 3.3 core, or WebGL 2. Its events go to `queue`, which must outlive it.
class Window {
 public:
  /// With a width of 0: as large as in the last session. Throws GraphicsError where there is no display or no OpenGL.
  Window(int width, int height, const Settings& settings, InputQueue& queue);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Takes what has happened; waits that long for it, s, unless it is there. A browser never waits.
  void take_events(double wait);
  /// Shows what has been drawn.
  void swap();
  /// Whether swap() waits for the screen, where that can be chosen.
  void wait_for_screen(bool waits);

  bool wants_close() const;
  void forget_close();
  /// Whether nobody sees it: iconified, or a page in the background.
  bool hidden() const;
  void set_title(const std::string& title);
  /// What goes on, in words, for screen readers; a page alone can say it.
  void tell(const std::string& state);
  void toggle_full_screen();
  bool full_screen() const;

  glm::ivec2 size() const;
  glm::ivec2 framebuffer_size() const;
  /// Text scale that the monitor asks for, in window coordinates. A tall monitor that asks for none gets 1.25.
  float content_scale() const;
  /// Seconds between two frames of its monitor.
  double frame_time() const;
  /// Place and size for the next session; a full-screen window tells those it had before.
  void remember(Settings& settings) const;
  /// The back buffer.
  Image pixels() const;

 private:
  friend class GuiBackend;
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// What Dear ImGui has of the platform, in its current context: size and time of a frame, clipboard, the pointer's
/// shape, drawing. Events come by the window's queue.
class GuiBackend {
 public:
  explicit GuiBackend(Window& window);
  ~GuiBackend();
  GuiBackend(const GuiBackend&) = delete;
  GuiBackend& operator=(const GuiBackend&) = delete;
  /// Before ImGui::NewFrame().
  void begin_frame();
};

}  // namespace tyglab
