#include "app/ui/frame/panels.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <utility>

#include "app/base/files.h"
#include "app/base/text.h"
#include "app/platform/platform.h"
#include "app/session/document.h"
#include "app/session/lab.h"
#include "app/ui/frame/commands.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"
#include "core/io/preset_io.h"
#include "core/io/system_files.h"

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
  const fs::path home = home_folder();
  if (text.rfind("~/", 0) == 0 && !home.empty()) return home / text.substr(2);
  return text;
}

std::string file_name_for(const std::string& name) {
  const std::string file = plain_file_name(name);
  return (file.empty() ? std::string("preset") : file) + ".json";
}

void close(Ui& ui) {
  ui.dialog.kind = DialogKind::none;
  ui.dialog.then.reset();
  ImGui::CloseCurrentPopup();
}

void title(Ui& ui, const char* text) {
  ImGui::PushFont(ui.fonts.brand);
  wrapped(ui, text, ui.theme.colors.text);
  ImGui::PopFont();
  ImGui::Dummy({0, ui.theme.px(2)});
}

void label(Ui& ui, const char* text) {
  ImGui::PushFont(ui.fonts.small);
  wrapped(ui, text, ui.theme.colors.quiet);
  ImGui::PopFont();
}

/// One that is to take keys has all of its text selected, so that what is typed replaces it. Returns whether the text
/// changed.
template <std::size_t N>
bool text_field(Ui& ui, const char* id, char (&field)[N], bool focus) {
  if (focus) ImGui::SetKeyboardFocusHere(), ui.dialog.selecting = field;
  const bool select = ui.dialog.selecting == field;
  ImGui::SetNextItemWidth(-1);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(ui.theme.px(8), ui.theme.px(7)));
  const bool changed = ImGui::InputText(id, field, N, select ? ImGuiInputTextFlags_AutoSelectAll : 0);
  ImGui::PopStyleVar();
  // It gets the focus in the frame after the one that asks.
  if (select && ImGui::IsItemActive()) ui.dialog.selecting = nullptr;
  report_control(ui, id);
  return changed;
}

/// The field of the file's path, which takes keys again after a refusal. Returns whether the text changed.
bool path_field(Ui& ui, bool focus = false) {
  return text_field(ui, "##path", ui.dialog.path, std::exchange(ui.dialog.refused, false) || focus);
}

void refuse(Dialog& dialog, std::string reason) {
  dialog.problem = std::move(reason);
  dialog.refused = true;
}

void problem(Ui& ui) {
  if (!ui.dialog.problem.empty()) wrapped(ui, ui.dialog.problem, ui.theme.colors.warning);
}

bool is_shipped(const fs::path& file) {
  std::error_code ignored;
  return fs::equivalent(file.parent_path(), data_folder() / "presets", ignored);
}

void open_presets(Ui& ui) {
  Dialog& dialog = ui.dialog;
  gallery(ui, [&](bool low) {
    if (!low) title(ui, "Open a preset");
  });
  if (dialog.kind != DialogKind::open) return;
  if (files_are_handed_out()) {
    if (text_button(ui, "Choose a file…", true)) ask_for_file(".json,.tyglab"), close(ui);
    ImGui::SameLine();
    if (text_button(ui, "Cancel")) close(ui);
    return;
  }
  label(ui, "Or a file, by its path");
  if (path_field(ui)) dialog.problem.clear();
  problem(ui);
  const bool typed = dialog.path[0] != 0;
  const bool open = text_button(ui, "Open", true, typed || gallery_choice(ui)) || dialog.enter;
  ImGui::SameLine();
  if (text_button(ui, "Cancel")) return close(ui);
  if (open && !typed) return open_gallery_choice(ui);
  if (!open) return;
  fs::path file;
  try {
    file = find_preset(path_of(dialog.path).string()).file;  // shipped ones by name, as on the command line
    read_preset(file);                                       // a wrong file is said here, where another can be chosen
  } catch (const std::exception& error) {
    return refuse(dialog, error.what());
  }
  close(ui);
  ui.session.request(request::Open{.file = file, .shipped = is_shipped(file)});
}

/// The lower part of dialogs that write: the question whether to overwrite, and the buttons. True when it may go on.
bool may_write(Ui& ui, const char* verb) {
  Dialog& dialog = ui.dialog;
  problem(ui);
  std::error_code ignored;
  const fs::path file = path_of(dialog.path);
  if (dialog.overwrite) wrapped(ui, "That file exists. Replace it?", ui.theme.colors.warning);
  const bool go = text_button(ui, dialog.overwrite ? "Replace" : verb, true, dialog.path[0] != 0) || dialog.enter;
  ImGui::SameLine();
  if (text_button(ui, "Cancel")) {
    close(ui);
    return false;
  }
  if (!go || dialog.path[0] == 0) return false;
  if (fs::is_directory(file, ignored)) {
    refuse(dialog, file.string() + " is a folder; add a file name to it.");
    return false;
  }
  if (fs::exists(file, ignored) && !fs::is_regular_file(file, ignored)) {
    refuse(dialog, file.string() + " is not a regular file, so it cannot be replaced; choose another name.");
    return false;
  }
  // Browsers give a download another name where there is one of that name.
  if (!dialog.overwrite && !files_are_handed_out() && fs::exists(file, ignored)) {
    dialog.overwrite = true;
    return false;
  }
  return true;
}

void save_preset_dialog(Ui& ui) {
  Dialog& dialog = ui.dialog;
  title(ui, "Save the preset");
  label(ui, "Name");
  const bool renamed = text_field(ui, "##name", dialog.name, ImGui::IsWindowAppearing() && !dialog.refused);
  if (renamed && dialog.path_follows)
    set(dialog.path, (path_of(dialog.path).parent_path() / file_name_for(dialog.name)).string());
  bool moved = false;
  if (!files_are_handed_out()) {
    label(ui, "File");
    moved = path_field(ui);
  }
  if (moved) dialog.path_follows = false;
  if (moved || renamed) dialog.overwrite = false, dialog.problem.clear();
  if (!may_write(ui, "Save")) return;
  fs::path file = path_of(dialog.path);
  if (file.extension().empty()) file += ".json";
  if (is_shipped(file)) {
    refuse(dialog, "That preset is part of the program; save under another name or in another folder.");
    dialog.overwrite = false;
    return;
  }
  const request::SavePreset save{file, std::string(trimmed(dialog.name))};
  const auto then = dialog.then;
  close(ui);
  ui.session.request(save);
  if (then) ui.session.request(*then);
}

void export_dialog(Ui& ui) {
  Dialog& dialog = ui.dialog;
  const Export& what = *dialog.exporting->writes;
  title(ui, what.title);
  wrapped(ui, what.holds, ui.theme.colors.quiet);
  label(ui, "File");
  if (path_field(ui, ImGui::IsWindowAppearing())) dialog.overwrite = false, dialog.problem.clear();
  if (!may_write(ui, "Export")) return;
  ui.act([&what, file = path_of(dialog.path)](Ui& u) {
    try {
      what.write(u, file);
      hand_out(file);
      u.dialog.kind = DialogKind::none;
      u.messages.note("Exported " + file.string());
    } catch (const std::runtime_error& error) {
      refuse(u.dialog, error.what());
    }
  });
}

void picture_dialog(Ui& ui) {
  static constexpr const char* parts[] = {"The cloth and its legend", "The whole window"};
  Dialog& dialog = ui.dialog;
  title(ui, "Save an image");
  if (const int k = segments(ui, "parts", parts, 2, dialog.whole_window); k >= 0) dialog.whole_window = k == 1;
  ImGui::Dummy({0, ui.theme.px(2)});
  label(ui, "PNG file");
  if (path_field(ui, ImGui::IsWindowAppearing())) dialog.overwrite = false, dialog.problem.clear();
  if (!may_write(ui, "Save")) return;
  fs::path file = path_of(dialog.path);
  if (file.extension().empty()) file += ".png";
  std::error_code ignored;
  if (const fs::path folder = file.parent_path(); !folder.empty() && !fs::is_directory(folder, ignored))
    return refuse(dialog, "The folder " + folder.string() + " does not exist; create it first, or choose another.");
  const PictureOrder order{file, dialog.whole_window};
  close(ui);
  ui.act([order](Ui& u) { u.picture = order; });
}

/// What makes a video of a film's images, typed in their folder.
std::string joining_command(const Ui& ui) {
  return "ffmpeg -framerate " + std::to_string(FilmOrder::fps) + " -i " + ui.session.document.label +
         "_%04d.png -pix_fmt yuv420p film.mp4";
}

/// Into a folder of its own, from the present moment on.
void film_dialog(Ui& ui) {
  Dialog& dialog = ui.dialog;
  title(ui, "Export a film");
  wrapped(
      ui,
      "Numbered PNG images of the cloth and its legend: " + std::to_string(FilmOrder::fps) +
          " images per second of playback, however long they take to draw. Any video program joins them, for example:",
      ui.theme.colors.quiet);
  ImGui::PushFont(ui.fonts.mono);
  wrapped(ui, joining_command(ui), ui.theme.colors.text);
  ImGui::PopFont();
  label(ui, "Seconds");
  bool edited = text_field(ui, "##seconds", dialog.seconds, false);
  label(ui, "Folder");
  edited |= path_field(ui, ImGui::IsWindowAppearing());
  if (edited) dialog.overwrite = false, dialog.problem.clear();
  problem(ui);
  if (dialog.overwrite)
    wrapped(ui, "That folder has files in it. Images of the same names are replaced.", ui.theme.colors.warning);
  const bool go =
      text_button(ui, dialog.overwrite ? "Export anyway" : "Export", true, dialog.path[0] != 0) || dialog.enter;
  ImGui::SameLine();
  if (text_button(ui, "Cancel")) return close(ui);
  if (!go || dialog.path[0] == 0) return;
  constexpr double longest = 3600;  // s
  const auto seconds = typed_number(dialog.seconds, "s");
  if (!seconds || !(*seconds > 0 && *seconds <= longest)) {
    dialog.problem = std::string("“") + dialog.seconds + "” is not a time up to an hour; type one such as 10.";
    return;
  }
  const fs::path folder = path_of(dialog.path);
  std::error_code error;
  if (fs::create_directories(folder, error); error || !fs::is_directory(folder, error))
    return refuse(dialog, folder.string() + ": the folder cannot be created; choose another.");
  if (!dialog.overwrite && !fs::is_empty(folder, error)) return void(dialog.overwrite = true);
  FilmOrder film;
  film.folder = folder, film.count = std::max<std::int64_t>(1, std::llround(*seconds * FilmOrder::fps));
  close(ui);
  ui.film = film;
  ui.session.pacing.playing = true;
}

void course_page_dialog(Ui& ui) {
  Dialog& dialog = ui.dialog;
  title(ui, "Course page");
  wrapped(ui, "The address of the Tyglab page that your students use. Copied links and embed code begin with it.",
          ui.theme.colors.quiet);
  label(ui, "Address; empty for none");
  if (path_field(ui, ImGui::IsWindowAppearing())) dialog.problem.clear();
  problem(ui);
  const bool go = text_button(ui, "Keep", true) || dialog.enter;
  ImGui::SameLine();
  if (text_button(ui, "Cancel")) return close(ui);
  if (!go) return;
  std::string address(trimmed(dialog.path));
  address.resize(std::min(address.find_first_of("?#"), address.size()));  // a link was pasted
  if (!address.empty() && (address[0] == '#' || !is_link(address)))
    return refuse(dialog, "An address begins with https:// or http://.");
  if (address.find_first_of("\"<> ") != std::string::npos)
    return refuse(dialog, "An address has no spaces and quotes.");
  ui.settings.course_page = std::move(address);
  close(ui);
}

void texture_dialog(Ui& ui) {
  Dialog& dialog = ui.dialog;
  title(ui, "Use image as texture");
  label(ui, "PNG, JPEG, BMP or TGA file");
  path_field(ui, ImGui::IsWindowAppearing());
  problem(ui);
  const bool go = text_button(ui, "Load", true, dialog.path[0] != 0) || dialog.enter;
  ImGui::SameLine();
  if (text_button(ui, "Cancel")) return close(ui);
  if (!go || dialog.path[0] == 0) return;
  const std::string name = path_of(dialog.path).string();
  close(ui);
  ui.session.request(request::LoadTexture{name});
}

/// What was to follow goes on once the preset is saved; through the dialog where it has no file yet.
void save_first(Ui& ui) {
  Dialog& dialog = ui.dialog;
  const Request then = *dialog.then;
  close(ui);
  if (ui.session.document.file.empty()) {
    open_dialog(ui, DialogKind::save);
    ui.dialog.then = then;
    return;
  }
  ui.session.request(request::SavePreset{ui.session.document.file, ui.session.preset().name});
  ui.session.request(then);
}

void unsaved_dialog(Ui& ui) {
  Dialog& dialog = ui.dialog;
  title(ui, "Unsaved changes");
  wrapped(ui, dialog.question, ui.theme.colors.text);
  ImGui::Dummy({0, ui.theme.px(4)});
  if (text_button(ui, "Save", true) || dialog.enter) return save_first(ui);
  ImGui::SameLine();
  if (text_button(ui, "Discard the changes")) {
    ui.session.request(*dialog.then);
    return close(ui);
  }
  ImGui::SameLine();
  if (text_button(ui, "Cancel")) close(ui);
}

void large_dialog(Ui& ui) {
  Dialog& dialog = ui.dialog;
  title(ui, "A very large cloth");
  wrapped(ui, dialog.question, ui.theme.colors.text);
  ImGui::Dummy({0, ui.theme.px(4)});
  if (text_button(ui, "Keep this cloth", true)) return close(ui);
  ImGui::SameLine();
  if (!text_button(ui, "Build it")) return;
  ui.session.request(*dialog.then);
  close(ui);
}

/// What went wrong at the start, such as damaged settings: the page covers the place of messages.
void warnings(Ui& ui) {
  for (const Message& message : ui.session.messages.list())
    if (message.severity != Message::Severity::note) wrapped(ui, capitalised(message.text), ui.theme.colors.warning);
}

void start_page(Ui& ui) {
  gallery(ui, [&](bool low) {
    if (!low) title(ui, "Tyglab");
    wrapped(ui,
            "A simulated cloth to pull, cut and tear: change any constant of the model while it moves, and see where "
            "numerical methods work and where they fail.",
            ui.theme.colors.text);
    warnings(ui);
    ImGui::Dummy({0, ui.theme.px(2)});
  });
  if (ui.dialog.kind != DialogKind::start) return;
  // By its name: what is searched for is chosen by its picture.
  std::string name = fitted(*ui.fonts.text, ui.session.preset().name, ui.theme.px(180));
  for (std::size_t at; (at = name.find("##")) != std::string::npos;) name.insert(at + 1, " ");  // ends a label
  if (text_button(ui, ((ui.dialog.first_start ? "Start with “" : "Continue with “") + name + "”").c_str(), true))
    return close(ui);
  ImGui::SameLine();
  if (text_button(ui, "Take the tour")) close(ui), ui.command("start_tour");
}

void contents(Ui& ui) {
  switch (ui.dialog.kind) {
    case DialogKind::start:
      return start_page(ui);
    case DialogKind::open:
      return open_presets(ui);
    case DialogKind::save:
      return save_preset_dialog(ui);
    case DialogKind::write_export:
      return export_dialog(ui);
    case DialogKind::texture:
      return texture_dialog(ui);
    case DialogKind::picture:
      return picture_dialog(ui);
    case DialogKind::film:
      return film_dialog(ui);
    case DialogKind::course_page:
      return course_page_dialog(ui);
    case DialogKind::unsaved:
      return unsaved_dialog(ui);
    case DialogKind::large_cloth:
      return large_dialog(ui);
    case DialogKind::none:
      return;
  }
}

}  // namespace

void open_dialog(Ui& ui, DialogKind kind) {
  Dialog& dialog = ui.dialog;
  dialog.kind = kind;
  dialog.opening = true;
  dialog.overwrite = dialog.enter = dialog.path_follows = dialog.refused = false;
  dialog.selecting = nullptr;
  dialog.problem.clear();
  dialog.then.reset();
  set(dialog.path, "");
  std::error_code ignored;
  const fs::path here = files_are_handed_out() ? fs::path() : fs::current_path(ignored);
  const fs::path own = user_preset_folder();
  if (kind == DialogKind::open || kind == DialogKind::start) {
    fill_gallery(ui, kind == DialogKind::start);
    dialog.first_start = kind == DialogKind::start && !ui.settings.tour_seen;
    ui.settings.tour_seen |= kind == DialogKind::start;
  } else if (kind == DialogKind::texture && files_are_handed_out()) {
    dialog.kind = DialogKind::none, dialog.opening = false;
    ask_for_file(".png,.jpg,.jpeg,.bmp,.tga");
  } else if (kind == DialogKind::save) {
    set(dialog.name, ui.session.preset().name);
    const fs::path file =
        !ui.session.document.file.empty() ? ui.session.document.file : own / file_name_for(ui.session.preset().name);
    set(dialog.path, file.string());
    dialog.path_follows = true;
  } else if (kind == DialogKind::picture) {
    set(dialog.path, (here / (ui.session.document.label + ".png")).string());
  } else if (kind == DialogKind::course_page) {
    set(dialog.path, ui.settings.course_page);
  } else if (kind == DialogKind::film) {
    set(dialog.path, (here / (ui.session.document.label + "_film")).string());
  } else if (kind == DialogKind::write_export) {
    set(dialog.path, (here / dialog.exporting->writes->file).string());
  }
}

void ask(Ui& ui, DialogKind kind, std::string question, Request then) {
  open_dialog(ui, kind);
  ui.dialog.question = std::move(question);
  ui.dialog.then = std::move(then);
}

void show_save_problem(Ui& ui, const fs::path& file, const std::string& name, const std::string& problem) {
  open_dialog(ui, DialogKind::save);
  set(ui.dialog.path, file.string());
  set(ui.dialog.name, name);
  ui.dialog.path_follows = false;
  refuse(ui.dialog, problem);
}

void show_picture_problem(Ui& ui, const PictureOrder& order, const std::string& problem) {
  open_dialog(ui, DialogKind::picture);
  set(ui.dialog.path, order.file.string());
  ui.dialog.whole_window = order.whole_window;
  refuse(ui.dialog, problem);
}

void dialogs(Ui& ui) {
  Dialog& dialog = ui.dialog;
  if (dialog.opening) ImGui::OpenPopup("dialog");
  dialog.opening = false;
  if (dialog.kind == DialogKind::none) return;
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  const bool question = dialog.kind == DialogKind::unsaved || dialog.kind == DialogKind::large_cloth;
  ImGui::SetNextWindowPos({window.x / 2, window.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  const bool cards = dialog.kind == DialogKind::open || dialog.kind == DialogKind::start;
  const float width = ui.theme.px(question ? 460 : cards ? 960 : 620);
  const bool small = cards && window.x < width;
  ImGui::SetNextWindowSize({std::min(width, window.x - ui.theme.px(small ? 12 : 24)), 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                      small ? ImVec2(ui.theme.px(14), ui.theme.px(10)) : ImVec2(ui.theme.px(24), ui.theme.px(20)));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, ui.theme.px(8));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  if (ImGui::BeginPopupModal("dialog", nullptr,
                             ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                 ImGuiWindowFlags_NoSavedSettings)) {
    ImGui::PushTextWrapPos(0);
    // Enter waits until the field has the text that was typed before it.
    const bool enter = std::exchange(dialog.enter, dialog.enter && !ui.input.unread);
    contents(ui);
    if (cards) end_gallery(ui);
    dialog.enter = enter && ui.input.unread;
    if (dialog.kind == DialogKind::none) ImGui::CloseCurrentPopup();
    ImGui::PopTextWrapPos();
    ImGui::EndPopup();
  }
  ImGui::PopStyleVar(3);
}

}  // namespace tyglab
