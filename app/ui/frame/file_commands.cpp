// Commands for presets and other files.
#include <imgui.h>

#include "app/base/files.h"
#include "app/base/text.h"
#include "app/platform/platform.h"
#include "app/session/document.h"
#include "app/ui/frame/commands.h"
#include "app/ui/frame/panels.h"
#include "core/model/notation.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

template <Dialog::Kind kind>
void dialog(Ui& ui) {
  open_dialog(ui, kind);
}

void save(Ui& ui) {
  const Document& document = ui.session.document;
  if (document.file.empty()) return open_dialog(ui, Dialog::Kind::save);
  save_document_as(ui.session, document.file, ui.session.preset().name);
}

/// "--set k_s=80" for each constant, so that a command line gives the same scene.
void copy_as_options(Ui& ui) {
  const Preset preset = ui.session.requested_preset();
  std::string text;
  const auto add = [&](std::string_view key, const std::string& value) {
    text += (text.empty() ? "--set " : " --set ") + std::string(key) + "=" + value;
  };
  for (const PresetRow& row : notation()) {
    if (row.effect == Effect::view || (row.only_one_kind && row.only != preset.kind)) continue;
    if (is_absent(row, preset)) continue;
    if (const auto* number = std::get_if<double Preset::*>(&row.field)) add(row.key, shortest_number(preset.**number));
    if (const auto* count = std::get_if<int Preset::*>(&row.field)) add(row.key, std::to_string(preset.**count));
    if (const auto* word = std::get_if<std::string Preset::*>(&row.field)) add(row.key, preset.**word);
    if (const auto* vector = std::get_if<glm::dvec3 Preset::*>(&row.field)) {
      const glm::dvec3& v = preset.**vector;
      add(row.key, "[" + shortest_number(v.x) + "," + shortest_number(v.y) + "," + shortest_number(v.z) + "]");
    }
  }
  ImGui::SetClipboardText(text.c_str());
  if (clipboard_took()) ui.messages.note("Copied the constants as --set options.");
}

/// Where copied links begin: the course's page, or the page that this runs in.
std::string link_address(const Ui& ui) {
  return ui.settings.course_page.empty() ? page_address() : ui.settings.course_page;
}

void note_copied(Ui& ui, std::string what) {
  if (!clipboard_took()) return;
  const std::string& texture = ui.session.requested_preset().texture;
  if (!texture.empty() && !is_shipped_texture(texture)) what += " The link does not contain the preset's own texture.";
  ui.messages.note(std::move(what));
}

/// With the address of a page; where none is known the link alone, which any page and the command line take.
void copy_link(Ui& ui) {
  const std::string address = link_address(ui);
  ImGui::SetClipboardText((address + link_to(ui.session.requested_preset(), ui.session.document.label)).c_str());
  note_copied(
      ui, address.empty() ? "Link copied, without an address: “Course page…”, in Ctrl+P, sets one." : "Link copied.");
}

std::string no_address(const Ui& ui) {
  return link_address(ui).empty() ? "Set the address of your Tyglab page first: “Course page…”, in Ctrl+P." : "";
}

/// HTML that shows a link of the page at `address` in a frame; `lab`: the lab's, empty: none.
std::string embed_code(const std::string& address, const std::string& link, const std::string& lab) {
  std::string what = lab.empty() ? "?embed" + link : "?embed&lab=" + lab;
  for (std::size_t at = 0; (at = what.find('&', at)) != std::string::npos; ++at) what.insert(at + 1, "amp;");
  return "<iframe width=\"900\" height=\"640\" src=\"" + address + what + "\"></iframe>";
}

void copy_embed_code(Ui& ui) {
  const std::string link = link_to(ui.session.requested_preset(), ui.session.document.label);
  const auto& lab = ui.session.labs.run;
  ImGui::SetClipboardText(embed_code(link_address(ui), link, lab ? lab->lab.label : "").c_str());
  note_copied(ui, "Embed code copied.");
}

void request_quit(Ui& ui) {
  ui.session.request(request::Quit{});
}

}  // namespace

std::vector<CommandRow> file_rows() {
  return {{"open_dialog",
           "Open…",
           "Ctrl+O",
           {{GLFW_KEY_O, ctrl}},
           "opens a preset",
           "file load",
           dialog<Dialog::Kind::open>,
           nullptr,
           {},
           nullptr,
           true},
          {"save", "Save", "Ctrl+S", {{GLFW_KEY_S, ctrl}}, "saves the preset", "file write", save},
          {"save_as",
           "Save as…",
           "Ctrl+Shift+S",
           {{GLFW_KEY_S, ctrl_shift}},
           "saves the preset under another name",
           "file write",
           dialog<Dialog::Kind::save>,
           nullptr,
           {},
           nullptr,
           true},
          {"save_picture",
           "Save an image…",
           "Ctrl+Shift+P",
           {{GLFW_KEY_P, ctrl_shift}},
           "saves an image of the cloth",
           "png screenshot picture export",
           dialog<Dialog::Kind::picture>,
           nullptr,
           {},
           nullptr,
           true},
          {"load_texture_dialog", "Use image as texture…", "", {}, "", "picture cloth", dialog<Dialog::Kind::texture>},
          {"copy_link", "Copy link", "", {}, "", "share address url browser page clipboard export", copy_link},
          {"copy_embed_code",
           "Copy embed code",
           "",
           {},
           "",
           "iframe html course page link share clipboard",
           copy_embed_code,
           no_address},
          {"course_page",
           "Course page…",
           "",
           {},
           "",
           "address url link share embed settings",
           dialog<Dialog::Kind::course_page>},
          {"copy_options",
           "Copy the constants as --set options",
           "",
           {},
           "",
           "command line clipboard share export",
           copy_as_options},
          {"quit", "Quit", "Ctrl+Q", {{GLFW_KEY_Q, ctrl}}, "quits", "end close exit", request_quit}};
}

}  // namespace tyglab
