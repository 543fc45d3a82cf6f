#include "app/ui/frame/panels.h"

#include <algorithm>
#include <cstdio>
#include <system_error>
#include <utility>

#include "app/base/files.h"
#include "app/session/lab_state.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"
#include "core/io/preset_io.h"

namespace tyglab {
namespace {

namespace fs = std::filesystem;
constexpr const char *recent = "Recent work", *scenes = "Scenes", *fabric_scenes = "Fabrics", *yours = "Your presets",
                     *labs = "Labs";
constexpr float least_card = 190, narrow_card = 160, between_at_1 = 12;  // sizes at scale 1
constexpr float low_window_at_1 = 480, lowest_list_at_1 = 60, highest_list_at_1 = 560;

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
  // One scene with each fabric: to be compared, so they stand together.
  for (GalleryCard& card : found)
    if (shipped && card.entry.keys.starts_with("fabric_")) card.section = fabric_scenes;
  std::stable_partition(found.begin(), found.end(),
                        [](const GalleryCard& card) { return card.section != fabric_scenes; });
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

/// Cards of one section that stand beside each other.
struct CardRow {
  const char* section;
  std::vector<int> places;  ///< among those that are found
  float height = 0;         ///< px, of the highest
};

std::vector<CardRow> card_rows(const Ui& ui, const std::vector<int>& found, int columns, const CardShape& shape) {
  std::vector<CardRow> rows;
  for (int n = 0; n < int(found.size()); ++n) {
    const GalleryCard& card = ui.gallery.cards[std::size_t(found[std::size_t(n)])];
    if (rows.empty() || rows.back().section != card.section || int(rows.back().places.size()) == columns)
      rows.push_back({card.section, {}});
    CardRow& row = rows.back();
    row.places.push_back(n);
    row.height = std::max(row.height, card_text(ui, card, shape).height);
  }
  return rows;
}

/// Returns whether it was clicked.
bool one_card(Ui& ui, const GalleryCard& card, const CardShape& shape, float height, bool chosen) {
  const ImVec2 lo = ImGui::GetCursorScreenPos(), hi{lo.x + shape.width, lo.y + height};
  const bool clicked = gui::press_area("card", {shape.width, height});
  const bool by_file = card.section == scenes || card.section == fabric_scenes;
  report_control(ui, "entry." + (by_file ? card.entry.keys : card.entry.title));
  if (ImGui::IsItemHovered() && !card_text(ui, card, shape).whole) tooltip(ui, gui::item_id(), card.entry.purpose);
  if (ImGui::IsRectVisible(lo, hi)) draw_gallery_card(ui, card, lo, shape, height, chosen || ImGui::IsItemHovered());
  return clicked;
}

/// Returns the card that was clicked, or -1.
int cards(Ui& ui, const std::vector<int>& found, bool moved) {
  const Gallery& gallery = ui.gallery;
  const float room = ImGui::GetContentRegionAvail().x - ui.theme.px(4), between = ui.theme.px(between_at_1);
  const int usual = int((room + between) / (ui.theme.px(least_card) + between));
  const int columns = std::max(usual, room > ui.theme.px(3 * narrow_card) ? 3 : 1);
  const CardShape shape =
      card_shape(ui, std::floor((room - float(columns - 1) * between) / float(columns)), columns == 1);
  int clicked = -1;
  const char* section = nullptr;
  for (const CardRow& row : card_rows(ui, found, columns, shape)) {
    if (section != row.section) section = row.section, heading(ui, section);
    for (std::size_t k = 0; k < row.places.size(); ++k) {
      const int n = row.places[k], card = found[std::size_t(n)];
      if (k > 0) ImGui::SameLine(0, between);
      ImGui::PushID(card);
      if (one_card(ui, gallery.cards[std::size_t(card)], shape, row.height, n == gallery.selected)) clicked = card;
      if (moved && n == gallery.selected) ImGui::SetScrollHereY(0.5f);
      ImGui::PopID();
    }
    ImGui::Dummy({0, between - ImGui::GetStyle().ItemSpacing.y * 2});
  }
  if (found.empty()) wrapped(ui, "No matches.", ui.theme.colors.quiet);
  return clicked;
}

/// Whether the window is so low that what stands over the cards scrolls with them.
bool low_window(const Ui& ui) {
  return ImGui::GetIO().DisplaySize.y < ui.theme.px(low_window_at_1);
}

/// What the window leaves between what stands over the list and what stood below it in the last frame, px.
float list_height(const Ui& ui) {
  const float room = ImGui::GetIO().DisplaySize.y - ui.theme.px(16) - ImGui::GetCursorPosY() - ui.gallery.below -
                     ImGui::GetStyle().WindowPadding.y;
  return std::clamp(room, ui.theme.px(lowest_list_at_1), ui.theme.px(highest_list_at_1));
}

}  // namespace

void fill_gallery(Ui& ui, bool with_labs) {
  Gallery& gallery = ui.gallery;
  gallery = Gallery{};
  gallery.below = ui.theme.px(with_labs ? 44 : 132);  // until it is measured
  std::error_code ignored;
  for (const std::string& file : ui.settings.recent)
    if (fs::is_regular_file(file, ignored)) gallery.cards.push_back(preset_card(recent, file, false));
  add_folder(gallery.cards, scenes, data_folder() / "presets", true);
  if (const fs::path own = user_preset_folder(); !own.empty()) add_folder(gallery.cards, yours, own, false);
  if (!with_labs) return;
  for (const Lab& lab : find_labs(ui.session)) gallery.cards.push_back(lab_card(ui, lab));
}

void gallery(Ui& ui, const std::function<void(bool low)>& head) {
  Gallery& gallery = ui.gallery;
  const bool low = low_window(ui);
  if (!low) head(false);
  find_field(ui);
  const std::vector<int> found = found_cards(gallery);
  if (std::exchange(gallery.narrowed, gallery.find) != gallery.find) gallery.selected = *gallery.find != 0 ? 0 : -1;
  const int go = std::exchange(gallery.go, 0);
  gallery.selected = std::clamp(gallery.selected + go, -1, int(found.size()) - 1);
  gui::begin_child("list", {0, list_height(ui)});
  if (low) {
    ImGui::PushTextWrapPos(0);
    head(true);
    ImGui::PopTextWrapPos();
  }
  int chosen = cards(ui, found, go != 0);
  ImGui::EndChild();
  gallery.end = ImGui::GetCursorPosY();
  if (ui.sketches.poll()) ui.draw_by = std::min(ui.draw_by, ui.now + 0.05);
  if (ui.dialog.enter && gallery.selected >= 0) chosen = found[std::size_t(gallery.selected)];
  // Enter has taken the keys from the field.
  gallery.focus = ui.dialog.enter && ui.dialog.path[0] == 0;
  if (chosen < 0) return;
  ui.dialog.enter = false;
  choose(ui, gallery.cards[std::size_t(chosen)]);
}

bool gallery_choice(const Ui& ui) {
  return ui.gallery.selected >= 0;
}

void open_gallery_choice(Ui& ui) {
  const std::vector<int> found = found_cards(ui.gallery);
  const auto place = std::size_t(ui.gallery.selected);
  if (place < found.size()) choose(ui, ui.gallery.cards[std::size_t(found[place])]);
}

void end_gallery(Ui& ui) {
  ui.gallery.below = ImGui::GetCursorPosY() - ui.gallery.end;
}

}  // namespace tyglab
