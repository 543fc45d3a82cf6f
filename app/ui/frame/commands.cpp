#include "app/ui/frame/commands.h"

#include <algorithm>
#include <stdexcept>

#include "app/ui/frame/dialogs.h"

namespace tyglab {
namespace {

std::vector<CommandTopic> all_topics() {
  return {{"File", file_rows()},   {"Export", export_rows()}, {"Edit", edit_rows()}, {"Motion", motion_rows()},
          {"Cloth", cloth_rows()}, {"Cards", card_rows()},    {"View", view_rows()}, {"Labs and help", help_rows()}};
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
