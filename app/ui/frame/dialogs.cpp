#include "app/ui/frame/dialogs.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <utility>

#include "app/base/data_files.h"
#include "app/base/preset_files.h"
#include "app/session/document.h"
#include "app/ui/frame/exports.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/symbol.h"
#include "app/ui/kit/widgets.h"
#include "core/io/preset_io.h"

namespace tyglab {
namespace {

namespace fs = std::filesystem;
using DialogKind = Dialog::Kind;

template <std::size_t N>
void set(char (&field)[N], const std::string& text) {
  std::snprintf(field, N, "%s", text.c_str());
}

/// "~/…" as a shell reads it.
fs::path path_of(const char* typed) {
  const std::string text(typed);
  const char* home = std::getenv("HOME");
  if (text.rfind("~/", 0) == 0 && home != nullptr) return fs::path(home) / text.substr(2);
  return text;
}

void list_folder(Dialog& dialog, const fs::path& folder, bool shipped) {
  std::error_code ignored;
  std::vector<Dialog::Entry> found;
  for (const auto& file : fs::directory_iterator(folder, ignored)) {
    if (file.path().extension() != ".json") continue;
    Dialog::Entry entry;
    entry.file = file.path(), entry.label = file.path().stem().string(), entry.shipped = shipped;
    try {
      const Preset preset = load_preset(file.path());
      entry.name = preset.name, entry.description = preset.description;
    } catch (const std::exception& error) {
      entry.name = entry.label, entry.problem = error.what();
    }
    found.push_back(std::move(entry));
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  dialog.entries.insert(dialog.entries.end(), found.begin(), found.end());
}

std::string file_name_for(const std::string& name) {
  std::string file;
  for (const char letter : name) {
    const bool plain = (letter >= 'a' && letter <= 'z') || (letter >= '0' && letter <= '9');
    const bool capital = letter >= 'A' && letter <= 'Z';
    if (plain || capital)
      file += capital ? char(letter - 'A' + 'a') : letter;
    else if (!file.empty() && file.back() != '_')
      file += '_';
  }
  while (!file.empty() && file.back() == '_') file.pop_back();
  return (file.empty() ? std::string("preset") : file) + ".json";
}

void close(App& app) {
  app.ui.dialog.kind = DialogKind::none;
  app.ui.dialog.then.reset();
  ImGui::CloseCurrentPopup();
}

void title(App& app, const char* text) {
  ImGui::PushFont(app.fonts.brand);
  wrapped(app, text, app.theme.colors.text);
  ImGui::PopFont();
  ImGui::Dummy({0, app.theme.px(2)});
}

void label(App& app, const char* text) {
  ImGui::PushFont(app.fonts.small);
  wrapped(app, text, app.theme.colors.quiet);
  ImGui::PopFont();
}

/// Returns whether the text changed.
template <std::size_t N>
bool text_field(App& app, const char* id, char (&field)[N], bool focus, bool select = false) {
  if (focus) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(app.theme.px(8), app.theme.px(7)));
  const bool changed = ImGui::InputText(id, field, N, select ? ImGuiInputTextFlags_AutoSelectAll : 0);
  ImGui::PopStyleVar();
  report_control(app, id);
  return changed;
}

/// The field of the file's path. After a refusal it takes keys again, all of its text selected. Returns whether the
/// text changed.
bool path_field(App& app, bool focus = false) {
  Dialog& dialog = app.ui.dialog;
  const bool select = dialog.selecting || dialog.refused;
  const bool changed = text_field(app, "##path", dialog.path, focus || dialog.refused, select);
  dialog.selecting = select && !ImGui::IsItemActive();  // it gets the focus in the frame after the one that asks
  dialog.refused = false;
  return changed;
}

void refuse(Dialog& dialog, std::string reason) {
  dialog.problem = std::move(reason);
  dialog.refused = true;
}

void problem(App& app) {
  if (!app.ui.dialog.problem.empty()) wrapped(app, app.ui.dialog.problem, app.theme.colors.warning);
}

void entry_line(App& app, int k, bool& open) {
  Dialog& dialog = app.ui.dialog;
  const Dialog::Entry& entry = dialog.entries[k];
  const Tokens& c = app.theme.colors;
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, padding = app.theme.px(10);
  const std::string& below = entry.problem.empty() ? entry.description : entry.problem;
  const ImFont& small = *app.fonts.small;
  const float text_height =
      below.empty() ? 0
                    : small.CalcTextSizeA(small.FontSize, 1e9f, width - 2 * padding, below.c_str()).y + app.theme.px(3);
  const float height = app.fonts.title->FontSize + text_height + app.theme.px(14);
  ImGui::PushID(k);
  if (ImGui::InvisibleButton("entry", {width, height})) {
    dialog.selected = k;
    set(dialog.path, entry.file.string());
  }
  if (ImGui::IsItemHovered() && app.input.double_click) open = true;
  report_control(app, "entry." + entry.label);
  ImGui::PopID();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const bool chosen = dialog.selected == k;
  if (chosen || ImGui::IsItemHovered())
    draw.AddRectFilled(lo, {lo.x + width, lo.y + height}, chosen ? mixed(c.field, c.accent, 0.25f) : c.field,
                       app.theme.px(5));
  draw_text(draw, *app.fonts.title, {lo.x + padding, lo.y + app.theme.px(7)}, c.text, entry.name);
  const float label_width = text_width(small, entry.label);
  draw_text(draw, small, {lo.x + width - padding - label_width, lo.y + app.theme.px(9)}, c.quiet, entry.label);
  draw.AddText(&small, small.FontSize, {lo.x + padding, lo.y + app.theme.px(10) + app.fonts.title->FontSize},
               entry.problem.empty() ? c.quiet : c.warning, below.c_str(), nullptr, width - 2 * padding);
}

bool is_shipped(const fs::path& file) {
  std::error_code ignored;
  return fs::equivalent(file.parent_path(), data_folder() / "presets", ignored);
}

void open_presets(App& app) {
  Dialog& dialog = app.ui.dialog;
  title(app, "Open a preset");
  bool open = false;
  gui::begin_child("list", {0, std::min(app.theme.px(420), ImGui::GetIO().DisplaySize.y - app.theme.px(260))});
  for (int k = 0; k < int(dialog.entries.size()); ++k) {
    const bool shipped = dialog.entries[k].shipped;
    if (k == 0 || dialog.entries[k - 1].shipped != shipped) label(app, shipped ? "SHIPPED" : "YOURS");
    entry_line(app, k, open);
  }
  ImGui::EndChild();
  label(app, "File");
  if (path_field(app, ImGui::IsWindowAppearing())) dialog.problem.clear();
  problem(app);
  open |= dialog.enter;
  open |= text_button(app, "Open", true, dialog.path[0] != 0);
  ImGui::SameLine();
  if (text_button(app, "Cancel")) return close(app);
  if (!open || dialog.path[0] == 0) return;
  fs::path file;
  try {
    file = find_preset(path_of(dialog.path).string()).file;  // shipped ones by name, as on the command line
    load_preset(file);                                       // a wrong file is said here, where another can be chosen
  } catch (const std::exception& error) {
    return refuse(dialog, error.what());
  }
  close(app);
  app.request(request::Open{.file = file, .shipped = is_shipped(file)});
}

/// The lower part of dialogs that write: the question whether to overwrite, and the buttons. True when it may go on.
bool may_write(App& app, const char* verb) {
  Dialog& dialog = app.ui.dialog;
  problem(app);
  std::error_code ignored;
  const fs::path file = path_of(dialog.path);
  if (dialog.overwrite) wrapped(app, "That file exists. Replace it?", app.theme.colors.warning);
  const bool go = text_button(app, dialog.overwrite ? "Replace" : verb, true, dialog.path[0] != 0) || dialog.enter;
  ImGui::SameLine();
  if (text_button(app, "Cancel")) {
    close(app);
    return false;
  }
  if (!go || dialog.path[0] == 0) return false;
  if (fs::is_directory(file, ignored)) {
    dialog.problem = file.string() + " is a folder; add a file name to it.";
    return false;
  }
  if (fs::exists(file, ignored) && !fs::is_regular_file(file, ignored)) {
    dialog.problem = file.string() + " is no file that can be replaced; take another name.";
    return false;
  }
  if (!dialog.overwrite && fs::exists(file, ignored)) {
    dialog.overwrite = true;
    return false;
  }
  return true;
}

void save_preset_dialog(App& app) {
  Dialog& dialog = app.ui.dialog;
  title(app, "Save the preset");
  label(app, "Name");
  const bool renamed = text_field(app, "##name", dialog.name, ImGui::IsWindowAppearing());
  if (renamed && dialog.path_follows)
    set(dialog.path, (path_of(dialog.path).parent_path() / file_name_for(dialog.name)).string());
  label(app, "File");
  const bool moved = path_field(app);
  if (moved) dialog.path_follows = false;
  if (moved || renamed) dialog.overwrite = false, dialog.problem.clear();
  if (!may_write(app, "Save")) return;
  fs::path file = path_of(dialog.path);
  if (file.extension().empty()) file += ".json";
  if (is_shipped(file)) {
    refuse(dialog, "That is a preset of the program itself; save under another name or in another folder.");
    dialog.overwrite = false;
    return;
  }
  const request::SavePreset save{file, dialog.name};
  const auto then = dialog.then;
  close(app);
  app.request(save);
  if (then) app.request(*then);
}

void export_dialog(App& app) {
  Dialog& dialog = app.ui.dialog;
  const Export& what = export_of(dialog.source);
  title(app, what.title);
  wrapped(app, what.holds, app.theme.colors.quiet);
  label(app, "File");
  if (path_field(app, ImGui::IsWindowAppearing())) dialog.overwrite = false, dialog.problem.clear();
  if (!may_write(app, "Write")) return;
  const request::WriteExport write{path_of(dialog.path), dialog.source};
  close(app);
  app.request(write);
}

void picture_dialog(App& app) {
  static constexpr const char* parts[] = {"The cloth and its legend", "The whole window"};
  Dialog& dialog = app.ui.dialog;
  title(app, "Save a picture");
  if (const int k = segments(app, "parts", parts, 2, dialog.whole_window); k >= 0) dialog.whole_window = k == 1;
  ImGui::Dummy({0, app.theme.px(2)});
  label(app, "PNG file");
  if (path_field(app, ImGui::IsWindowAppearing())) dialog.overwrite = false, dialog.problem.clear();
  if (!may_write(app, "Save")) return;
  fs::path file = path_of(dialog.path);
  if (file.extension().empty()) file += ".png";
  const request::SavePicture save{file, dialog.whole_window};
  close(app);
  app.request(save);
}

void texture_dialog(App& app) {
  Dialog& dialog = app.ui.dialog;
  title(app, "Take a picture as texture");
  label(app, "PNG, JPEG, BMP or TGA file");
  path_field(app, ImGui::IsWindowAppearing());
  problem(app);
  const bool go = text_button(app, "Load", true, dialog.path[0] != 0) || dialog.enter;
  ImGui::SameLine();
  if (text_button(app, "Cancel")) return close(app);
  if (!go || dialog.path[0] == 0) return;
  const std::string name = path_of(dialog.path).string();
  close(app);
  app.request(request::LoadTexture{name});
}

/// What was to follow goes on once the preset is saved; through the dialog where it has no file yet.
void save_first(App& app) {
  Dialog& dialog = app.ui.dialog;
  const Request then = *dialog.then;
  close(app);
  if (app.document.file.empty()) {
    open_dialog(app, DialogKind::save);
    app.ui.dialog.then = then;
    return;
  }
  app.request(request::SavePreset{app.document.file, app.preset().name});
  app.request(then);
}

void unsaved_dialog(App& app) {
  Dialog& dialog = app.ui.dialog;
  title(app, "Unsaved changes");
  wrapped(app, dialog.question, app.theme.colors.text);
  ImGui::Dummy({0, app.theme.px(4)});
  if (text_button(app, "Save", true) || dialog.enter) return save_first(app);
  ImGui::SameLine();
  if (text_button(app, "Discard the changes")) {
    app.request(*dialog.then);
    return close(app);
  }
  ImGui::SameLine();
  if (text_button(app, "Cancel")) close(app);
}

void large_dialog(App& app) {
  Dialog& dialog = app.ui.dialog;
  title(app, "A very large cloth");
  wrapped(app, dialog.question, app.theme.colors.text);
  ImGui::Dummy({0, app.theme.px(4)});
  if (text_button(app, "Keep the present cloth", true)) return close(app);
  ImGui::SameLine();
  if (!text_button(app, "Build it")) return;
  app.request(*dialog.then);
  close(app);
}

void contents(App& app) {
  switch (app.ui.dialog.kind) {
    case DialogKind::open:
      return open_presets(app);
    case DialogKind::save:
      return save_preset_dialog(app);
    case DialogKind::write_export:
      return export_dialog(app);
    case DialogKind::texture:
      return texture_dialog(app);
    case DialogKind::picture:
      return picture_dialog(app);
    case DialogKind::unsaved:
      return unsaved_dialog(app);
    case DialogKind::large_cloth:
      return large_dialog(app);
    case DialogKind::none:
      return;
  }
}

}  // namespace

void open_dialog(App& app, DialogKind kind) {
  Dialog& dialog = app.ui.dialog;
  dialog.kind = kind;
  dialog.opening = true;
  dialog.overwrite = dialog.enter = dialog.path_follows = dialog.refused = dialog.selecting = false;
  dialog.problem.clear();
  dialog.then.reset();
  dialog.entries.clear();
  dialog.selected = -1;
  set(dialog.path, "");
  const fs::path own = user_preset_folder();
  if (kind == DialogKind::open) {
    list_folder(dialog, data_folder() / "presets", true);
    if (!own.empty()) list_folder(dialog, own, false);
  } else if (kind == DialogKind::save) {
    set(dialog.name, app.preset().name);
    const fs::path file = !app.document.file.empty() ? app.document.file : own / file_name_for(app.preset().name);
    set(dialog.path, file.string());
    dialog.path_follows = true;
  } else if (kind == DialogKind::picture) {
    std::error_code ignored;
    set(dialog.path, (fs::current_path(ignored) / (app.document.label + ".png")).string());
  } else if (kind == DialogKind::write_export) {
    std::error_code ignored;
    set(dialog.path, (fs::current_path(ignored) / export_of(dialog.source).file).string());
  }
}

void ask(App& app, DialogKind kind, std::string question, Request then) {
  open_dialog(app, kind);
  app.ui.dialog.question = std::move(question);
  app.ui.dialog.then = std::move(then);
}

void show_save_problem(App& app, const fs::path& file, const std::string& name, const std::string& problem) {
  open_dialog(app, DialogKind::save);
  set(app.ui.dialog.path, file.string());
  set(app.ui.dialog.name, name);
  app.ui.dialog.problem = problem;
}

void dialogs(App& app) {
  Dialog& dialog = app.ui.dialog;
  if (dialog.opening) ImGui::OpenPopup("dialog");
  dialog.opening = false;
  if (dialog.kind == DialogKind::none) return;
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  const bool question = dialog.kind == DialogKind::unsaved || dialog.kind == DialogKind::large_cloth;
  ImGui::SetNextWindowPos({window.x / 2, window.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSize({std::min(app.theme.px(question ? 460 : 620), window.x - app.theme.px(24)), 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(app.theme.px(24), app.theme.px(20)));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, app.theme.px(8));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  if (ImGui::BeginPopupModal("dialog", nullptr,
                             ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                 ImGuiWindowFlags_NoSavedSettings)) {
    ImGui::PushTextWrapPos(0);
    // Enter waits until the field has the text that was typed before it.
    const bool enter = std::exchange(dialog.enter, dialog.enter && !app.input.unread);
    contents(app);
    dialog.enter = enter && app.input.unread;
    if (dialog.kind == DialogKind::none) ImGui::CloseCurrentPopup();
    ImGui::PopTextWrapPos();
    ImGui::EndPopup();
  }
  ImGui::PopStyleVar(3);
}

}  // namespace tyglab
