#include "app/ui/frame/commands.h"

#include <algorithm>
#include <stdexcept>

#include "app/platform/platform.h"
#include "app/ui/frame/panels.h"

namespace tyglab {
namespace {

/// In a page: what a browser does with these keys is what people expect of them.
struct BrowserKeys {
  std::string_view id;
  const char* keys;
  Chord chord;
};
constexpr BrowserKeys browser_keys[] = {
    {"present", "Alt+P", {GLFW_KEY_P, GLFW_MOD_ALT}},
    {"full_screen", "Alt+F", {GLFW_KEY_F, GLFW_MOD_ALT}},
    {"next_theme", "Alt+T", {GLFW_KEY_T, GLFW_MOD_ALT}},
    {"reset_constants", "Alt+R", {GLFW_KEY_R, GLFW_MOD_ALT}},
    {"reset_everything", "Alt+Shift+R", {GLFW_KEY_R, GLFW_MOD_ALT | GLFW_MOD_SHIFT}}};

/// Without what a page leaves to its browser.
void fit_to_browser(std::vector<CommandTopic>& topics) {
  for (CommandTopic& topic : topics) {
    std::erase_if(topic.rows, [](const CommandRow& row) { return std::string_view(row.id) == "quit"; });
    for (CommandRow& row : topic.rows)
      for (const BrowserKeys& other : browser_keys)
        if (other.id == row.id) row.keys = other.keys, row.chords = {other.chord};
  }
}

std::vector<CommandTopic> all_topics() {
  std::vector<CommandTopic> topics{{"File", file_rows()},     {"Export", export_rows()},     {"Edit", edit_rows()},
                                   {"Motion", motion_rows()}, {"Cloth", cloth_rows()},       {"Cards", card_rows()},
                                   {"View", view_rows()},     {"Labs and help", help_rows()}};
  if (files_are_handed_out()) fit_to_browser(topics);
  return topics;
}

}  // namespace

std::span<const CommandTopic> command_topics() {
  static const std::vector<CommandTopic> topics = all_topics();
  return topics;
}

const CommandRow& row_of(std::string_view id) {
  for (const CommandTopic& topic : command_topics())
    for (const CommandRow& row : topic.rows)
      if (row.id == id) return row;
  throw std::logic_error("there is no command " + std::string(id));
}

std::string why_not(const Ui& ui, const CommandRow& row) {
  return row.why_not != nullptr ? row.why_not(ui) : std::string();
}

const char* Ui::keys_of(std::string_view id) const {
  return row_of(id).keys;
}

void Ui::command(std::string_view id) {
  act([&row = row_of(id)](Ui& ui) {
    if (std::string why = why_not(ui, row); !why.empty()) return ui.messages.note(std::move(why));
    if (row.action != nullptr) return row.action(ui);
    ui.dialog.exporting = &row;
    open_dialog(ui, Dialog::Kind::write_export);
  });
}

}  // namespace tyglab
