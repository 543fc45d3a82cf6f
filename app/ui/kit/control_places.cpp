#include "app/ui/kit/widgets.h"

#include <imgui.h>
#include <imgui_internal.h>  // the window that an item stands in

#include <cctype>

namespace tyglab {
namespace {

/// "##name" is name, "Save as…" is Save_as.
std::string plain(std::string_view name) {
  std::string out;
  for (const char letter : name) {
    const bool kept =
        std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '.' || letter == '[' || letter == ']';
    if (kept)
      out += letter;
    else if (!out.empty() && out.back() != '_')
      out += '_';
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  return out;
}

/// Popups have names made of numbers: each is the one menu that is open.
std::string place_of(const ImGuiWindow& window) {
  const std::string name = window.RootWindow->Name;
  return name.rfind("##", 0) == 0 ? "menu" : name;
}

}  // namespace

void ControlPlaces::add_control(std::string_view name) {
  const ImGuiWindow& window = *ImGui::GetCurrentWindowRead();
  const ImVec2 lo = ImGui::GetItemRectMin(), hi = ImGui::GetItemRectMax();
  if (!window.ClipRect.Contains(ImVec2((lo.x + hi.x) / 2, (lo.y + hi.y) / 2))) return;
  // As much of it as is seen: a list may cut it at its edge.
  ImRect seen(lo, hi);
  seen.ClipWith(window.ClipRect);
  drawing_[place_of(window) + "." + plain(name)] = {{seen.Min.x, seen.Min.y}, {seen.Max.x, seen.Max.y}};
}

void ControlPlaces::end_frame() {
  shown_.swap(drawing_);
  drawing_.clear();
}

}  // namespace tyglab
