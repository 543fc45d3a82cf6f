// The constants at the left, in the order of the report, and the picked particle below them.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <utility>
#include <vector>

#include "app/base/text.h"
#include "app/ui/constants/constants_panel.h"
#include "app/ui/kit/chart.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"
#include "core/forces/contact.h"
#include "core/integrators/scheme.h"
#include "core/model/fabric.h"
#include "core/model/notation.h"
#include "core/model/words.h"
#include "core/theory/advice.h"

namespace tyglab {
namespace {

std::vector<const PresetRow*> rows_of(const Heading& wanted) {
  std::vector<const PresetRow*> rows;
  for (std::string_view key : wanted.keys)
    if (const PresetRow* row = find_row(key)) rows.push_back(row);
  for (const PresetRow& row : notation()) {
    const bool listed = std::any_of(headings().begin(), headings().end(), [&](const Heading& s) {
      return std::find(s.keys.begin(), s.keys.end(), row.key) != s.keys.end();
    });
    if (!listed && !row.section.empty() && row.section == wanted.block) rows.push_back(&row);
  }
  return rows;
}

std::string order_text(const Scheme& scheme) {
  char text[64];
  if (scheme.order_damped == scheme.order_undamped) {
    std::snprintf(text, sizeof text, "order %d", scheme.order_undamped);
  } else {
    std::snprintf(text, sizeof text, "order %d with damping, %d without", scheme.order_damped, scheme.order_undamped);
  }
  return text;
}

/// The line of a method's curves, as a sample beside its name.
void draw_sample(const Theme& theme, ImDrawList& draw, float left, float middle, const Scheme& scheme) {
  CurveStyle style = integrator_style(theme.colors, scheme.name);
  style.width = 3;
  const ImVec2 ends[] = {{left, std::round(middle)}, {left + theme.px(24), std::round(middle)}};
  draw_styled_line(draw, ends, 2, style, theme.scale);
}

enum class MethodGroup { report, explicit_, implicit, games };
constexpr std::array<const char*, 4> method_groups{"IN THE REPORT", "EXPLICIT", "IMPLICIT", "AS IN GAMES"};

MethodGroup group_of(const Scheme& scheme) {
  static constexpr std::array<std::string_view, 3> report{"euler", "improved_euler", "verlet"};
  if (std::find(report.begin(), report.end(), scheme.name) != report.end()) return MethodGroup::report;
  if (projects(scheme) || counts_passes(scheme)) return MethodGroup::games;
  return is_implicit(scheme) || solves_damping(scheme) ? MethodGroup::implicit : MethodGroup::explicit_;
}

/// By groups, in each in the order of the table.
std::vector<const Scheme*> grouped_methods() {
  std::vector<const Scheme*> list;
  for (const Scheme& scheme : schemes()) list.push_back(&scheme);
  std::stable_sort(list.begin(), list.end(),
                   [](const Scheme* a, const Scheme* b) { return group_of(*a) < group_of(*b); });
  return list;
}

std::string order_digits(const Scheme& scheme) {
  const std::string damped = std::to_string(scheme.order_damped), undamped = std::to_string(scheme.order_undamped);
  return damped == undamped ? damped : damped + " or " + undamped;
}

/// The largest dt that is stable in any shape with these constants.
std::string limit_words(const Scheme& scheme, const Preset& preset) {
  if (chooses_steps(scheme)) return "own steps";
  if (!has_step_limit(scheme)) return "none";
  const double limit = stable_dt(preset, std::string(scheme.name));
  return limit == 0 ? "unstable" : std::isinf(limit) ? "none" : quantity(limit, "s", 2);
}

/// What the list says at the right of each method: worked out when it is opened, since that takes milliseconds.
const std::vector<std::string>& limits_of_methods(Ui& ui, const std::vector<const Scheme*>& list) {
  if (ImGui::IsWindowAppearing() || ui.methods.limits.size() != list.size()) {
    ui.methods.limits.clear();
    for (const Scheme* scheme : list) ui.methods.limits.push_back(limit_words(*scheme, ui.session.requested_preset()));
  }
  return ui.methods.limits;
}

void choose_method(Ui& ui, const Scheme& choice) {
  if (choice.name == ui.session.requested_preset().integrator) return;
  Preset next = ui.session.requested_preset();
  next.integrator = choice.name;
  ui.session.propose(std::move(next));
}

/// All methods in groups, with their order and their limit of dt in columns; arrow keys and Enter choose too.
void method_list(Ui& ui, const Scheme& now) {
  const Tokens& c = ui.theme.colors;
  const ImFont& small = *ui.fonts.small;
  const std::vector<const Scheme*> list = grouped_methods();
  const std::vector<std::string>& limits = limits_of_methods(ui, list);
  MethodList& methods = ui.methods;
  if (ImGui::IsWindowAppearing())
    methods.selected = int(std::find(list.begin(), list.end(), &now) - list.begin()), methods.go = 0;
  const bool moved = methods.go != 0;
  methods.selected = std::clamp(methods.selected + std::exchange(methods.go, 0), 0, int(list.size()) - 1);
  float titles = 0, last = text_width(small, "dt at most");
  for (std::size_t k = 0; k < list.size(); ++k)
    titles = std::max(titles, text_width(*ui.fonts.text, list[k]->title)),
    last = std::max(last, text_width(small, limits[k]));
  const float sample = ui.theme.px(34), gap = ui.theme.px(16),
              order_end = sample + titles + gap + text_width(small, "2 or 4");
  const float width = std::max(order_end + gap + last, ImGui::GetContentRegionAvail().x);
  const auto columns = [&](ImVec2 lo, float height, ImU32 color, const std::string& order, const std::string& limit) {
    const float baseline = baseline_at(ui.fonts, lo.y + height / 2);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw_on_baseline(draw, small, {lo.x + width - last - gap - text_width(small, order), baseline}, color, order);
    draw_on_baseline(draw, small, {lo.x + width - text_width(small, limit), baseline}, color, limit);
  };
  for (std::size_t k = 0; k < list.size(); ++k) {
    const Scheme& choice = *list[k];
    if (k == 0 || group_of(choice) != group_of(*list[k - 1])) {
      const ImVec2 lo = ImGui::GetCursorScreenPos();
      menu_heading(ui, method_groups[std::size_t(group_of(choice))]);
      if (k == 0) columns({lo.x, lo.y + ui.theme.px(4)}, small.FontSize, c.quiet, "order", "dt at most");
    }
    const ImVec2 lo = ImGui::GetCursorScreenPos();
    const float height = ImGui::GetTextLineHeight();
    ImGui::PushID(int(k));
    if (ImGui::Selectable("##method", int(k) == methods.selected, 0, {width, height})) choose_method(ui, choice);
    report_control(ui, choice.name);
    if (moved && int(k) == methods.selected) ImGui::SetScrollHereY(0.5f);
    tooltip(ui, gui::item_id(), sentence(order_text(choice)) + " " + std::string(choice.note), choice.source);
    ImGui::PopID();
    draw_sample(ui.theme, *ImGui::GetWindowDrawList(), lo.x + ui.theme.px(2), lo.y + height / 2, choice);
    draw_on_baseline(*ImGui::GetWindowDrawList(), *ui.fonts.text,
                     {lo.x + sample, baseline_at(ui.fonts, lo.y + height / 2)}, c.text, choice.title);
    columns(lo, height, choice.name == now.name ? c.text : c.quiet, order_digits(choice), limits[k]);
  }
  more_below(ui);
  if (!std::exchange(methods.enter, false)) return;
  choose_method(ui, *list[std::size_t(methods.selected)]);
  ImGui::CloseCurrentPopup();
}

std::string pins_text(const Pins& pins) {
  static const std::map<Pins::Mode, std::string> names{{Pins::Mode::none, "none"},
                                                       {Pins::Mode::top_row, "top row"},
                                                       {Pins::Mode::top_corners, "top corners"},
                                                       {Pins::Mode::four_corners, "four corners"},
                                                       {Pins::Mode::left_column, "left column"},
                                                       {Pins::Mode::boundary, "boundary"}};
  const auto it = names.find(pins.mode);
  return it != names.end() ? it->second : "custom list (" + std::to_string(pins.list.size()) + ")";
}

void pins_row(Ui& ui) {
  labeled_row(ui, "pins", [&](float width) {
    const Pins& pins = ui.session.requested_preset().pins;
    const bool open = begin_combo(ui, "##pins", pins_text(pins).c_str(), width);
    if (!open) {
      tooltip(ui, gui::item_id(), "Particles that forces do not move.",
              "Right double-click a particle to pin or unpin it");
      return;
    }
    for (Pins::Mode mode : {Pins::Mode::none, Pins::Mode::top_row, Pins::Mode::top_corners, Pins::Mode::four_corners,
                            Pins::Mode::left_column, Pins::Mode::boundary}) {
      if (!ImGui::Selectable(pins_text({mode, {}}).c_str(), pins.mode == mode) || pins.mode == mode) continue;
      Preset next = ui.session.requested_preset();
      next.pins.mode = mode, next.pins.list.clear();
      ui.session.propose(std::move(next));
    }
    end_combo();
  });
  if (const std::size_t motions = ui.session.requested_preset().pins.motions.size(); motions > 0)
    labeled_row(ui, "pins move", [&](float) {
      ImGui::TextUnformatted((std::to_string(motions) + (motions == 1 ? " motion" : " motions")).c_str());
      tooltip(ui, gui::item_id(), "Paths and turns of pins, from pin_motions in the preset's file.");
    });
}

std::string fabric_words(const Fabric& fabric, double g) {
  return std::string(fabric.measured ? "Measured" : "Estimated") + ": " + quantity(1e3 * fabric.mass, "g/m²", 3) +
         ", B " + quantity(1e6 * fabric.B, "µN·m", 3) + ", warp and weft " + short_number(fabric.warp, 3) + " and " +
         quantity(fabric.weft, "N/m", 3) + ", shear " + quantity(fabric.shear, "N/m", 3) + "; drapes over lengths of " +
         quantity(1e3 * drape_length(fabric.B, fabric.mass, g), "mm", 2) + ".";
}

/// The choice of a fabric, and what the present constants come to in the units in which fabrics are sold and measured.
void fabric_row(Ui& ui) {
  const Preset& now = ui.session.requested_preset();
  const auto chosen =
      std::find_if(fabrics().begin(), fabrics().end(), [&](const Fabric& fabric) { return is_fabric(now, fabric); });
  labeled_row(ui, "fabric", [&](float width) {
    const std::string shown(chosen == fabrics().end() ? "choose" : chosen->name);
    if (!begin_combo(ui, "##fabric", shown.c_str(), width)) {
      tooltip(ui, gui::item_id(),
              chosen == fabrics().end()
                  ? "Sets m, B, k_warp, k_weft and k_shear to those of a fabric; bending springs off."
                  : fabric_words(*chosen, now.g),
              std::string(chosen == fabrics().end() ? "" : chosen->source));
      return;
    }
    for (const Fabric& fabric : fabrics()) {
      const bool selected = ImGui::Selectable(std::string(fabric.name).c_str(), is_fabric(now, fabric));
      report_control(ui, fabric.key);
      tooltip(ui, gui::item_id(), fabric_words(fabric, now.g), std::string(fabric.source));
      if (selected) ui.session.propose(with_fabric(now, fabric));
    }
    end_combo();
  });
  const double mass = now.m / (now.L * now.L), drape = drape_length(now.B, mass, now.g);
  std::string words = quantity(1e3 * mass, "g/m²", 3) + " · B " + quantity(1e6 * now.B, "µN·m", 3);
  if (std::isfinite(drape) && drape > 0) words += " · drape " + quantity(1e3 * drape, "mm", 2);
  bool* shown = ImGui::GetStateStorage()->GetBoolRef(ImGui::GetID("fabric_units"), false);
  labeled_row(ui, "units", [&](float width) {
    const float side = ui.theme.px(30);
    const ImVec2 lo = ImGui::GetCursorScreenPos();
    ImGui::SetCursorScreenPos({lo.x + width - side, lo.y});
    if (quiet_button(ui, "fabric_units", *shown ? icon::down : icon::left, *shown ? "hide" : "edit",
                     *shown ? "Hide the fabric's quantities" : "Change the fabric in these units"))
      *shown = !*shown;
    ImGui::SetCursorScreenPos(lo);
    width -= side;
    draw_on_baseline(
        *ImGui::GetWindowDrawList(), *ui.fonts.small,
        {ImGui::GetCursorScreenPos().x, baseline_at(ui.fonts, ImGui::GetCursorScreenPos().y + ui.theme.px(15))},
        ui.theme.colors.text, fitted(*ui.fonts.small, words, width));
    ImGui::Dummy({width, ui.theme.px(30)});
    tooltip(
        ui, gui::item_id(),
        "Mass per area m/L², bending rigidity, and the drape length (B/ρg)^(1/3) over which the cloth bends by its own "
        "weight. A spacing L well below it shows folds as they are; a finer cloth keeps all three.");
  });
  if (!*shown) return;
  for (const FabricQuantity& quantity : fabric_quantities()) fabric_quantity_row(ui, quantity);
}

/// How long a step may take. A lab's result must not depend on that.
void step_limit_row(Ui& ui) {
  const Preset& preset = ui.session.requested_preset();
  const bool can = preset.kind == Kind::cloth && preset.engine != EngineKind::opencl;
  if (!can || !can_end_early(scheme(preset.integrator)) || ui.session.labs.run) return;
  static constexpr std::array limits{0, 5, 10, 20, 50, 100, 200};  // ms
  const auto words = [](double ms) { return ms > 0 ? short_number(ms) + " ms per step" : std::string("unlimited"); };
  double& limit = ui.session.step_limit;
  labeled_row(ui, "time", [&](float width) {
    const bool open = begin_combo(ui, "##step_limit", words(1000 * limit).c_str(), width);
    if (!open) {
      tooltip(ui, gui::item_id(),
              "Longest real time of a step. At this limit a step keeps its current result, and a message reports the "
              "residual. The motion then depends on the machine, so presets do not store the limit, and the cards that "
              "measure the method ignore it.");
      return;
    }
    for (const int ms : limits) {
      if (ImGui::Selectable(words(ms).c_str(), limit == ms / 1000.0)) limit = ms / 1000.0;
      report_control(ui, "limit_" + std::to_string(ms));
    }
    end_combo();
  });
}

void rows(Ui& ui, const Heading& wanted) {
  for (const PresetRow* row : rows_of(wanted))
    if (applies(*row, ui.session.requested_preset())) constant_row(ui, *row);
}

bool empty(const Heading& wanted, const Preset& preset) {
  for (const PresetRow* row : rows_of(wanted))
    if (applies(*row, preset)) return false;
  return true;
}

}  // namespace

void integrator_row(Ui& ui) {
  const Tokens& c = ui.theme.colors;
  const Scheme& now = scheme(ui.session.requested_preset().integrator);
  const float width = ui.row_width;
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const std::string room = "           ", label = room + std::string(now.title);
  ImGui::SetNextWindowSizeConstraints({0, 0}, {1e9f, ImGui::GetIO().DisplaySize.y - ui.theme.px(24)});
  const bool open = begin_combo(ui, "##integrator", label.c_str(), width);
  ui.methods.open = open;
  const float middle = lo.y + ImGui::GetItemRectSize().y / 2;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (!open) {
    draw_sample(ui.theme, draw, lo.x + ui.theme.px(10), middle, now);
    const std::string order = order_text(now);
    const float x = lo.x + width - ui.theme.px(34) - text_width(*ui.fonts.small, order);
    if (x > lo.x + text_width(*ui.fonts.text, label) + ui.theme.px(16))
      draw_text(draw, *ui.fonts.small, {x, middle - ui.fonts.small->FontSize / 2}, c.quiet, order);
    tooltip(ui, gui::item_id(), sentence(order_text(now)) + " " + std::string(now.note), now.source);
    return;
  }
  method_list(ui, now);
  end_combo();
}

bool applies(const PresetRow& row, const Preset& preset) {
  if (std::holds_alternative<std::string Preset::*>(row.field) || row.section == "view") return false;
  if (row.key == "tolerance") return chooses_steps(scheme(preset.integrator));
  if (row.key == "iterations") return iterates(scheme(preset.integrator));
  if ((row.key == "thickness" || row.key == "friction") && preset.self == "off") return false;
  if (row.key == "gust_period" && !gusts(preset)) return false;
  if ((row.key == "u" || row.key == "C_N" || row.key == "C_T") && preset.air_density == 0) return false;
  if ((row.key == "kappa_warp" || row.key == "kappa_weft") && preset.B == 0) return false;
  return !row.only_one_kind || row.only == preset.kind;
}

bool is_word_row(const PresetRow& row, const Preset& preset) {
  return preset.kind == Kind::cloth && (row.key == "self" || row.key == "tearing.mode");
}

void show_constant(Ui& ui, std::string_view key) {
  ui.panels = ui.settings.layout.left = true, ui.side = Side::constants;
  ui.slider.wanted_key = key;
  bring_into_sight(ui, key);
}

void bring_into_sight(Ui& ui, std::string_view key) {
  ui.slider.shown_key = key;
  if (key == "contact") ui.settings.layout.folded.erase("Bodies");
  if (key == "self") ui.settings.layout.folded.erase("Self-contact");
  if (key == "tearing.mode") ui.settings.layout.folded.erase("Tearing");
  for (const Heading& wanted : headings()) {
    const auto list = rows_of(wanted);
    if (std::none_of(list.begin(), list.end(), [&](const PresetRow* row) { return row->key == key; })) continue;
    ui.settings.layout.folded.erase(wanted.name);
    if (std::string_view(wanted.name) == "Cloth") ui.settings.layout.folded.erase("Weight");
  }
}

void constants_sections(Ui& ui) {
  const bool cloth = ui.session.requested_preset().kind == Kind::cloth;
  for (const Heading& wanted : headings()) {
    const std::string_view name = wanted.name;
    const bool has_own_row = cloth && name == "Self-contact";
    if (!has_own_row && empty(wanted, ui.session.requested_preset())) continue;
    if (name == "Cloth" && (cloth || !ui.session.requested_preset().bodies.empty())) body_sections(ui);
    if (!section(ui, name == "Cloth" && !cloth ? "Weight" : wanted.name)) continue;
    if (name == "Integrator") integrator_row(ui);
    if (name == "Fabric") fabric_row(ui);
    if (has_own_row)
      word_row(ui, "self", "layers", &Preset::self, self_names, self_titles,
               "Layers of the cloth pass through each other, repel each other when they are near, or are also kept "
               "apart by a bound of each step's motion.");
    if (name == "Tearing" && cloth)
      word_row(
          ui, "tearing.mode", "overload", &Preset::tearing, tearing_names, tearing_titles,
          "A spring pulled harder than F_max breaks, and triangles vanish with it (the report's rule), or particles "
          "part: the cloth opens between its cells and loses none.");
    rows(ui, wanted);
    if (name == "Integrator") step_limit_row(ui), stability_row(ui);
    if (name == "Cloth" && cloth) resolution_row(ui), pins_row(ui);
  }
}

/// Height of the sections of the integrator and the springs: less is too little of the list.
float least_list(const Ui& ui) {
  return ui.theme.px(250);
}

/// What goes on below the lower edge of the list fades out there instead of being cut through.
void fade_lower_edge(Ui& ui) {
  if (ImGui::GetScrollY() >= ImGui::GetScrollMaxY() - 1) return;
  const ImVec2 lo = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  const ImVec2 hi{lo.x + size.x - ImGui::GetStyle().ScrollbarSize, lo.y + size.y};
  const ImU32 solid = ui.theme.colors.panel, clear = faded(solid, 0);
  const float begin = hi.y - ui.theme.px(34), full = hi.y - ui.theme.px(6);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilledMultiColor({lo.x, begin}, {hi.x, full}, clear, clear, solid, solid);
  draw.AddRectFilled({lo.x, full}, hi, solid);
}

void constants_panel(Ui& ui, const Region& region) {
  const float padding = ui.theme.px(16);
  if (!begin_region("constants", region, ui.theme.colors.panel, {padding, ui.theme.px(6)})) return end_region();
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(ui.theme.px(8), ui.theme.px(2)));
  // The picked particle stays in sight below the rows; where the window is too low it scrolls with them.
  const float particle = particle_panel_height(ui);
  const bool fixed = ImGui::GetContentRegionAvail().y - particle > least_list(ui);
  const float below = fixed ? particle : 0;
  // The scrollbar stands in the margin, so that rows are as wide as the particle's read-outs below.
  const ImVec2 room = ImGui::GetContentRegionAvail();
  ui.row_width = room.x;
  gui::begin_child("rows", {room.x + padding - ui.theme.px(3), room.y - below});
  ui.slider.rows_scroll = ui.constants_to_top ? 0 : ImGui::GetScrollY();
  if (std::exchange(ui.constants_to_top, false)) ImGui::SetScrollY(0);
  constants_sections(ui);
  view_section(ui);
  if (!fixed) particle_panel(ui);
  ImGui::Dummy({0, ui.theme.px(4)});
  fade_lower_edge(ui);
  ImGui::EndChild();
  if (fixed) particle_panel(ui);
  ImGui::PopStyleVar();
  end_region();
}

}  // namespace tyglab
