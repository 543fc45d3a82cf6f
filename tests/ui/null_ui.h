// The whole user interface without a window and without OpenGL: Dear ImGui draws into lists that nobody shows. Events
// go in; the session, the controls with their places, and the text that was drawn come out.
#pragma once

#include <imgui.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "app/ui/frame/frame.h"
#include "app/ui/kit/widgets.h"
#include "tests/app/desk.h"
#include "tests/support/files.h"

namespace tyglab::test {

struct UiOptions {
  std::string preset = "hanging";                              ///< a shipped one
  std::function<void(Preset&)> with = [](Preset&) {};          ///< changes to it
  glm::ivec2 size{1280, 720};                                  ///< of the window, pixels
  std::function<void(Settings&)> settings = [](Settings&) {};  ///< changes to the settings
  bool patient = true;                                         ///< all steps that are due are made (Pacing)
};

/// Also knows which controls are seen only in part.
class SeenPlaces : public ControlPlaces {
 public:
  void add_control(std::string_view name) override;
  void end_frame();
  const std::set<std::string>& cut_at_sides() const { return cut_; }

 private:
  std::set<std::string> drawing_cut_, cut_;
};

class NullUi : public Desk {
 public:
  explicit NullUi(const UiOptions& options = {});
  ~NullUi();
  NullUi(const NullUi&) = delete;
  NullUi& operator=(const NullUi&) = delete;

  /// Does what the window does in a frame, a 60th of a second after the last one.
  void frame();
  void frames(int count);
  std::function<void(const PictureOrder&)> on_picture;  ///< called for each image that a frame would save
  std::function<void(double seconds)> after_frame;      ///< called after each, with the wall time that it took
  /// Frames until the condition holds. Fails the test where it never does.
  void until(const std::function<bool()>& condition, std::string_view what);

  void resize(glm::ivec2 size);

  /// What GLFW tells of text that is typed, before the next frame.
  void add_typed(std::string_view text);

  /// GLFW's key and modifiers: goes down, and up in the next frame.
  void key(int key, int mods = 0);
  void type(std::string_view text);
  void move(glm::vec2 to);
  void press(int button = 0);
  void release(int button = 0);
  void wheel(float y);
  void click(glm::vec2 at, int button = 0);
  void double_click(glm::vec2 at);
  /// Presses at the first, moves to the others, lets go at the last.
  void drag(std::initializer_list<glm::vec2> way, int button = 0);
  /// To where it touches nothing.
  void rest();

  /// Where a control is, once it stands still; fails the test where it is not seen.
  Box control(const std::string& name);
  glm::vec2 middle(const std::string& name);
  /// The name of the first control that begins so; fails the test where there is none.
  std::string control_beginning(const std::string& start) const;
  /// All that are seen now, pixels of the window.
  const std::map<std::string, Box>& controls() const { return places_.shown(); }
  /// Of those that are seen, the ones that the left or right edge of their panel cuts.
  const std::set<std::string>& cut_at_sides() const { return places_.cut_at_sides(); }
  bool sees(const std::string& name) const { return places_.shown().contains(name); }
  void click(const std::string& name, int button = 0) { click(middle(name), button); }
  /// The point at that part of a slider, 0 at its left end, 1 at its right.
  glm::vec2 along(const std::string& slider, float part);
  /// Turns the pages of a lab until the control is seen.
  void turn_to(const std::string& name);
  /// Turns the wheel over another control, downwards, until the control is seen.
  void scroll_to(const std::string& name, const std::string& over);
  /// Types the value of a constant after Ctrl+click; the key ends it. One that is refused is given up by Escape.
  void type_value(const std::string& constant, std::string_view text, int end = enter);
  /// Does what the palette finds first.
  void find(std::string_view text);
  /// Replaces the text of a dialog's field.
  void fill(const std::string& field, std::string_view text);
  /// Adds a copy by an item of the card's menu.
  void add_copy(const std::string& item);

  /// In the dialog that asks for an export's file: writes it, and returns its path.
  std::filesystem::path write_export(const std::string& name);

  /// Whether the last frame drew this text, wherever lines were broken.
  bool drew(std::string_view text) const;
  /// Texts of the last frame of which a letter is cut at the left or right, or at the top or bottom of what does not
  /// scroll: "region: text".
  std::vector<std::string> cut_texts() const;
  bool said(std::string_view part) const;  ///< by a message
  bool typing() const;                     ///< a text field takes keys
  std::optional<Box> tooltip() const;
  const Preset& preset() const { return session.preset(); }
  Simulation& cloth() { return *session.simulation; }
  double t() const { return session.simulation->time(); }
  std::int64_t steps() const { return session.simulation->steps(); }
  bool paused() const { return !session.pacing.playing; }
  void pause();
  bool diverged() const { return session.simulation->divergence().has_value(); }
  int torn() const { return int(session.simulation->tears().torn_count()); }
  /// Where a particle is seen, pixels of the window.
  glm::vec2 pixel_of(int i, int j);

  static constexpr int enter = 257, escape = 256;  // as GLFW has them
  static constexpr double frame_time = 1.0 / 60;   // s
  TemporaryFolder config;

 private:
  void apart();
  std::string drawn_text() const;

  ImGuiContext* context_;
  GuiInput gui_input_;
  SeenPlaces places_;
};

}  // namespace tyglab::test
