#include "tests/ui/null_ui.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <map>
#include <memory>
#include <thread>
#include <utility>

#include "app/base/glfw_keys.h"
#include "app/base/preset_files.h"
#include "app/session/document.h"
#include "app/ui/frame/frame.h"
#include "app/ui/kit/imgui_compat.h"
#include "core/fields/particle_field.h"
#include "core/io/preset_io.h"

namespace tyglab::test {
namespace {

constexpr double ui_frame_time = 1.0 / 60;         // s
constexpr std::chrono::seconds longest_wait{100};  // far above what a loaded machine takes
constexpr int settled = 3;                         // frames after which a layout stands still

/// Dear ImGui's keys that text fields know.
constexpr std::array known_keys{
    std::pair{ImGuiKey_Tab, GLFW_KEY_TAB},
    std::pair{ImGuiKey_LeftArrow, GLFW_KEY_LEFT},
    std::pair{ImGuiKey_RightArrow, GLFW_KEY_RIGHT},
    std::pair{ImGuiKey_UpArrow, GLFW_KEY_UP},
    std::pair{ImGuiKey_DownArrow, GLFW_KEY_DOWN},
    std::pair{ImGuiKey_PageUp, GLFW_KEY_PAGE_UP},
    std::pair{ImGuiKey_PageDown, GLFW_KEY_PAGE_DOWN},
    std::pair{ImGuiKey_Home, GLFW_KEY_HOME},
    std::pair{ImGuiKey_End, GLFW_KEY_END},
    std::pair{ImGuiKey_Delete, GLFW_KEY_DELETE},
    std::pair{ImGuiKey_Backspace, GLFW_KEY_BACKSPACE},
    std::pair{ImGuiKey_Enter, GLFW_KEY_ENTER},
    std::pair{ImGuiKey_Escape, GLFW_KEY_ESCAPE},
    std::pair{ImGuiKey_A, GLFW_KEY_A},
    std::pair{ImGuiKey_C, GLFW_KEY_C},
    std::pair{ImGuiKey_V, GLFW_KEY_V},
    std::pair{ImGuiKey_X, GLFW_KEY_X},
    std::pair{ImGuiKey_Y, GLFW_KEY_Y},
    std::pair{ImGuiKey_Z, GLFW_KEY_Z},
};

void map_keys() {
#if IMGUI_VERSION_NUM < 18700
  for (const auto& [gui, glfw] : known_keys) ImGui::GetIO().KeyMap[gui] = glfw;
#endif
}

void show_key(int key, bool down) {
#if IMGUI_VERSION_NUM < 18700
  ImGui::GetIO().KeysDown[key] = down;
#else
  for (const auto& [gui, glfw] : known_keys)
    if (glfw == key) ImGui::GetIO().AddKeyEvent(gui, down);
#endif
}

void show_mods(int mods) {
  ImGuiIO& io = ImGui::GetIO();
#if IMGUI_VERSION_NUM < 18700
  io.KeyCtrl = (mods & GLFW_MOD_CONTROL) != 0;
  io.KeyShift = (mods & GLFW_MOD_SHIFT) != 0;
  io.KeyAlt = (mods & GLFW_MOD_ALT) != 0;
#else
  io.AddKeyEvent(ImGuiMod_Ctrl, (mods & GLFW_MOD_CONTROL) != 0);
  io.AddKeyEvent(ImGuiMod_Shift, (mods & GLFW_MOD_SHIFT) != 0);
  io.AddKeyEvent(ImGuiMod_Alt, (mods & GLFW_MOD_ALT) != 0);
#endif
}

/// Fonts of one scale, which all tests share: to build them takes longer than most tests.
struct BuiltFonts {
  std::unique_ptr<ImFontAtlas> atlas = std::make_unique<ImFontAtlas>();
  Fonts fonts;
  std::map<std::pair<float, float>, ImWchar> letters;  ///< by a corner of their picture in the atlas
};

const BuiltFonts& fonts_of(float scale) {
  static std::map<float, BuiltFonts> built;
  const auto [it, fresh] = built.try_emplace(scale);
  BuiltFonts& out = it->second;
  ImGui::GetIO().Fonts = out.atlas.get();
  if (!fresh) return out;
  out.fonts = build_fonts(scale);
  unsigned char* pixels = nullptr;
  int width = 0, height = 0;
  out.atlas->GetTexDataAsAlpha8(&pixels, &width, &height);
  for (const ImFont* font : out.atlas->Fonts)
    for (const ImFontGlyph& glyph : font->Glyphs)
      if (glyph.Visible) out.letters[{glyph.U0, glyph.V0}] = ImWchar(glyph.Codepoint);
  return out;
}

void append_utf8(std::string& out, unsigned c) {
  if (c < 0x80) {
    out += char(c);
  } else if (c < 0x800) {
    out += char(0xC0 | c >> 6), out += char(0x80 | (c & 0x3F));
  } else {
    out += char(0xE0 | c >> 12), out += char(0x80 | (c >> 6 & 0x3F)), out += char(0x80 | (c & 0x3F));
  }
}

std::string without_spaces(std::string_view text) {
  std::string out(text);
  std::erase_if(out, [](char c) { return c == ' ' || c == '\n'; });
  return out;
}

Preset first_preset(const UiOptions& options) {
  Preset preset = load_preset(find_preset(options.preset).file);
  options.with(preset);
  return preset;
}

}  // namespace

NullUi::NullUi(const UiOptions& options) : context_(nullptr) {
  setenv("TYGLAB_CONFIG_DIR", config.path().c_str(), 1);
  static ImFontAtlas none;  // a context that has one given owns none
  context_ = ImGui::CreateContext(&none);
  ImGui::SetCurrentContext(context_);
  ImGuiIO& io = ImGui::GetIO();
  gui::prepare_io(io);
  map_keys();
  io.DisplaySize = ImVec2(float(options.size.x), float(options.size.y));
  io.DeltaTime = float(ui_frame_time);
  settings.tour_seen = true;
  options.settings(settings);
  ui.controls = &places_;
  session.labs.progress = settings.labs;
  const Preset preset = first_preset(options);
  std::string fallback;
  session.simulation = make_simulation(preset, 1, fallback);
  begin_document(session, {preset, options.preset, {}});
  scene.colors.choose(field_called(settings.color));
  follow_session(ui);
  frames(settled);
}

NullUi::~NullUi() {
  ImGui::DestroyContext(context_);
  unsetenv("TYGLAB_CONFIG_DIR");
}

void NullUi::frame() {
  ui.now = tools.now = ui.now + ui_frame_time;
  if (take_look(ui, 1)) ui.fonts = fonts_of(ui.theme.scale).fonts;
  act_on_events(ui, ui_frame_time, ui_frame_time);
  scene.draw({1, 1});
  ImGui::NewFrame();
  draw_panels(ui);
  ImGui::Render();
  drawn_ = drawn_text();
  end_gestures(ui);
  places_.end_frame();
  input.clear();
}

void NullUi::frames(int count) {
  for (int n = 0; n < count; ++n) frame();
}

void NullUi::until(const std::function<bool()>& condition, std::string_view what) {
  const auto end = std::chrono::steady_clock::now() + longest_wait;
  for (int n = 0; !condition(); ++n) {
    if (std::chrono::steady_clock::now() > end) FAIL("waited in vain for ", std::string(what));
    if (n > 50) std::this_thread::sleep_for(std::chrono::milliseconds(1));  // other threads are at work
    frame();
  }
}

void NullUi::key(int key, int mods) {
  input.keys.push_back({key, mods, false});
  show_mods(mods);
  show_key(key, true);
  frame();
  show_key(key, false);
  show_mods(0);
  frame();
}

void NullUi::type(std::string_view text) {
  for (const char letter : text)
    if (std::isalnum(static_cast<unsigned char>(letter)) != 0)
      input.keys.push_back({std::toupper(static_cast<unsigned char>(letter)), 0, false});
  ImGui::GetIO().AddInputCharactersUTF8(std::string(text).c_str());
  frames(2);
}

void NullUi::push(PointerEvent::Type type, int button, glm::vec2 wheel) {
  input.pointer.push_back({type, button, input.mods, input.at, wheel, ui.now});
  input.anything = true;
}

void NullUi::move(glm::vec2 to) {
  input.at = to;
  push(PointerEvent::Type::move, 0);
#if IMGUI_VERSION_NUM < 18700
  ImGui::GetIO().MousePos = {to.x, to.y};
#else
  ImGui::GetIO().AddMousePosEvent(to.x, to.y);
#endif
  frame();
}

void NullUi::press(int button) {
  if (button == GLFW_MOUSE_BUTTON_LEFT) input.note_left_press(ui.now);
  push(PointerEvent::Type::press, button);
#if IMGUI_VERSION_NUM < 18700
  ImGui::GetIO().MouseDown[button] = true;
#else
  ImGui::GetIO().AddMouseButtonEvent(button, true);
#endif
  frames(2);
}

void NullUi::release(int button) {
  push(PointerEvent::Type::release, button);
#if IMGUI_VERSION_NUM < 18700
  ImGui::GetIO().MouseDown[button] = false;
#else
  ImGui::GetIO().AddMouseButtonEvent(button, false);
#endif
  frames(2);
}

void NullUi::wheel(float y) {
  push(PointerEvent::Type::wheel, 0, {0, y});
#if IMGUI_VERSION_NUM < 18700
  ImGui::GetIO().MouseWheel += y;
#else
  ImGui::GetIO().AddMouseWheelEvent(0, y);
#endif
  frames(2);
}

/// Presses that follow each other count by themselves, not as a double click.
void NullUi::apart() {
  if (input.last_press >= 0 && ui.now - input.last_press < 1) frames(60);
}

void NullUi::click(glm::vec2 at, int button) {
  apart();
  move(at);
  press(button);
  release(button);
  frames(settled);
}

void NullUi::double_click(glm::vec2 at) {
  apart();
  move(at);
  for (int n = 0; n < 2; ++n) press(), release();
  frames(settled);
}

void NullUi::drag(std::initializer_list<glm::vec2> way, int button) {
  apart();
  move(*way.begin());
  press(button);
  for (const glm::vec2& point : way) move(point);
  frames(2);
  release(button);
}

void NullUi::rest() {
  const Box& box = ui.viewport.box;
  move({(box.lo.x + box.hi.x) / 2, box.hi.y + 15});
  frames(2);
}

Box NullUi::control(const std::string& name) {
  until([&] { return sees(name); }, "the control " + name + " to be seen");
  for (;;) {
    const auto before = places_.shown();
    frames(settled);
    const auto was = before.find(name), is = places_.shown().find(name);
    if (is == places_.shown().end()) FAIL("the control ", name, " is gone again");
    if (was != before.end() && was->second.lo == is->second.lo && was->second.hi == is->second.hi) return is->second;
  }
}

std::string NullUi::control_beginning(const std::string& start) const {
  const auto first = places_.shown().lower_bound(start);
  if (first == places_.shown().end() || !first->first.starts_with(start)) FAIL("no control begins with ", start);
  return first->first;
}

glm::vec2 NullUi::middle(const std::string& name) {
  const Box box = control(name);
  return (box.lo + box.hi) / 2.f;
}

glm::vec2 NullUi::along(const std::string& slider, float part) {
  const Box box = control(slider);
  return {box.lo.x + 1 + part * (box.hi.x - box.lo.x - 2), (box.lo.y + box.hi.y) / 2};
}

void NullUi::scroll_to(const std::string& name, const std::string& over) {
  move(middle(over));
  for (int n = 0; n < 40 && !sees(name); ++n) wheel(-1), frames(settled);
  if (!sees(name)) FAIL("the wheel does not bring ", name, " into sight");
}

void NullUi::type_value(const std::string& constant, std::string_view text, int end) {
  const glm::vec2 at = middle("constants." + constant + ".value");
  apart();
  move(at);
  input.mods = GLFW_MOD_CONTROL;
  show_mods(GLFW_MOD_CONTROL);
  press();
  release();
  input.mods = 0;
  show_mods(0);
  until([&] { return typing(); }, "the number to become a text field");
  frames(2);
  type(text);
  key(end);
  until([&] { return !typing(); }, "the text field to close");
  frames(2);
}

void NullUi::find(std::string_view text) {
  key(GLFW_KEY_P, GLFW_MOD_CONTROL);
  until([&] { return ui.palette.open && typing(); }, "the palette to take keys");
  type(text);
  key(enter);
  until([&] { return !ui.palette.open; }, "the palette to close");
  frames(settled);
}

void NullUi::fill(const std::string& field, std::string_view text) {
  click("dialog." + field);
  key(GLFW_KEY_A, GLFW_MOD_CONTROL);
  type(text);
}

void NullUi::add_copy(const std::string& item) {
  const std::size_t before = session.copies.lockstep.size();
  click("plots.add");
  click("menu." + item);
  until([&] { return session.copies.lockstep.size() == before + 1; }, "the copy");
}

std::filesystem::path NullUi::write_export(const std::string& name) {
  until([&] { return ui.dialog.kind == Dialog::Kind::write_export && typing(); }, "the dialog");
  const std::filesystem::path file = config / name;
  key(GLFW_KEY_A, GLFW_MOD_CONTROL);
  type(file.string());
  key(GLFW_KEY_ENTER);
  until([&] { return ui.dialog.kind == Dialog::Kind::none && std::filesystem::exists(file); }, "the file");
  return file;
}

bool NullUi::drew(std::string_view text) const {
  return drawn_.find(without_spaces(text)) != std::string::npos;
}

bool NullUi::said(std::string_view part) const {
  const auto& list = session.messages.list();
  return std::any_of(list.begin(), list.end(),
                     [&](const Message& m) { return m.text.find(part) != std::string::npos; });
}

bool NullUi::typing() const {
  const bool starts = ui.slider.typing_starts || ui.dialog.refused || ui.dialog.selecting;
  return !starts && (ui.slider.typing != 0 || ImGui::GetIO().WantTextInput);
}

glm::vec2 NullUi::pixel_of(int i, int j) {
  const auto at = scene.camera.project(session.simulation->position(i, j), ui.viewport.size());
  REQUIRE(at.has_value());
  return *at + ui.viewport.box.lo;
}

std::optional<Box> NullUi::tooltip() const {
  for (const ImGuiWindow* window : context_->Windows)
    if (window->Active && !window->Hidden && (window->Flags & ImGuiWindowFlags_Tooltip) != 0)
      return Box{{window->Pos.x, window->Pos.y}, {window->Pos.x + window->Size.x, window->Pos.y + window->Size.y}};
  return std::nullopt;
}

void NullUi::pause() {
  if (!paused()) key(GLFW_KEY_SPACE);
  REQUIRE(paused());
}

/// Letters are told by their corner in the atlas; blanks are not drawn.
std::string NullUi::drawn_text() const {
  const auto& letters = fonts_of(ui.theme.scale).letters;
  std::string out;
  const ImDrawData& data = *ImGui::GetDrawData();
  for (int n = 0; n < data.CmdListsCount; ++n)
    for (const ImDrawVert& corner : data.CmdLists[n]->VtxBuffer)
      if (const auto it = letters.find({corner.uv.x, corner.uv.y}); it != letters.end()) append_utf8(out, it->second);
  return out;
}

}  // namespace tyglab::test
