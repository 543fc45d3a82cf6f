// One set of names for Dear ImGui 1.86 (Debian 12) and 1.90 (Debian 13).
#pragma once

#include <imgui.h>
#include <imgui_internal.h>  // GetItemID, which 1.89 made public

#include <cstdint>

#if IMGUI_VERSION_NUM < 18600
#error "Dear ImGui 1.86 or newer is needed (Debian package libimgui-dev)."
#endif

namespace tyglab::gui {

/// A borderless child window.
inline bool begin_child(const char* id, ImVec2 size, ImGuiWindowFlags flags = 0) {
#if IMGUI_VERSION_NUM >= 18992
  return ImGui::BeginChild(id, size, ImGuiChildFlags_None, flags);
#else
  return ImGui::BeginChild(id, size, false, flags);
#endif
}

/// What can be pointed at and pressed. Dear ImGui aborts where there is no room at all, as in a very narrow window.
inline bool press_area(const char* id, ImVec2 size) {
  return ImGui::InvisibleButton(id, {size.x > 1 ? size.x : 1, size.y > 1 ? size.y : 1});
}

inline ImGuiID item_id() {
  return ImGui::GetItemID();
}

/// Whether a text field that was drawn in the last frame takes keys. io.WantTextInput says so two frames late, of
/// fields that are gone too.
inline bool typing_text() {
  const ImGuiContext& g = *ImGui::GetCurrentContext();
  return g.ActiveId != 0 && g.ActiveIdIsAlive == g.ActiveId && g.InputTextState.ID == g.ActiveId;
}

/// Whether the wheel would scroll what lies there, as it was drawn last; its scroll bar is dragged instead.
inline bool scrolls_at(ImVec2 at) {
  const ImVector<ImGuiWindow*>& windows = ImGui::GetCurrentContext()->Windows;
  for (int n = windows.Size - 1; n >= 0; --n) {  // from the front
    const ImGuiWindow* window = windows[n];
    if (!window->Active || window->Hidden || !window->OuterRectClipped.Contains(at)) continue;
    if ((window->Flags & ImGuiWindowFlags_NoMouseInputs) != 0) continue;
    for (; window != nullptr; window = window->ParentWindow)
      if (window->ScrollMax.y > 0 && (window->Flags & ImGuiWindowFlags_NoScrollWithMouse) == 0)
        return window->InnerRect.Contains(at);
    return false;
  }
  return false;
}

/// What is pressed stays pressed through a frame that does not draw it.
inline void keep_pressed() {
  ImGui::KeepAliveID(ImGui::GetActiveID());
}

/// What is pressed is not any longer, and was not clicked.
inline void forget_press() {
  ImGui::ClearActiveID();
}

/// Selects all that stands in the text field which takes keys.
inline void select_all_text() {
  ImGui::GetCurrentContext()->InputTextState.SelectAll();
}

/// An OpenGL texture as Dear ImGui names it.
inline ImTextureID texture(unsigned id) {
  return (ImTextureID)(std::intptr_t)id;
}

/// A new context's settings. What happens is shown to it frame by frame (app/ui/frame/frame.h), so it need not
/// spread inputs itself.
inline void prepare_io(ImGuiIO& io) {
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  io.ConfigWindowsMoveFromTitleBarOnly = true;
#if IMGUI_VERSION_NUM >= 18700
  io.ConfigInputTrickleEventQueue = false;
#else
  for (int key = 0; key < ImGuiKey_COUNT; ++key) io.KeyMap[key] = key;
#endif
}

#if IMGUI_VERSION_NUM >= 18700
constexpr ImGuiKey keypad_enter = ImGuiKey_KeypadEnter;
#else
constexpr ImGuiKey keypad_enter = ImGuiKey_KeyPadEnter;
#endif

// What the next frame sees of keyboard and mouse.

inline void show_key(ImGuiKey key, bool down) {
#if IMGUI_VERSION_NUM >= 18700
  ImGui::GetIO().AddKeyEvent(key, down);
#else
  ImGui::GetIO().KeysDown[ImGui::GetIO().KeyMap[key]] = down;
#endif
}

inline void show_mods(bool ctrl, bool shift, bool alt) {
  ImGuiIO& io = ImGui::GetIO();
#if IMGUI_VERSION_NUM >= 18700
  io.AddKeyEvent(ImGuiMod_Ctrl, ctrl), io.AddKeyEvent(ImGuiMod_Shift, shift), io.AddKeyEvent(ImGuiMod_Alt, alt);
#else
  io.KeyCtrl = ctrl, io.KeyShift = shift, io.KeyAlt = alt;
#endif
}

inline void show_pointer(ImVec2 at) {
#if IMGUI_VERSION_NUM >= 18700
  ImGui::GetIO().AddMousePosEvent(at.x, at.y);
#else
  ImGui::GetIO().MousePos = at;
#endif
}

inline void show_button(int button, bool down) {
#if IMGUI_VERSION_NUM >= 18700
  ImGui::GetIO().AddMouseButtonEvent(button, down);
#else
  ImGui::GetIO().MouseDown[button] = down;
#endif
}

inline void show_wheel(float x, float y) {
#if IMGUI_VERSION_NUM >= 18700
  ImGui::GetIO().AddMouseWheelEvent(x, y);
#else
  ImGui::GetIO().MouseWheelH += x, ImGui::GetIO().MouseWheel += y;
#endif
}

}  // namespace tyglab::gui
