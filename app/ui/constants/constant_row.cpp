#include "app/ui/constants/constants_panel.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "app/base/text.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"
#include "core/io/preset_io.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// A row of either table, ready to be drawn. Vectors have three components.
struct Line {
  std::string_view symbol, quantity, storhet, unit, equation, help;
  std::string key;  ///< as --set names it
  double min, max;
  Scale scale;
  Effect effect;
  bool zero_is_off, integer = false;
  std::string_view otherwise = {};  ///< whose value it has while it is absent
  double other_value = none;
  std::string replaced_by = {};  ///< the constants that act in its place, where it has no effect
  int components = 1;
  double value[3]{}, saved[3]{none, none, none}, standard[3]{};
  std::function<void(const double* value, unsigned gesture)> set;
  std::function<Difference(double value)> differing;  ///< of a copy, where there can be one; of one component alone
};

template <class T>
Line describe(const Row<T>& row) {
  return {.symbol = row.symbol,
          .quantity = row.quantity,
          .storhet = row.storhet,
          .unit = row.unit,
          .equation = row.equation,
          .help = row.help,
          .key = std::string(row.key),
          .min = row.min,
          .max = row.max,
          .scale = row.scale,
          .effect = row.effect,
          .zero_is_off = row.zero_is_off,
          .otherwise = row.otherwise,
          .set = {},
          .differing = {}};
}

template <class T>
void read(const FieldOf<T>& field, const T& from, double* out) {
  if (const auto* number = std::get_if<double T::*>(&field)) out[0] = from.**number;
  if (const auto* integer = std::get_if<int T::*>(&field)) out[0] = from.**integer;
  if (const auto* vector = std::get_if<glm::dvec3 T::*>(&field))
    for (int k = 0; k < 3; ++k) out[k] = (from.**vector)[k];
}

template <class T>
void write(const FieldOf<T>& field, T& to, const double* value) {
  if (const auto* number = std::get_if<double T::*>(&field)) to.** number = value[0];
  if (const auto* integer = std::get_if<int T::*>(&field)) to.** integer = int(std::lround(value[0]));
  if (const auto* vector = std::get_if<glm::dvec3 T::*>(&field)) to.** vector = {value[0], value[1], value[2]};
}

template <class T>
void classify(const FieldOf<T>& field, Line& line) {
  line.integer = std::holds_alternative<int T::*>(field);
  line.components = std::holds_alternative<glm::dvec3 T::*>(field) ? 3 : 1;
}

bool is_absent(const Line& line, double value) {
  return !line.otherwise.empty() && value == left_out;
}
/// What the constant comes to.
double effective(const Line& line, double value) {
  return is_absent(line, value) ? line.other_value : value;
}

/// The slider spans what lies round the preset's value, and whatever the value has been since it was last that.
SliderScale scale_of(Ui& ui, const Line& line, int k) {
  PresetRow limits{};
  limits.field = &Preset::offset;
  limits.min = line.min, limits.max = line.max, limits.scale = line.scale;
  const double value = effective(line, line.value[k]), saved = effective(line, line.saved[k]);
  double center = std::isnan(saved) ? value : saved;
  if (line.components == 3)
    for (double v : {line.saved[0], line.saved[1], line.saved[2]})
      if (std::abs(v) > std::abs(center)) center = v;
  SliderScale scale = slider_scale(limits, center);
  scale.integer = line.integer;
  if (std::isnan(line.saved[k])) return scale;  // it has no preset to go back to
  auto& reaches = ui.slider.reaches;
  const std::string name = line.key + "." + std::to_string(k);
  auto known = reaches.find(name);
  if (known != reaches.end() && (known->second.preset != saved || value == saved))
    reaches.erase(known), known = reaches.end();
  if (known == reaches.end()) {
    const SliderScale needed = grown(scale, limits, value);
    if (needed.min == scale.min && needed.max == scale.max && needed.low == scale.low) return scale;
    known = reaches.emplace(name, SliderReach{saved, value, value}).first;
  }
  SliderReach& reach = known->second;
  reach.least = std::min(reach.least, value), reach.most = std::max(reach.most, value);
  return grown(grown(scale, limits, reach.least), limits, reach.most);
}

std::string value_text(const Line& line, double value) {
  if (is_absent(line, value)) return "as " + std::string(line.otherwise);
  return line.zero_is_off && value == 0 ? std::string("off") : short_number(value);
}

std::string all_values(const Line& line, const double* values) {
  std::string text;
  for (int k = 0; k < line.components; ++k) text += (k > 0 ? "  " : "") + value_text(line, values[k]);
  return text;
}

/// `now`: what the value is instead.
bool in_range(Ui& ui, const Line& line, double value, double now) {
  if (value >= line.min && value <= line.max && (!line.integer || value == std::round(value))) return true;
  ui.refuse_number(std::string(line.symbol) + " ranges from " + power_number(line.min) + " to " +
                   quantity(line.max, line.unit) + (line.integer ? " in whole numbers" : "") + "; it stays at " +
                   quantity(now, line.unit) + ".");
  return false;
}

void take(Ui& ui, const Line& line, int k, const SliderResult& result, unsigned gesture) {
  // A change that builds the cloth again waits for the end of the drag.
  const bool due = line.effect == Effect::rebuild ? result.finished : result.changed;
  double next[3] = {line.value[0], line.value[1], line.value[2]};
  if (result.reset && !std::isnan(line.saved[k])) {
    next[k] = line.saved[k];
  } else if (!due || result.value == effective(line, line.value[k])) {
    return;
  } else if (!in_range(ui, line, result.value, effective(line, line.value[k]))) {
    if (result.typed != 0) type_again(ui.slider, result.typed);
    return;
  } else {
    next[k] = result.value;
  }
  line.set(next, gesture);
}

void row_tooltip(Ui& ui, const Line& line) {
  const Tokens& c = ui.theme.colors;
  begin_tooltip(ui);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = symbol_width(ui.fonts, line.symbol) + ui.theme.px(10);
  draw_symbol(*ImGui::GetWindowDrawList(), ui.fonts, {at.x, at.y + ui.fonts.title->Ascent}, line.symbol, c.text);
  ImGui::Dummy({width, ui.fonts.title->FontSize});
  ImGui::SameLine(0, 0);
  ImGui::PushFont(ui.fonts.title);
  wrapped(ui, std::string(line.quantity) + " · " + std::string(line.storhet), c.text);
  ImGui::PopFont();
  wrapped(ui, line.help, c.text);
  std::string facts = power_number(line.min) + " to " + quantity(line.max, line.unit);
  if (line.zero_is_off) facts += ", 0 is off";
  if (!line.otherwise.empty()) facts += ", or absent: as " + std::string(line.otherwise);
  if (!line.equation.empty()) facts += " · " + equation_of_report(line.equation);
  wrapped(ui, facts, c.quiet);
  if (!line.replaced_by.empty()) wrapped(ui, "It has no effect while " + line.replaced_by + " are set.", c.warning);
  if (const auto& limits = ui.session.studies.stability.limits())
    if (const std::string words = zone_words(*limits, line.key, line.unit); !words.empty()) wrapped(ui, words, c.text);
  if (line.effect == Effect::start)
    wrapped(ui, ui.input.by_touch ? "Takes effect at the next restart." : "Takes effect at the next restart (R).",
            c.warning);
  ImGui::PushFont(ui.fonts.small);
  const bool vector = line.components == 3;
  if (ui.input.by_touch)
    wrapped(ui,
            vector ? "Drag a number sideways, or tap it to type." : "Drag along the slider, or tap the number to type.",
            c.quiet);
  else
    wrapped(ui,
            vector ? "Drag a number sideways, double-click to type, right-click for more."
                   : "Drag (Shift: finer) or use the arrow keys. Double-click the number to type, the "
                     "slider to reset. Right-click for more.",
            c.quiet);
  ImGui::PopFont();
  end_tooltip(ui);
}

/// "Add a copy with k_s = …": half, double, or what is typed.
void copy_items(Ui& ui, const Line& line) {
  if (!line.differing || line.components != 1 || line.effect == Effect::rebuild || line.effect == Effect::start ||
      line.effect == Effect::view)
    return;
  const auto add = [&](double value) { ui.session.request(request::AddCopy{{line.differing(rounded(value, 6))}}); };
  ImGui::Separator();
  const double now = effective(line, line.value[0]);
  for (const double factor : {0.5, 2.0}) {
    const double value = line.integer ? std::round(factor * now) : factor * now;
    if (value == now || value < line.min || value > line.max) continue;
    if (ImGui::MenuItem(("Add a copy with " + line.key + " = " + quantity(value, line.unit)).c_str())) add(value);
    report_control(ui, factor < 1 ? "copy_half" : "copy_double");
  }
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(("Add a copy with " + line.key + " =").c_str());
  ImGui::SameLine();
  ImGui::SetNextItemWidth(ui.theme.px(88));
  char typed[40] = "";
  if (ImGui::InputText("##copy", typed, sizeof typed, ImGuiInputTextFlags_EnterReturnsTrue)) {
    if (const auto value = typed_number(typed, line.unit); value && in_range(ui, line, *value, now)) add(*value);
    if (*typed != 0 && !typed_number(typed, line.unit))
      ui.session.messages.error(std::string("“") + typed + "” is not a number, so no copy was added.");
    ImGui::CloseCurrentPopup();
  }
  report_control(ui, "copy_value");
}

void row_menu(Ui& ui, const Line& line, ImVec2 lo, ImVec2 hi) {
  if (ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(lo, hi) && ImGui::IsMouseClicked(ImGuiMouseButton_Right))
    ImGui::OpenPopup("row menu");
  if (!begin_menu(ui, "row menu")) return;
  if (!std::isnan(line.saved[0]) &&
      ImGui::MenuItem(("Reset to the preset's " + all_values(line, line.saved)).c_str(), "double-click"))
    line.set(line.saved, 0);
  if (ImGui::MenuItem(("Set to the default " + all_values(line, line.standard)).c_str())) line.set(line.standard, 0);
  copy_items(ui, line);
  end_menu();
}

/// Numbers of the lattice are known by their words; as symbols they would be taken for physical quantities.
bool known_by_words(std::string_view key) {
  return key == "rows" || key == "columns";
}

/// What a row's label takes, px: one that is longer than the column of symbols pushes its control to the right.
float label_room(const Ui& ui, std::string_view label) {
  return std::max(row_columns(ui).symbol, std::ceil(text_width(*ui.fonts.small, label)) + ui.theme.px(8));
}

/// The symbol; a double click on it resets, and a dot before it says that the value differs from the preset's.
void symbol_cell(Ui& ui, const Line& line, const RowColumns& columns) {
  const Tokens& c = ui.theme.colors;
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  gui::press_area("symbol", {columns.symbol, columns.height});
  if (ImGui::IsItemActive() && ui.input.double_click && !std::isnan(line.saved[0])) line.set(line.saved, 0);
  bool changed = false;
  for (int k = 0; k < line.components; ++k) changed |= !std::isnan(line.saved[k]) && line.saved[k] != line.value[k];
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float middle = lo.y + columns.height / 2;
  if (changed) draw.AddCircleFilled({lo.x - ui.theme.px(7), std::round(middle)}, ui.theme.px(2.5f), c.warning, 12);
  const ImVec2 at{lo.x + ui.theme.px(1), baseline_at(ui.fonts, middle)};  // italic letters begin left of their place
  if (known_by_words(line.key))
    draw_on_baseline(draw, *ui.fonts.small, at, c.text, line.key);
  else
    draw_symbol(draw, ui.fonts, at, line.symbol, line.replaced_by.empty() ? c.text : c.quiet);
}

/// The palette asked for this constant: its slider, which is drawn next, takes the focus.
void take_wanted_focus(Ui& ui, const std::string& key) {
  SliderState& state = ui.slider;
  if (state.wanted_key != key) return;
  state.wanted_key.clear();
  state.wanted_order = state.order;
}

void vector_cells(Ui& ui, const Line& line, const RowColumns& columns, float slider_width) {
  const float width = slider_width + columns.gap + columns.value;
  const float cell = std::floor((width - 2 * ui.theme.px(4)) / 3);
  const char* names[3] = {"x", "y", "z"};
  take_wanted_focus(ui, line.key);
  for (int k = 0; k < 3; ++k) {
    if (k > 0) ImGui::SameLine(0, ui.theme.px(4));
    const SliderResult result = drag_cell(ui, names[k], scale_of(ui, line, k), line.value[k], cell, columns.height,
                                          std::string(line.symbol) + "_" + names[k], line.unit);
    if (ui.controls) report_control(ui, line.key + "." + names[k]);
    take(ui, line, k, result, ImGui::GetID(names[k]));
  }
}

void draw_line(Ui& ui, const Line& line) {
  RowColumns columns = row_columns(ui);
  if (known_by_words(line.key)) columns.symbol = label_room(ui, "columns");  // both, so that their sliders line up
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const float width = ui.row_width;
  const float slider_width = width - columns.symbol - columns.value - columns.unit - 2 * columns.gap;
  come_into_sight(ui, line.key, columns.height);
  ImGui::BeginGroup();
  symbol_cell(ui, line, columns);
  ImGui::SameLine(0, 0);
  if (line.components == 3) {
    vector_cells(ui, line, columns, slider_width);
  } else {
    const unsigned gesture = ImGui::GetID("slider");
    take_wanted_focus(ui, line.key);
    const SliderScale scale = scale_of(ui, line, 0);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const double value = effective(line, line.value[0]);
    const SliderResult slid = slider(ui, scale, value, slider_width, columns.height);
    draw_zones(ui, line.key, scale, at, {at.x + slider_width, at.y + columns.height});
    if (ui.controls) report_control(ui, line.key + ".slider");
    take(ui, line, 0, slid, gesture);
    ImGui::SameLine(0, columns.gap);
    const bool dragging = ui.slider.dragged == gesture;
    const double shown = dragging ? ui.slider.value : line.value[0];
    take(ui, line, 0,
         value_cell(ui, "value", value, value_text(line, shown), columns.value, columns.height, line.symbol, line.unit),
         0);
    if (ui.controls) report_control(ui, line.key + ".value");
  }
  draw_on_baseline(*ImGui::GetWindowDrawList(), *ui.fonts.small,
                   {lo.x + width - columns.unit + ui.theme.px(2), baseline_at(ui.fonts, lo.y + columns.height / 2)},
                   ui.theme.colors.quiet, line.unit);
  ImGui::EndGroup();
  if (tooltip_due(ui, ImGui::GetID("row"))) row_tooltip(ui, line);
  row_menu(ui, line, lo, {lo.x + width, lo.y + columns.height});
}

}  // namespace

RowColumns row_columns(const Ui& ui) {
  constexpr float narrow_at_1 = 240;  // rows under which the sliders are to keep most of the width
  if (ui.row_width < ui.theme.px(narrow_at_1))
    return {ui.theme.px(26), ui.theme.px(40), ui.theme.px(56), ui.theme.px(36), ui.theme.px(4)};
  return {ui.theme.px(26), ui.theme.px(56), ui.theme.px(64), ui.theme.px(44), ui.theme.px(4)};
}

void come_into_sight(Ui& ui, std::string_view key, float height) {
  SliderState& state = ui.slider;
  if (state.shown_key != key) return;
  state.shown_key.clear();
  const float above = ImGui::GetCursorPosY() - state.rows_scroll;
  if (above < 0 || above + 2 * height > ImGui::GetWindowHeight()) ImGui::SetScrollHereY(0.35f);
}

void constant_row(Ui& ui, const PresetRow& row) {
  Line line = describe(row);
  classify(row.field, line);
  const bool counts = row.key == "rows" || row.key == "columns";
  const auto question = counts ? resolution_question(ui) : std::nullopt;
  read(row.field, question ? question->more : ui.session.requested_preset(), line.value);
  read(row.field, ui.session.document.saved, line.saved);
  read(row.field, Preset{}, line.standard);
  if (const PresetRow* other = line.otherwise.empty() ? nullptr : find_row(line.otherwise))
    read(other->field, ui.session.requested_preset(), &line.other_value);
  line.replaced_by = replaced_by(row, ui.session.requested_preset());
  line.set = [&](const double* value, unsigned gesture) {
    Preset next = question ? question->more : ui.session.requested_preset();
    write(row.field, next, value);
    counts ? ask_resolution(ui, next) : ui.session.propose(std::move(next), gesture);
  };
  line.differing = [&row](double value) { return Difference(row, value); };
  ImGui::PushID(row.key.data(), row.key.data() + row.key.size());
  draw_line(ui, line);
  ImGui::PopID();
}

void word_row(Ui& ui, const char* key, const char* label, std::string Preset::*field,
              std::span<const std::string_view> names, std::span<const char* const> titles, const char* tip) {
  assert(names.size() == titles.size());
  come_into_sight(ui, key, row_columns(ui).height);
  labeled_row(ui, label, [&](float width) {
    const std::string now = ui.session.requested_preset().*field;
    const int chosen = int(std::find(names.begin(), names.end(), now) - names.begin());
    if (const int k = segments(ui, key, titles.data(), int(titles.size()), chosen, 11, width); k >= 0 && k != chosen) {
      Preset next = ui.session.requested_preset();
      next.*field = names[std::size_t(k)];
      ui.session.propose(std::move(next));
    }
    tooltip(ui, gui::item_id(), tip);
  });
}

void fabric_quantity_row(Ui& ui, const FabricQuantity& quantity) {
  Line line{.symbol = quantity.symbol,
            .quantity = quantity.name,
            .storhet = quantity.namn,
            .unit = quantity.unit,
            .equation = {},
            .help = quantity.help,
            .key = "fabric." + std::string(quantity.key),
            .min = quantity.min,
            .max = quantity.max,
            .scale = Scale::logarithmic,
            .effect = Effect::force,
            .zero_is_off = false,
            .set = {},
            .differing = {}};
  line.value[0] = quantity.of(ui.session.requested_preset());
  line.saved[0] = quantity.of(ui.session.document.saved);
  line.standard[0] = quantity.of(Preset{});
  line.set = [&ui, &quantity](const double* value, unsigned gesture) {
    Preset next = ui.session.requested_preset();
    FabricValues values(fabric_quantities().size());
    values[std::size_t(&quantity - fabric_quantities().data())] = value[0];
    if (const auto problem = set_fabric(next, values))
      return ui.refuse_number(std::string(problem->quantity->symbol) + " " + problem->why + ".");
    if (const std::string problem = check_preset(next); !problem.empty())
      return ui.refuse_number(sentence(problem) + ".");
    ui.session.propose(std::move(next), gesture);
  };
  ImGui::PushID(line.key.c_str());
  draw_line(ui, line);
  ImGui::PopID();
}

void body_row(Ui& ui, const BodyRow& row, int index) {
  Line line = describe(row);
  line.key = "bodies[" + std::to_string(index) + "]." + line.key;
  classify(row.field, line);
  read(row.field, ui.session.requested_preset().bodies[index], line.value);
  if (std::size_t(index) < ui.session.document.saved.bodies.size() &&
      ui.session.document.saved.bodies[index].shape == ui.session.requested_preset().bodies[index].shape)
    read(row.field, ui.session.document.saved.bodies[index], line.saved);
  read(row.field, Body{}, line.standard);
  line.set = [&ui, &row, index](const double* value, unsigned gesture) {
    Preset next = ui.session.requested_preset();
    write(row.field, next.bodies[index], value);
    ui.session.propose(std::move(next), gesture);
  };
  line.differing = [&row, index](double value) { return Difference(std::size_t(index), row, value); };
  ImGui::PushID(row.key.data(), row.key.data() + row.key.size());
  draw_line(ui, line);
  ImGui::PopID();
}

void labeled_row(Ui& ui, const char* label, const std::function<void(float)>& content) {
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const float width = ui.row_width, before = label_room(ui, label);
  draw_on_baseline(*ImGui::GetWindowDrawList(), *ui.fonts.small, {lo.x, baseline_at(ui.fonts, lo.y + ui.theme.px(15))},
                   ui.theme.colors.quiet, label);
  ImGui::SetCursorScreenPos({lo.x + before, lo.y});
  content(width - before);
  // A control that is drawn last on the line ends it; whatever its height, the next row keeps clear of it.
  const float bottom = std::max(ImGui::GetItemRectMax().y, lo.y + ui.theme.px(30));
  ImGui::SetCursorScreenPos({lo.x, bottom + ui.theme.px(4)});
}

std::string equation_of_report(std::string_view equation) {
  return "equation (" + std::string(equation) + ") of the report “Simulering av tyg” (2012)";
}

}  // namespace tyglab
