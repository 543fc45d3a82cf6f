#include "app/ui/kit/region.h"

namespace tyglab {
bool begin_region(const char* name, const Region& region, ImU32 ground, ImVec2 padding) {
  ImGui::SetNextWindowPos(region.at);
  ImGui::SetNextWindowSize(region.size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, padding);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ground);
  return ImGui::Begin(name, nullptr, region_flags);
}

void end_region() {
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar();
}

}  // namespace tyglab
