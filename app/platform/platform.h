// Functions that differ between systems: linux/, windows/ (both with desktop/) and web/ implement them.
#pragma once

#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "app/base/image.h"
#include "app/base/input.h"
#include "app/base/settings.h"
#include "core/engines/opencl/opencl_devices.h"

// The address of the page with the link to the experiment. Other platforms have none.

namespace tyglab {

/// The beginning of a copied link, "https://host/path/"; empty outside the page.
std::string page_address();
/// Shows a link ("#hanging&k_s=100") in the address bar, where there is one, with the lab that is played (empty: none)
/// and its step, counted from 1; as a further place that the browser goes back from, or in place of the present one.
void show_in_address(const std::string& link, const std::string& lab, int step, bool further);

// Advice about graphics for the users of this system.

/// A sentence for those whose driver has no OpenGL 3.3.
const char* driver_advice();
/// A sentence for those without a display.
const char* display_advice();

// Background work without threads: the memory of a page belongs to one thread, but a worker can receive a copy of it,
// and with it of the whole running program. The results of the copy return as bytes.

/// Whether this platform uses copies of the program in place of threads.
bool works_in_copies();

/// A copy of the program that does one piece of work.
class Copy {
 public:
  using Report = std::function<void(std::string_view bytes)>;

  /// Begins `work(report)` in a copy; `take` is called here, between frames, with each report, in order. What the work
  /// changes elsewhere, the copy alone sees. Only where works_in_copies().
  Copy(std::function<void(const Report& report)> work, Report take);
  /// Ends the work at any point.
  ~Copy();
  Copy(const Copy&) = delete;
  Copy& operator=(const Copy&) = delete;

 private:
  friend struct CopyCalls;
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// The current OpenGL context, in the form that OpenCL requires.

/// Of this thread. `address`: finds the window system's functions by their names. Without a context, or under another
/// window system than EGL or GLX, its `context` is null.
GlContext current_gl_context(void (*(*address)(const char* name))());

// The user's files: on a desktop these are files of the system; in a page the browser transfers
// them.

/// Whether written files must be handed to the user, and files to read requested from the user.
bool files_are_handed_out();
/// Hands a written file to the user: the browser downloads it. On other platforms it does nothing.
void hand_out(const std::filesystem::path& file);
/// Asks the user for a file with one of these endings (".json,.png"); it arrives like a dropped file.
void ask_for_file(const std::string& endings);
/// Whether the clipboard accepted the last text; a page that may not use the clipboard shows the text instead.
bool clipboard_took();
/// Stores the small files of a folder and its subfolders for the next session, on platforms that would lose them.
/// Throws OutputError.
void keep_files(const std::filesystem::path& folder);

// OpenGL without a window or a display.

/// An OpenGL 3.3 core context on EGL's surfaceless platform (Mesa), or of a hidden window of Windows, current in this
/// thread while the object lives. OpenCL devices that are opened meanwhile share buffers with it, if they can.
class HeadlessContext {
 public:
  /// Makes it and loads the functions. Throws GraphicsError that says what to install.
  HeadlessContext();
  ~HeadlessContext();
  HeadlessContext(const HeadlessContext&) = delete;
  HeadlessContext& operator=(const HeadlessContext&) = delete;

 private:
  [[maybe_unused]] void* display_ = nullptr;  // not on every platform
  [[maybe_unused]] void* context_ = nullptr;
  std::optional<GlContextInUse> in_use_;
};

// The frame loop: a desktop program runs it, and a browser calls it.

/// The work of each frame, and of the end of the program.
class FrameLoop {
 public:
  FrameLoop() = default;
  virtual ~FrameLoop() = default;
  FrameLoop(const FrameLoop&) = delete;
  FrameLoop& operator=(const FrameLoop&) = delete;
  /// Runs one frame; returns false after the last one.
  virtual bool run_frame() = 0;
  /// Ends the program after the last frame, and returns its exit code.
  virtual int finish() = 0;
  /// Saves unsaved data before the program may end without notice, such as a page that is left.
  virtual void leave() {}
};

/// Runs all frames and returns the result of finish(). A browser runs the frames after this function has returned 0.
int run_frame_loop(std::unique_ptr<FrameLoop> loop);

// Background threads.

/// Lowers the priority of the calling thread, where the system can.
void lower_own_priority();

// The window with its OpenGL context. Its implementation depends on the platform: GLFW on desktops
// (app/platform/desktop), a page's canvas in a browser (app/platform/web).

/// Whether a window can be opened here.
bool display_there();

/// s since some moment of this program: the time of events and frames.
double window_time();

/// Whether the user's browser requests a light color scheme, or reduced motion; false on a desktop.
bool prefers_light();
bool prefers_little_motion();

/// One window with a current OpenGL context: 3.3 core, or WebGL 2. Its events go to `queue`, which must outlive it.
class Window {
 public:
  /// With a width of 0: as large as in the last session. Throws GraphicsError where there is no display or no OpenGL.
  Window(int width, int height, const Settings& settings, InputQueue& queue);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Processes events; waits for them for at most that time, s. A browser never waits.
  void take_events(double wait);
  /// Shows the drawn frame.
  void swap();
  /// Whether swap() waits for the screen, where that can be chosen.
  void wait_for_screen(bool waits);

  bool wants_close() const;
  void forget_close();
  /// Whether it is invisible: iconified, or a page in the background.
  bool hidden() const;
  void set_title(const std::string& title);
  /// Text for screen readers: "state", "time" or "messages". Only a page supports it.
  void tell(const std::string& part, const std::string& words);
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

/// The platform's part of Dear ImGui, in its current context: size and time of a frame, clipboard, the pointer's shape,
/// drawing. Events come by the window's queue.
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
