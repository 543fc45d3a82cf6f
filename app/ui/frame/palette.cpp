#include "app/ui/frame/panels.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <sstream>
#include <utility>

#include "app/base/files.h"
#include "app/ui/constants/constants_panel.h"
#include "app/ui/frame/commands.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"
#include "app/ui/overlay/overlay.h"
#include "core/integrators/scheme.h"
#include "core/io/preset_io.h"

namespace tyglab {
namespace {

std::string lower(std::string_view text) {
  std::string small(text);
  for (char& letter : small) letter = char(std::tolower(static_cast<unsigned char>(letter)));
  return small;
}

void add_commands(const Ui& ui, std::vector<PaletteEntry>& list) {
  for (const CommandTopic& topic : command_topics())
    for (const CommandRow& row : topic.rows)
      if (why_not(ui, row).empty())
        list.push_back({"Command", row.name, row.keys, row.also, row.help, [id = row.id](Ui& u) { u.command(id); }});
}

std::string progress(const Ui& ui, const Lab& lab) {
  const int done = steps_done(ui.session, lab), steps = int(lab.steps.size());
  if (done == steps) return "done";
  const std::string minutes = lab.minutes > 0 ? " · " + std::to_string(lab.minutes) + " min" : "";
  return (done == 0 ? std::to_string(steps) + " steps" : std::to_string(done) + " of " + std::to_string(steps)) +
         minutes;
}

/// "1" of "01_hooke"; empty where the file's name begins with no number.
std::string number_of(const Lab& lab) {
  const std::string digits = lab.label.substr(0, lab.label.find_first_not_of("0123456789"));
  const auto first = digits.find_first_not_of('0');
  return first == std::string::npos ? "" : digits.substr(first);
}

std::string all_of(const Paragraphs& text) {
  std::string all;
  for (const std::string& paragraph : text) all += paragraph + " ";
  return all;
}

void add_labs(Ui& ui, std::vector<PaletteEntry>& list) {
  for (const Lab& lab : find_labs(ui.session)) list.push_back(lab_entry(ui, lab));
}

void add_presets(std::vector<PaletteEntry>& list, const std::filesystem::path& file, bool shipped) {
  try {
    list.push_back(preset_entry(load_preset(file), file, shipped));
  } catch (const PresetError&) {
    // The dialog that opens files says what is wrong with one.
  }
}

void add_all_presets(std::vector<PaletteEntry>& list) {
  for (const std::string& name : shipped_presets()) add_presets(list, find_preset(name).file, true);
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(user_preset_folder(), ignored))
    if (entry.path().extension() == ".json") add_presets(list, entry.path(), false);
}

/// Asks for the present constants with one thing changed.
template <class Change>
std::function<void(Ui&)> proposing(Change change) {
  return [change](Ui& ui) {
    Preset next = ui.session.requested_preset();
    change(next);
    ui.session.propose(std::move(next));
  };
}

void add_integrators(std::vector<PaletteEntry>& list) {
  for (const Scheme& method : schemes())
    list.push_back({"Integrator", std::string(method.title), std::string(method.equation), std::string(method.name),
                    std::string(method.note), proposing([&method](Preset& next) { next.integrator = method.name; })});
}

void add_engines(std::vector<PaletteEntry>& list) {
  for (const EngineMode& mode : engine_modes())
    list.push_back({"Engine", mode.title, "", "engine precision", "",
                    proposing([&mode](Preset& next) { next.engine = mode.engine, next.precision = mode.precision; })});
}

void add_constants(const Ui& ui, std::vector<PaletteEntry>& list) {
  for (const PresetRow& row : notation())
    if (applies(row, ui.session.requested_preset()) || is_word_row(row, ui.session.requested_preset()))
      list.push_back({"Constant",
                      (row.symbol.empty() ? "" : std::string(row.symbol) + "  ") + std::string(row.quantity),
                      std::string(row.unit), std::string(row.key) + " " + std::string(row.storhet),
                      std::string(row.help), [key = row.key](Ui& u) { show_constant(u, key); }});
}

/// The method that it differs in, as presets write it: "rk4"; empty where it has the same.
std::string method_of_copy(const CopyChoice& choice) {
  for (const Difference& difference : choice.differences)
    if (const std::string* method = difference.value_of(&Preset::integrator)) return *method;
  return {};
}

void add_copies(const Ui& ui, std::vector<PaletteEntry>& list) {
  for (const CopyChoice& choice : copy_choices(ui.session.requested_preset()))
    list.push_back({"Copy", "Add a copy: " + choice.label, "", "with beside compare " + method_of_copy(choice), "",
                    [choice](Ui& u) {
                      u.session.request(request::AddCopy{choice.differences, choice.reference});
                    }});
}

void add_views(std::vector<PaletteEntry>& list) {
  for (int k = 0; k < int(view_names.size()); ++k)
    list.push_back({"View", view_names[std::size_t(k)] + 2, std::to_string(k + 1), "", "",
                    proposing([k](Preset& next) { next.mode = k + 1; })});
}

void add_colors(const Ui& ui, std::vector<PaletteEntry>& list) {
  const auto colored = [](std::optional<ParticleField> field) { return [field](Ui& u) { u.color_by(field); }; };
  list.push_back({"Color", "Texture", "", "cloth own colors", "", colored(std::nullopt)});
  for (const FieldInfo& field : particle_fields())
    if (why_not_colored(ui.scene, field.field).empty())
      list.push_back({"Color", std::string(field.title), std::string(field.unit),
                      std::string(field.name) + " color cloth", "", colored(field.field)});
}

/// The kind of thing stands before its name, unless all are of one.
/// With what a lab is for under its title.
float row_height(const Ui& ui, const PaletteEntry& entry, float width) {
  const float title = ui.theme.px(28);
  if (!ui.palette.labs || entry.purpose.empty()) return title;
  const ImFont& small = *ui.fonts.small;
  const std::string purpose = in_lines(small, entry.purpose, width - ui.theme.px(26 + 20));
  return title + small.CalcTextSizeA(small.FontSize, 1e9f, 0, purpose.c_str()).y + ui.theme.px(8);
}

void palette_row(Ui& ui, const PaletteEntry& entry, bool chosen, float width) {
  const Tokens& c = ui.theme.colors;
  const bool labs = ui.palette.labs;
  const float height = ui.theme.px(28), padding = ui.theme.px(10), group = ui.theme.px(labs ? 26 : 84);
  const ImVec2 lo = ImGui::GetItemRectMin(), hi = ImGui::GetItemRectMax();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (chosen) draw.AddRectFilled(lo, hi, mixed(c.field, c.accent, 0.3f), ui.theme.px(5));
  const float baseline = baseline_at(ui.fonts, lo.y + height / 2);
  const ImFont &text = *ui.fonts.text, &small = *ui.fonts.small;
  const float keys = text_width(small, entry.keys), right = hi.x - padding - keys;
  draw_on_baseline(draw, small, {lo.x + padding, baseline}, c.quiet, labs ? entry.number : entry.group);
  if (labs)
    draw_text(draw, small, {lo.x + padding + group, lo.y + height}, chosen ? c.text : c.quiet,
              in_lines(small, entry.purpose, width - group - 2 * padding));
  draw_on_baseline(draw, text, {lo.x + padding + group, baseline}, c.text,
                   fitted(text, entry.title, right - padding - lo.x - padding - group));
  draw_on_baseline(draw, small, {right, baseline}, chosen ? c.text : c.quiet, entry.keys);
}

void act(Ui& ui, int index) {
  CommandPalette& palette = ui.palette;
  palette.open = false;
  const auto action = palette.entries[std::size_t(index)].act;
  action(ui);
}

void palette_field(Ui& ui) {
  CommandPalette& palette = ui.palette;
  if (std::exchange(palette.opening, false)) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(ui.theme.px(10), ui.theme.px(9)));
  ImGui::InputTextWithHint("##find", palette.labs ? "Find a lab" : "Find a command, preset, lab, method or constant",
                           palette.text, sizeof palette.text);
  ImGui::PopStyleVar();
  report_control(ui, "find");
}

/// The list, in which the pointer chooses as it moves. Returns the entry that was clicked, or -1.
int palette_list(Ui& ui, const std::vector<int>& found, float height, bool moved) {
  CommandPalette& palette = ui.palette;
  int clicked = -1;
  gui::begin_child("list", {0, height});
  const float width = ImGui::GetContentRegionAvail().x;
  for (int k = 0; k < int(found.size()); ++k) {
    ImGui::PushID(k);
    const PaletteEntry& entry = palette.entries[std::size_t(found[std::size_t(k)])];
    if (gui::press_area("entry", {width, row_height(ui, entry, width)})) clicked = found[std::size_t(k)];
    report_control(ui, entry.group + "." + entry.title);
    const ImVec2 way = ImGui::GetIO().MouseDelta;
    if (ImGui::IsItemHovered() && (way.x != 0 || way.y != 0)) palette.selected = k;
    if (moved && k == palette.selected) ImGui::SetScrollHereY(0.5f);
    palette_row(ui, entry, k == palette.selected, width);
    ImGui::PopID();
  }
  if (found.empty()) wrapped(ui, "No matches.", ui.theme.colors.quiet);
  ImGui::EndChild();
  return clicked;
}

void palette_contents(Ui& ui, float height) {
  CommandPalette& palette = ui.palette;
  palette_field(ui);
  const std::vector<int> found = matching(palette.entries, palette.text);
  ImGui::Dummy({0, ui.theme.px(4)});
  if (palette.narrowed != palette.text) palette.narrowed = palette.text, palette.selected = 0;
  const bool moved = std::exchange(palette.scroll, false) || palette.go != 0;
  palette.selected = std::clamp(palette.selected + std::exchange(palette.go, 0), 0, std::max(int(found.size()) - 1, 0));
  float rows = found.empty() ? ui.theme.px(30) : 0;
  for (const int k : found)
    rows += row_height(ui, palette.entries[std::size_t(k)], ImGui::GetContentRegionAvail().x) + ui.theme.px(2);
  const int clicked = palette_list(ui, found, std::min(height, rows), moved);
  // Enter counts once the field has been shown all that was typed before it.
  const bool enter = palette.enter && !ui.input.unread;
  if (enter) palette.enter = false;
  if (clicked >= 0) return act(ui, clicked);
  if (enter && !found.empty()) act(ui, found[std::size_t(palette.selected)]);
  palette.opening = enter && found.empty();  // Enter has taken the keys from the field
}

/// How well an entry answers to the words, the best below 0; none: not at all.
std::optional<int> rank_of(const PaletteEntry& entry, std::span<const std::string> words) {
  const std::string title = lower(entry.title),
                    all = " " + title + " " + lower(entry.also) + " " + lower(entry.group) + " ";
  const auto holds = [&](const std::string& text, const std::string& before) {
    return std::all_of(words.begin(), words.end(),
                       [&](const std::string& word) { return text.find(before + word) != std::string::npos; });
  };
  if (!holds(all + lower(entry.help), "")) return std::nullopt;
  const std::string first = words.empty() ? "" : words.front();
  const bool key = entry.group == "Constant" && all.find(" " + first + " ") != std::string::npos;
  const bool exact = title.starts_with(first + "  ") || lower(entry.also).starts_with(first + " ");  // symbol, key
  if (entry.group == "Constant" && exact && words.size() == 1) return -1;
  // A lab takes the place of what is there, so it comes after all others that have such a name.
  const int rank = !holds(all, "")                              ? 4
                   : entry.group == "Lab"                       ? 3
                   : title.starts_with(first) || key            ? 0
                   : all.find(" " + first) != std::string::npos ? 1
                                                                : 2;
  return 2 * rank + !holds(all, " ");  // "implicit euler" is rather a method of that name than the semi-implicit one
}

/// Which of the labs is going on, or is to be done next: the first that is not done.
int next_lab(Ui& ui) {
  const std::vector<Lab>& list = find_labs(ui.session);
  const auto& run = ui.session.labs.run;
  const auto next = std::find_if(list.begin(), list.end(), [&](const Lab& lab) {
    return run ? lab.label == run->lab.label : steps_done(ui.session, lab) < int(lab.steps.size());
  });
  return next == list.end() ? 0 : int(next - list.begin());
}

}  // namespace

PaletteEntry lab_entry(const Ui& ui, const Lab& lab) {
  return {"Lab",
          lab.title,
          progress(ui, lab),
          lab.label,
          all_of(lab.summary),
          [label = lab.label](Ui& u) { begin_lab(u.session, label); },
          number_of(lab),
          lab.summary.empty() ? "" : lab.summary.front()};
}

PaletteEntry preset_entry(const Preset& preset, const std::filesystem::path& file, bool shipped) {
  const std::string label = file.stem().string();
  return {"Preset", preset.name, label, label + " open", preset.description, [file, shipped](Ui& u) {
            u.session.request(request::Open{.file = file, .shipped = shipped});
          }};
}

std::vector<PaletteEntry> palette_entries(Ui& ui) {
  std::vector<PaletteEntry> list;
  add_commands(ui, list);
  add_engines(list);
  add_labs(ui, list);
  add_all_presets(list);
  add_integrators(list);
  add_constants(ui, list);
  add_copies(ui, list);
  add_views(list);
  add_colors(ui, list);
  return list;
}

std::vector<int> matching(std::span<const PaletteEntry> entries, std::string_view typed) {
  std::istringstream in(lower(typed));
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  std::vector<std::pair<int, int>> ranked;  // rank, index
  for (int k = 0; k < int(entries.size()); ++k)
    if (const auto rank = rank_of(entries[std::size_t(k)], words)) ranked.emplace_back(*rank, k);
  std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<int> found;
  for (const auto& [rank, index] : ranked) found.push_back(index);
  return found;
}

void open_palette(Ui& ui, bool labs) {
  CommandPalette& palette = ui.palette;
  palette = CommandPalette{};
  palette.open = palette.opening = true, palette.labs = labs;
  if (labs) {
    add_labs(ui, palette.entries);
    palette.selected = next_lab(ui), palette.scroll = true;
  } else {
    palette.entries = palette_entries(ui);
  }
}

void palette(Ui& ui) {
  CommandPalette& palette = ui.palette;
  if (ui.dialog.kind != Dialog::Kind::none) palette.open = false;
  if (!palette.open) return;
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  const float width = std::min(ui.theme.px(560), window.x - ui.theme.px(24)), top = ui.theme.px(72);
  const float list = std::min(ui.theme.px(392), window.y - top - ui.theme.px(96));
  ImGui::SetNextWindowPos({std::round((window.x - width) / 2), top});
  ImGui::SetNextWindowSize({width, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(ui.theme.px(12), ui.theme.px(12)));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, ui.theme.px(8));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(ui.theme.px(8), ui.theme.px(2)));
  if (palette.opening) ImGui::SetNextWindowFocus();
  if (ImGui::Begin("palette", nullptr,
                   ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                       ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoScrollbar)) {
    const bool elsewhere =
        ImGui::IsMouseClicked(ImGuiMouseButton_Left) && !ImGui::IsWindowHovered(ImGuiHoveredFlags_RootAndChildWindows);
    if (elsewhere) palette.open = false;
    if (palette.open) palette_contents(ui, std::max(list, ui.theme.px(60)));
  }
  ImGui::End();
  ImGui::PopStyleVar(4);
}

}  // namespace tyglab
