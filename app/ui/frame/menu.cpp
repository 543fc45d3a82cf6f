// The application menu: every command by topic, and everything else that the palette finds.
#include <algorithm>
#include <string_view>

#include "app/ui/frame/commands.h"
#include "app/ui/frame/panels.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"

namespace tyglab {
namespace {

/// Where a group of the palette stands: below which topic's commands, and what its submenu is called.
struct Place {
  std::string_view topic, group;
  const char* name;
};
constexpr Place places[] = {{"File", "Preset", "Presets"},          {"Motion", "Integrator", "Integrators"},
                            {"Motion", "Engine", "Engines"},        {"Cloth", "Constant", "Constants"},
                            {"Cloth", "Color", "Colors"},           {"Cards", "Copy", "Copies"},
                            {"View", "View", "Views of the cloth"}, {"Labs and help", "Lab", "Labs"}};

/// Below a line, where it is not hit by mistake.
bool stands_last(const CommandRow& row) {
  return std::string_view(row.id) == "quit";
}

void command_item(Ui& ui, const CommandRow& row) {
  const std::string obstacle = why_not(ui, row);
  const char* keys = *row.keys != 0 ? row.keys : nullptr;
  if (ImGui::MenuItem(row.name, keys, row.on != nullptr && row.on(ui), obstacle.empty())) ui.command(row.id);
  report_control(ui, row.name);
  if (!obstacle.empty()) tooltip(ui, gui::item_id(), obstacle);
}

void group_items(Ui& ui, std::string_view group) {
  for (const PaletteEntry& entry : ui.menu) {
    if (entry.group != group) continue;
    if (ImGui::MenuItem(entry.title.c_str(), entry.keys.c_str())) ui.act(entry.act);
    report_control(ui, entry.title);
  }
}

/// Runs `contents` in a submenu, where it is open.
template <class Contents>
void submenu(Ui& ui, const char* name, Contents contents) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(ui.theme.px(14), ui.theme.px(12)));
  const bool open = ImGui::BeginMenu(name);
  ImGui::PopStyleVar();
  report_control(ui, name);
  if (!open) return;
  contents();
  ImGui::EndMenu();
}

}  // namespace

void application_menu(Ui& ui, const char* id) {
  if (!begin_menu(ui, id)) return;
  if (ImGui::IsWindowAppearing()) ui.menu = palette_entries(ui);
  for (const CommandTopic& topic : command_topics())
    submenu(ui, topic.name, [&] {
      for (const CommandRow& row : topic.rows)
        if (!stands_last(row)) command_item(ui, row);
      for (const Place& place : places)
        if (place.topic == topic.name) submenu(ui, place.name, [&] { group_items(ui, place.group); });
      for (const CommandRow& row : topic.rows)
        if (stands_last(row)) ImGui::Separator(), command_item(ui, row);
    });
  end_menu();
}

}  // namespace tyglab
