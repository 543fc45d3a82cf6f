// Dear ImGui 1.86 (Debian 12) and 1.90 (Debian 13) through one set of names.
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

inline ImGuiID item_id() {
  return ImGui::GetItemID();
}

/// An OpenGL texture as Dear ImGui names it.
inline ImTextureID texture(unsigned id) {
  return (ImTextureID)(std::intptr_t)id;
}

/// Key presses reach our sliders through the window's own callback; Dear ImGui need not repeat inputs over frames.
inline void prepare_io(ImGuiIO& io) {
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  io.ConfigWindowsMoveFromTitleBarOnly = true;
#if IMGUI_VERSION_NUM >= 18700
  io.ConfigInputTrickleEventQueue = true;
#endif
}

}  // namespace tyglab::gui
