#include "tests/ui/null_ui.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <memory>
#include <thread>
#include <utility>

#include "app/base/files.h"
#include "app/base/glfw_keys.h"
#include "app/session/document.h"
#include "app/ui/frame/frame.h"
#include "app/ui/kit/imgui_compat.h"
#include "core/fields/particle_field.h"
#include "core/io/preset_io.h"
#include "tests/support/sanitized.h"

namespace tyglab::test {
namespace {

constexpr std::chrono::seconds longest_wait{test::sanitized ? 60 : 100};  // far above what a loaded machine takes
constexpr int settled = 3;                                                // frames after which a layout stands still

/// Fonts of one scale, which all tests share: to build them takes longer than most tests.
struct BuiltFonts {
  std::unique_ptr<ImFontAtlas> atlas = std::make_unique<ImFontAtlas>();
  Fonts fonts;
  std::map<std::pair<float, float>, ImWchar> letters;  ///< by a corner of their picture in the atlas
};

const BuiltFonts& fonts_of(const Theme& theme) {
  static std::map<std::pair<float, float>, BuiltFonts> built;
  const auto [it, fresh] = built.try_emplace({theme.scale, theme.axis_text});
  BuiltFonts& out = it->second;
  ImGui::GetIO().Fonts = out.atlas.get();
  if (!fresh) return out;
  out.fonts = build_fonts(theme.scale, theme.axis_text);
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

void SeenPlaces::add_control(std::string_view name) {
  ControlPlaces::add_control(name);
  const ImGuiWindow& window = *ImGui::GetCurrentWindowRead();
  const ImVec2 lo = ImGui::GetItemRectMin(), hi = ImGui::GetItemRectMax();
  if (hi.y <= window.ClipRect.Min.y || lo.y >= window.ClipRect.Max.y) return;
  if (lo.x < window.ClipRect.Min.x - 1 || hi.x > window.ClipRect.Max.x + 1)
    drawing_cut_.insert(std::string(window.RootWindow->Name) + "." + std::string(name));
}

void SeenPlaces::end_frame() {
  ControlPlaces::end_frame();
  cut_.swap(drawing_cut_);
  drawing_cut_.clear();
}

NullUi::NullUi(const UiOptions& options) : context_(nullptr) {
  setenv("TYGLAB_CONFIG_DIR", config.path().c_str(), 1);
  static ImFontAtlas none;  // a context that has one given owns none
  context_ = ImGui::CreateContext(&none);
  ImGui::SetCurrentContext(context_);
  ImGuiIO& io = ImGui::GetIO();
  gui::prepare_io(io);
  io.DisplaySize = ImVec2(float(options.size.x), float(options.size.y));
  io.DeltaTime = float(frame_time);
  settings.tour_seen = settings.cut_told = true;
  options.settings(settings);
  ui.controls = &places_;
  session.labs.progress = settings.labs;
  let_work_yield(false);
  session.pacing.patient = options.patient;
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
  const auto begun = std::chrono::steady_clock::now();
  ui.now = tools.now = ui.now + frame_time;
  ui.draw_by = std::numeric_limits<double>::infinity();
  if (take_look(ui, 1)) ui.fonts = fonts_of(ui.theme).fonts;
  act_on_events(ui, direct_film(ui).value_or(frame_time), frame_time);
  scene.draw({1, 1});
  ui.bare() ? gui_input_.hold(input) : gui_input_.feed(input);
  ImGui::NewFrame();
  draw_panels(ui);
  ImGui::Render();
  end_gestures(ui);
  places_.end_frame();
  if (const auto picture = std::exchange(ui.picture, std::nullopt); picture && on_picture) on_picture(*picture);
  input.clear();
  if (after_frame) after_frame(std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count());
}

void NullUi::frames(int count) {
  for (int n = 0; n < count; ++n) frame();
}

void NullUi::until(const std::function<bool()>& condition, std::string_view what) {
  const auto end = std::chrono::steady_clock::now() + longest_wait;
  for (int n = 0; !condition(); ++n) {
    if (std::chrono::steady_clock::now() > end) FAIL("waited in vain for ", std::string(what));
    // Other threads are at work, and under the sanitizers a frame takes as long as a share of theirs.
    if (n > (test::sanitized ? 10 : 50))
      std::this_thread::sleep_for(std::chrono::milliseconds(test::sanitized ? 30 : 1));
    frame();
  }
}

void NullUi::resize(glm::ivec2 size) {
  ImGui::GetIO().DisplaySize = ImVec2(float(size.x), float(size.y));
  frames(settled + 1);
}

void NullUi::key(int key, int mods) {
  input.on_key(key, GLFW_PRESS, mods);
  input.mods = mods;
  frame();
  input.on_key(key, GLFW_RELEASE, mods);
  input.mods = 0;
  frame();
}

void NullUi::add_typed(std::string_view text) {
  for (const char letter : text) {
    const int key = std::toupper(static_cast<unsigned char>(letter));
    input.on_key(key, GLFW_PRESS, 0);
    input.on_character(static_cast<unsigned char>(letter));
    input.on_key(key, GLFW_RELEASE, 0);
  }
}

void NullUi::type(std::string_view text) {
  add_typed(text);
  frames(2);
}

void NullUi::move(glm::vec2 to) {
  input.on_move(to, ui.now);
  frame();
}

void NullUi::press(int button) {
  input.on_button(button, GLFW_PRESS, input.mods, ui.now);
  frames(2);
}

void NullUi::release(int button) {
  input.on_button(button, GLFW_RELEASE, input.mods, ui.now);
  frames(2);
}

void NullUi::wheel(float y) {
  input.on_wheel({0, y}, ui.now);
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

void NullUi::turn_to(const std::string& name) {
  for (int n = 0; n < 9 && !sees(name); ++n) click("lab.page_on");
  if (!sees(name)) FAIL("no page of the lab has ", name);
}

void NullUi::type_value(const std::string& constant, std::string_view text, int end) {
  const glm::vec2 at = middle("constants." + constant + ".value");
  apart();
  move(at);
  input.mods = GLFW_MOD_CONTROL;
  press();
  release();
  input.mods = 0;
  until([&] { return typing(); }, "the number to become a text field");
  frames(2);
  type(text);
  key(end);
  until([&] { return !typing() || !ui.slider.refused.empty(); }, "Enter to be seen");
  frames(2);
  if (ui.slider.typing != 0) key(escape);
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
  scroll_to("menu." + item, "menu.Equal_copy");
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
  return drawn_text().find(without_spaces(text)) != std::string::npos;
}

/// The letter that a triangle begins with, if it is the first of a letter's two, and its box.
struct DrawnLetter {
  ImWchar letter;
  ImVec2 lo, hi;
};

std::optional<DrawnLetter> letter_at(const ImDrawList& list, const BuiltFonts& fonts, const ImDrawIdx* triangle) {
  const ImDrawVert &first = list.VtxBuffer[triangle[0]], &last = list.VtxBuffer[triangle[2]];
  const auto it = fonts.letters.find({first.uv.x, first.uv.y});
  if (it == fonts.letters.end() || last.uv.x <= first.uv.x || last.uv.y <= first.uv.y) return std::nullopt;
  return DrawnLetter{it->second, first.pos, last.pos};
}

std::vector<std::string> NullUi::cut_texts() const {
  std::vector<std::string> cut;
  const BuiltFonts& fonts = fonts_of(ui.theme);
  const ImDrawData& data = *ImGui::GetDrawData();
  constexpr float seen = 0.6f;  // pixels of a letter's edge, which is smoothed
  for (int n = 0; n < data.CmdListsCount; ++n) {
    const ImDrawList& list = *data.CmdLists[n];
    const std::string owner = list._OwnerName != nullptr ? list._OwnerName : "";
    const bool scrolls = owner.find('/') != std::string::npos;
    for (const ImDrawCmd& command : list.CmdBuffer) {
      const ImVec4& clip = command.ClipRect;
      std::string text;
      float row = -1;
      bool cuts = false;
      const auto end_text = [&] {
        if (cuts) cut.push_back(owner + ": " + text);
        text.clear(), cuts = false;
      };
      for (unsigned k = 0; k + 2 < command.ElemCount; k += 3) {
        const auto drawn = letter_at(list, fonts, &list.IdxBuffer[int(command.IdxOffset + k)]);
        if (!drawn || drawn->hi.y <= clip.y || drawn->lo.y >= clip.w) continue;
        if (std::abs(drawn->lo.y - row) > 12) end_text();
        row = drawn->lo.y;
        append_utf8(text, drawn->letter);
        cuts |= drawn->lo.x < clip.x - seen || drawn->hi.x > clip.z + seen;
        cuts |= !scrolls && (drawn->lo.y < clip.y - seen || drawn->hi.y > clip.w + seen);
      }
      end_text();
    }
  }
  return cut;
}

bool NullUi::said(std::string_view part) const {
  const auto& list = session.messages.list();
  return std::any_of(list.begin(), list.end(),
                     [&](const Message& m) { return m.text.find(part) != std::string::npos; });
}

bool NullUi::typing() const {
  const bool starts = ui.slider.typing_starts || ui.dialog.refused || ui.dialog.selecting || ui.lab_field.again;
  return !starts && (ui.slider.typing != 0 || gui::typing_text());
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
  const auto& letters = fonts_of(ui.theme).letters;
  std::string out;
  const ImDrawData& data = *ImGui::GetDrawData();
  for (int n = 0; n < data.CmdListsCount; ++n)
    for (const ImDrawVert& corner : data.CmdLists[n]->VtxBuffer)
      if (const auto it = letters.find({corner.uv.x, corner.uv.y}); it != letters.end()) append_utf8(out, it->second);
  return out;
}

}  // namespace tyglab::test
