#include "app/ui/frame/palette.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <sstream>
#include <utility>

#include "app/base/preset_files.h"
#include "app/ui/constants/engine_menu.h"
#include "app/ui/frame/commands.h"
#include "app/ui/frame/panels.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/symbol.h"
#include "app/ui/kit/widgets.h"
#include "core/integrators/scheme.h"
#include "core/io/preset_io.h"

namespace tyglab {
namespace {

std::string lower(std::string_view text) {
  std::string small(text);
  for (char& letter : small) letter = char(std::tolower(static_cast<unsigned char>(letter)));
  return small;
}

bool available(const App& app, Command command) {
  switch (command) {
    case Command::leave_lab:
      return app.labs.run.has_value();
    case Command::undo:
    case Command::undo_and_restart:
      return app.history.can_undo();
    case Command::redo:
      return app.history.can_redo();
    case Command::export_height:
    case Command::show_height:
      return app.preset().kind == Kind::one_weight;
    case Command::next_color:
    case Command::export_values:
    case Command::export_mesh:
      return app.preset().kind == Kind::cloth;
    case Command::export_copies:
    case Command::show_distances:
      return !app.copies.lockstep.empty();
    case Command::export_convergence:
      return app.convergence.study().has_value();
    case Command::open_palette:
      return false;  // it is open
    default:
      return true;
  }
}

void add_commands(const App& app, std::vector<PaletteEntry>& list) {
  for (const CommandRow& row : command_rows())
    if (available(app, row.command))
      list.push_back(
          {"Command", row.name, row.keys, row.also, row.help, [command = row.command](App& a) { a.command(command); }});
}

std::string progress(const App& app, const Lab& lab) {
  const int done = steps_done(app, lab), steps = int(lab.steps.size());
  if (done == 0) return std::to_string(steps) + " steps";
  return done == steps ? "done" : std::to_string(done) + " of " + std::to_string(steps);
}

std::string all_of(const Paragraphs& text) {
  std::string all;
  for (const std::string& paragraph : text) all += paragraph + " ";
  return all;
}

void add_labs(App& app, std::vector<PaletteEntry>& list) {
  for (const Lab& lab : find_labs(app))
    list.push_back({"Lab", lab.title, progress(app, lab), lab.label, all_of(lab.summary),
                    [label = lab.label](App& a) { begin_lab(a, label); }});
}

void add_presets(std::vector<PaletteEntry>& list, const std::filesystem::path& file, bool shipped) {
  try {
    const Preset preset = load_preset(file);
    list.push_back({"Preset", preset.name, file.stem().string(), file.stem().string() + " open", preset.description,
                    [file, shipped](App& a) { a.request(request::Open{.file = file, .shipped = shipped}); }});
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
std::function<void(App&)> proposing(Change change) {
  return [change](App& app) {
    Preset next = app.requested_preset();
    change(next);
    app.propose(std::move(next));
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

void add_constants(const App& app, std::vector<PaletteEntry>& list) {
  for (const PresetRow& row : notation())
    if (applies(row, app.requested_preset()))
      list.push_back({"Constant", std::string(row.symbol) + "  " + std::string(row.quantity), std::string(row.unit),
                      std::string(row.key) + " " + std::string(row.storhet), std::string(row.help),
                      [key = row.key](App& a) { show_constant(a, key); }});
}

void add_copies(const App& app, std::vector<PaletteEntry>& list) {
  for (const CopyChoice& choice : copy_choices(app.requested_preset()))
    list.push_back({"Copy", "Add a copy: " + choice.label, "", "with beside compare", "", [choice](App& a) {
                      a.request(request::AddCopy{choice.differences, choice.reference});
                    }});
}

void add_views(std::vector<PaletteEntry>& list) {
  for (int k = 0; k < int(view_names.size()); ++k)
    list.push_back({"View", view_names[std::size_t(k)] + 2, std::to_string(k + 1), "", "",
                    proposing([k](Preset& next) { next.mode = k + 1; })});
}

void add_colors(const App& app, std::vector<PaletteEntry>& list) {
  const auto colored = [](std::optional<ParticleField> field) {
    return [field](App& a) { a.request(request::ColorBy{field}); };
  };
  list.push_back({"Colour", "Own colours", "", "cloth texture", "", colored(std::nullopt)});
  for (const FieldInfo& field : particle_fields())
    if (why_not_colored(app, field.field).empty())
      list.push_back({"Colour", std::string(field.title), std::string(field.unit),
                      std::string(field.name) + " color cloth", "", colored(field.field)});
}

/// The kind of thing stands before its name, unless all are of one.
void palette_row(App& app, const PaletteEntry& entry, bool chosen, float width) {
  const Tokens& c = app.theme.colors;
  const float height = app.theme.px(28), padding = app.theme.px(10), group = app.ui.palette.labs ? 0 : app.theme.px(84);
  const ImVec2 lo = ImGui::GetItemRectMin(), hi{lo.x + width, lo.y + height};
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (chosen) draw.AddRectFilled(lo, hi, mixed(c.field, c.accent, 0.3f), app.theme.px(5));
  const float baseline = baseline_at(app.fonts, lo.y + height / 2);
  const ImFont &text = *app.fonts.text, &small = *app.fonts.small;
  const float keys = text_width(small, entry.keys), right = hi.x - padding - keys;
  if (group > 0) draw_on_baseline(draw, small, {lo.x + padding, baseline}, c.quiet, entry.group);
  draw_on_baseline(draw, text, {lo.x + padding + group, baseline}, c.text,
                   fitted(text, entry.title, right - padding - lo.x - padding - group));
  draw_on_baseline(draw, small, {right, baseline}, chosen ? c.text : c.quiet, entry.keys);
}

void act(App& app, int index) {
  CommandPalette& palette = app.ui.palette;
  palette.open = false;
  const auto action = palette.entries[std::size_t(index)].act;
  action(app);
}

void palette_field(App& app) {
  CommandPalette& palette = app.ui.palette;
  if (std::exchange(palette.opening, false)) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-1);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(app.theme.px(10), app.theme.px(9)));
  ImGui::InputTextWithHint("##find", palette.labs ? "Find a lab" : "Find a command, preset, lab, method or constant",
                           palette.text, sizeof palette.text);
  ImGui::PopStyleVar();
  report_control(app, "find");
}

/// The list, in which the pointer chooses as it moves. Returns the entry that was clicked, or -1.
int palette_list(App& app, const std::vector<int>& found, float height, bool moved) {
  CommandPalette& palette = app.ui.palette;
  int clicked = -1;
  gui::begin_child("list", {0, height});
  const float width = ImGui::GetContentRegionAvail().x;
  for (int k = 0; k < int(found.size()); ++k) {
    ImGui::PushID(k);
    const PaletteEntry& entry = palette.entries[std::size_t(found[std::size_t(k)])];
    if (ImGui::InvisibleButton("entry", {width, app.theme.px(28)})) clicked = found[std::size_t(k)];
    report_control(app, entry.group + "." + entry.title);
    const ImVec2 way = ImGui::GetIO().MouseDelta;
    if (ImGui::IsItemHovered() && (way.x != 0 || way.y != 0)) palette.selected = k;
    if (moved && k == palette.selected) ImGui::SetScrollHereY(0.5f);
    palette_row(app, entry, k == palette.selected, width);
    ImGui::PopID();
  }
  if (found.empty()) wrapped(app, "Nothing is called so. Try another word, or fewer.", app.theme.colors.quiet);
  ImGui::EndChild();
  return clicked;
}

void palette_contents(App& app, float height) {
  CommandPalette& palette = app.ui.palette;
  palette_field(app);
  const std::vector<int> found = matching(palette.entries, palette.text);
  ImGui::Dummy({0, app.theme.px(4)});
  if (palette.narrowed != palette.text) palette.narrowed = palette.text, palette.selected = 0;
  const bool moved = palette.go != 0;
  palette.selected = std::clamp(palette.selected + std::exchange(palette.go, 0), 0, std::max(int(found.size()) - 1, 0));
  const float rows = float(std::max(int(found.size()), 1)) * app.theme.px(30);
  const int clicked = palette_list(app, found, std::min(height, rows), moved);
  // Enter counts once the field has been shown all that was typed before it.
  const bool enter = palette.enter && !app.input.unread;
  if (enter) palette.enter = false;
  if (clicked >= 0) return act(app, clicked);
  if (enter && !found.empty()) act(app, found[std::size_t(palette.selected)]);
  palette.opening = enter && found.empty();  // Enter has taken the keys from the field
}

/// How well an entry answers to the words, the best 0; none: not at all.
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
  const int rank = !holds(all, "")                              ? 3
                   : title.starts_with(first) || key            ? 0
                   : all.find(" " + first) != std::string::npos ? 1
                                                                : 2;
  return 2 * rank + !holds(all, " ");  // "implicit euler" is rather a method of that name than the semi-implicit one
}

}  // namespace

std::vector<PaletteEntry> palette_entries(App& app) {
  std::vector<PaletteEntry> list;
  add_commands(app, list);
  add_engines(list);
  add_labs(app, list);
  add_all_presets(list);
  add_integrators(list);
  add_constants(app, list);
  add_copies(app, list);
  add_views(list);
  add_colors(app, list);
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

void open_palette(App& app, bool labs) {
  CommandPalette& palette = app.ui.palette;
  palette = CommandPalette{};
  palette.open = palette.opening = true, palette.labs = labs;
  if (labs) {
    add_labs(app, palette.entries);
  } else {
    palette.entries = palette_entries(app);
  }
}

void palette(App& app) {
  CommandPalette& palette = app.ui.palette;
  if (app.ui.dialog.kind != Dialog::Kind::none) palette.open = false;
  if (!palette.open) return;
  const ImVec2 window = ImGui::GetIO().DisplaySize;
  const float width = std::min(app.theme.px(560), window.x - app.theme.px(24)), top = app.theme.px(72);
  const float list = std::min(app.theme.px(392), window.y - top - app.theme.px(96));
  ImGui::SetNextWindowPos({std::round((window.x - width) / 2), top});
  ImGui::SetNextWindowSize({width, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(app.theme.px(12), app.theme.px(12)));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, app.theme.px(8));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(app.theme.px(8), app.theme.px(2)));
  if (palette.opening) ImGui::SetNextWindowFocus();
  if (ImGui::Begin("palette", nullptr,
                   ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                       ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoScrollbar)) {
    const bool elsewhere =
        ImGui::IsMouseClicked(ImGuiMouseButton_Left) && !ImGui::IsWindowHovered(ImGuiHoveredFlags_RootAndChildWindows);
    if (elsewhere) palette.open = false;
    if (palette.open) palette_contents(app, std::max(list, app.theme.px(60)));
  }
  ImGui::End();
  ImGui::PopStyleVar(4);
}

}  // namespace tyglab
