// The window with its OpenGL context, and Dear ImGui in it, as owning types.
#pragma once

#include <glad/gl.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <optional>
#include <string>

#include "app/base/input.h"
#include "app/base/settings.h"
#include "app/render/image.h"
#include "app/ui/frame/gui_input.h"
#include "core/engines/opencl/gl_context.h"

namespace tyglab {

/// Starts GLFW, which does nothing the second time. False where there is no display.
bool start_glfw();

/// One window with a current OpenGL 3.3 core context. Its callbacks fill `queue`, which must outlive it.
class Window {
 public:
  /// Throws GraphicsError where there is no display or no OpenGL 3.3.
  Window(int width, int height, const Settings& settings, InputQueue& queue);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  GLFWwindow* handle() const { return window_; }
  bool wants_close() const { return glfwWindowShouldClose(window_) != 0; }
  void forget_close() { glfwSetWindowShouldClose(window_, GLFW_FALSE); }
  bool iconified() const { return glfwGetWindowAttrib(window_, GLFW_ICONIFIED) != 0; }
  void set_title(const std::string& title);
  void toggle_full_screen();
  bool full_screen() const { return glfwGetWindowMonitor(window_) != nullptr; }

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
  struct Place {
    int x = 0, y = 0, width = 1280, height = 720;
  };
  Place place() const;
  void install_callbacks();

  GLFWwindow* window_ = nullptr;
  std::optional<GlContextInUse> gl_in_use_;  ///< OpenCL devices that are opened share buffers with it, if they can
  Place windowed_;
  std::string title_;
};

/// Dear ImGui's context with its GLFW and OpenGL backends.
class Gui {
 public:
  explicit Gui(GLFWwindow* window);
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
};

}  // namespace tyglab
