#include "app/ui/frame/gallery.h"

#include <algorithm>
#include <cstdio>
#include <system_error>
#include <utility>

#include "app/base/data_files.h"
#include "app/base/preset_files.h"
#include "app/session/lab_state.h"
#include "app/ui/frame/palette.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/scene_picture.h"
#include "app/ui/kit/symbol.h"
#include "app/ui/kit/widgets.h"
#include "core/io/preset_io.h"

namespace tyglab {
namespace {

namespace fs = std::filesystem;
constexpr const char *recent = "Recent work", *scenes = "Scenes", *yours = "Your presets", *labs = "Labs";
constexpr float least_card = 206, narrow_card = 160, between_at_1 = 12, inset = 12,
                lines_below = 2;  // sizes at scale 1

GalleryCard preset_card(const char* section, const fs::path& file, bool shipped) {
  GalleryCard card{section, {}, {}, {}};
  try {
    card.preset = load_preset(file);
    card.entry = preset_entry(card.preset, file, shipped);
    card.entry.purpose = card.preset.description;
  } catch (const std::exception& error) {
    card.entry.title = file.stem().string();
    card.problem = error.what();
  }
  return card;
}

void add_folder(std::vector<GalleryCard>& cards, const char* section, const fs::path& folder, bool shipped) {
  std::vector<GalleryCard> found;
  std::error_code ignored;
  for (const auto& file : fs::directory_iterator(folder, ignored))
    if (file.path().extension() == ".json") found.push_back(preset_card(section, file.path(), shipped));
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.entry.title < b.entry.title; });
  // The default scene is what one begins with.
  std::stable_partition(found.begin(), found.end(),
                        [](const GalleryCard& card) { return card.entry.keys == "hanging"; });
  std::move(found.begin(), found.end(), std::back_inserter(cards));
}

/// With the picture of the first scene that it opens.
GalleryCard lab_card(const Ui& ui, const Lab& lab) {
  GalleryCard card{labs, lab_entry(ui, lab), {}, {}};
  for (const LabStep& step : lab.steps) {
    if (!step.open) continue;
    try {
      card.preset = with_settings(read_preset(find_preset(step.open->preset).file), step.open->settings);
    } catch (const std::exception&) {
      // The lab itself says what is wrong when it is begun.
    }
    break;
  }
  return card;
}

/// As much of the text as that many lines hold.
std::string in_some_lines(const ImFont& font, const std::string& text, float width, int most) {
  const std::string lines = in_lines(font, text, width);
  std::size_t end = 0;
  for (int line = 0; line < most; ++line) {
    end = lines.find('\n', end);
    if (end == std::string::npos) return lines;
    if (line + 1 < most) ++end;
  }
  const std::size_t last = lines.rfind('\n', end - 1);
  const std::size_t start = last == std::string::npos ? 0 : last + 1;
  return lines.substr(0, start) + fitted(font, lines.substr(start, end - start) + "…", width);
}

struct CardSize {
  float width, picture, height;
};

CardSize card_size(const Ui& ui, float width) {
  const float picture = std::round(width / SceneSketch::aspect);
  return {width, picture,
          picture + ui.theme.px(2 * inset) + ui.fonts.title->FontSize + lines_below * ui.fonts.small->FontSize};
}

void draw_card(Ui& ui, const GalleryCard& card, ImVec2 lo, const CardSize& size, bool lit) {
  const Tokens& c = ui.theme.colors;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 hi{lo.x + size.width, lo.y + size.height};
  const float round = ui.theme.px(6), padding = ui.theme.px(inset), width = size.width - 2 * padding;
  draw.AddRectFilled(lo, hi, lit ? c.field_hover : c.field, round);
  const ImVec2 corner{hi.x, lo.y + size.picture};
  draw.AddRectFilled(lo, corner, c.ground, round, ImDrawFlags_RoundCornersTop);
  if (const SceneSketch* sketch = card.problem.empty() ? ui.sketches.of(card.preset) : nullptr)
    draw_scene(draw, ui.theme, *sketch, lo, corner);
  if (lit) draw.AddRect(lo, hi, c.accent, round, 0, ui.theme.px(2));
  const ImFont &title = *ui.fonts.title, &small = *ui.fonts.small;
  float y = corner.y + ui.theme.px(8);
  const std::string number = card.entry.number.empty() ? "" : card.entry.number + "  ";
  const std::string progress = card.section == labs ? card.entry.keys : "";
  draw_text(draw, title, {lo.x + padding, y}, c.text, fitted(title, number + card.entry.title, width));
  y += title.FontSize + ui.theme.px(4);
  const std::string& text = card.problem.empty() ? card.entry.purpose : card.problem;
  draw_text(draw, small, {lo.x + padding, y}, card.problem.empty() ? c.quiet : c.warning,
            in_some_lines(small, text, width, int(lines_below)));
  if (progress.empty()) return;
  const float wide = text_width(small, progress) + ui.theme.px(16), high = small.FontSize + ui.theme.px(8);
  const ImVec2 at{hi.x - wide - ui.theme.px(8), lo.y + ui.theme.px(8)};
  draw.AddRectFilled(at, {at.x + wide, at.y + high}, c.panel, ui.theme.px(4));
  draw_text(draw, small, {at.x + ui.theme.px(8), at.y + ui.theme.px(4)}, c.text, progress);
}

void choose(Ui& ui, const GalleryCard& card) {
  if (!card.problem.empty()) {
    ui.dialog.problem = card.problem;
    return;
  }
  ui.dialog.kind = Dialog::Kind::none;
  ui.act(card.entry.act);
}

void find_field(Ui& ui) {
  Gallery& gallery = ui.gallery;
  static constexpr const char* shown[] = {"All", "Scenes", "Labs"};
  const ImVec2 room = segments_size(ui, shown, 3);
  const bool with_labs = ui.dialog.kind == Dialog::Kind::start;
  if (std::exchange(gallery.focus, false)) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(with_labs ? -room.x - ui.theme.px(between_at_1) : -1);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(ui.theme.px(10), ui.theme.px(8)));
  ImGui::InputTextWithHint("##find", "Search", gallery.find, sizeof gallery.find);
  ImGui::PopStyleVar();
  report_control(ui, "find");
  if (!with_labs) return;
  ImGui::SameLine(0, ui.theme.px(between_at_1));
  ImGui::SetCursorPosY(ImGui::GetCursorPosY() + std::round((ImGui::GetItemRectSize().y - room.y) / 2));
  if (const int k = segments(ui, "sections", shown, 3, int(gallery.only)); k >= 0)
    gallery.only = Gallery::Only(k), gallery.selected = -1;
}

void heading(Ui& ui, const char* name) {
  ImGui::Dummy({0, ui.theme.px(4)});
  ImGui::PushFont(ui.fonts.title);
  wrapped(ui, name, ui.theme.colors.text);
  ImGui::PopFont();
  ImGui::Dummy({0, ui.theme.px(2)});
}

/// The cards that answer to what is typed, section by section.
std::vector<int> found_cards(const Gallery& gallery) {
  std::vector<PaletteEntry> entries;
  for (const GalleryCard& card : gallery.cards) entries.push_back(card.entry);
  std::vector<int> found = matching(entries, gallery.find);
  std::erase_if(found, [&](int n) {
    const bool lab = gallery.cards[std::size_t(n)].section == labs;
    return gallery.only != Gallery::Only::all && lab != (gallery.only == Gallery::Only::labs);
  });
  std::sort(found.begin(), found.end());
  return found;
}

/// Returns the card that was clicked, or -1.
int cards(Ui& ui, const std::vector<int>& found, bool moved) {
  const Gallery& gallery = ui.gallery;
  const float room = ImGui::GetContentRegionAvail().x - ui.theme.px(4), between = ui.theme.px(between_at_1);
  const int usual = int((room + between) / (ui.theme.px(least_card) + between));
  const int columns = std::max(usual, room > ui.theme.px(3 * narrow_card) ? 3 : 1);
  const CardSize size = card_size(ui, std::floor((room - float(columns - 1) * between) / float(columns)));
  int clicked = -1, column = 0;
  const char* section = nullptr;
  for (int n = 0; n < int(found.size()); ++n) {
    const GalleryCard& card = gallery.cards[std::size_t(found[std::size_t(n)])];
    if (section != card.section) section = card.section, column = 0, heading(ui, section);
    if (column > 0) ImGui::SameLine(0, between);
    ImGui::PushID(found[std::size_t(n)]);
    const ImVec2 lo = ImGui::GetCursorScreenPos();
    if (ImGui::InvisibleButton("card", {size.width, size.height})) clicked = found[std::size_t(n)];
    report_control(ui, "entry." + (card.section == scenes ? card.entry.keys : card.entry.title));
    if (!card.entry.purpose.empty()) tooltip(ui, gui::item_id(), card.entry.purpose);
    const bool chosen = n == gallery.selected;
    if (moved && chosen) ImGui::SetScrollHereY(0.5f);
    if (ImGui::IsRectVisible(lo, {lo.x + size.width, lo.y + size.height}))
      draw_card(ui, card, lo, size, chosen || ImGui::IsItemHovered());
    ImGui::PopID();
    column = (column + 1) % columns;
    if (column == 0) ImGui::Dummy({0, between - ImGui::GetStyle().ItemSpacing.y * 2});
  }
  if (found.empty()) wrapped(ui, "Nothing has that name. Try another word, or fewer.", ui.theme.colors.quiet);
  return clicked;
}

}  // namespace

void fill_gallery(Ui& ui, bool with_labs) {
  Gallery& gallery = ui.gallery;
  gallery = Gallery{};
  std::error_code ignored;
  for (const std::string& file : ui.settings.recent)
    if (fs::is_regular_file(file, ignored)) gallery.cards.push_back(preset_card(recent, file, false));
  add_folder(gallery.cards, scenes, data_folder() / "presets", true);
  if (const fs::path own = user_preset_folder(); !own.empty()) add_folder(gallery.cards, yours, own, false);
  if (!with_labs) return;
  for (const Lab& lab : find_labs(ui.session)) gallery.cards.push_back(lab_card(ui, lab));
}

void gallery(Ui& ui, float height) {
  Gallery& gallery = ui.gallery;
  find_field(ui);
  const std::vector<int> found = found_cards(gallery);
  if (std::exchange(gallery.narrowed, gallery.find) != gallery.find) gallery.selected = *gallery.find != 0 ? 0 : -1;
  const int go = std::exchange(gallery.go, 0);
  gallery.selected = std::clamp(gallery.selected + go, -1, int(found.size()) - 1);
  gui::begin_child("list", {0, std::clamp(height, ui.theme.px(120), ui.theme.px(560))});
  int chosen = cards(ui, found, go != 0);
  ImGui::EndChild();
  if (ui.sketches.poll()) ui.draw_by = std::min(ui.draw_by, ui.now + 0.05);
  if (ui.dialog.enter && gallery.selected >= 0) chosen = found[std::size_t(gallery.selected)];
  // Enter has taken the keys from the field.
  gallery.focus = ui.dialog.enter && ui.dialog.path[0] == 0;
  if (chosen < 0) return;
  ui.dialog.enter = false;
  choose(ui, gallery.cards[std::size_t(chosen)]);
}

}  // namespace tyglab
