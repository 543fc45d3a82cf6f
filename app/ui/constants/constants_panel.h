// The left column: every constant of the notation table that the scene uses, and the picked particle.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/studies/stability_watch.h"
#include "app/ui/kit/overlay_layout.h"
#include "app/ui/kit/widgets.h"
#include "app/ui/state/ui.h"
#include "core/model/fabric.h"
#include "core/model/notation.h"
#include "core/model/preset.h"

namespace tyglab {

void constants_panel(Ui& ui, const Region& region);
/// The method, to be chosen.
void integrator_row(Ui& ui);
/// Its contents, section by section.
void constants_sections(Ui& ui);
void body_sections(Ui& ui);
/// Puts a sphere under the cloth, or over a cloth that lies on a plane; a plane under all that the scene holds. The
/// camera and the column of constants show it.
void add_body(Ui& ui, Body::Shape shape);
/// Why there can be no further one, a sentence; empty: there can.
std::string no_more_bodies(const Ui& ui);
void view_section(Ui& ui);
/// The picked particle's variables of table B.1.
void particle_panel(Ui& ui);
float particle_panel_height(const Ui& ui);
/// Brings a constant's row into sight, with its slider in focus.
void show_constant(Ui& ui, std::string_view key);
/// The column scrolls to that constant's row where it would not be seen, and unfolds its section.
void bring_into_sight(Ui& ui, std::string_view key);
/// Whether the constant plays a part in this scene.
bool applies(const PresetRow& row, const Preset& preset);
/// Whether the panel shows it as a choice of words.
bool is_word_row(const PresetRow& row, const Preset& preset);

// One constant on one line: symbol, slider, value, unit, in aligned columns.

/// Draws the row of a constant of the preset; changes become requests. Rows without a slider (text) are not for here.
void constant_row(Ui& ui, const PresetRow& row);
/// The same for a quantity of the cloth as a fabric.
void fabric_quantity_row(Ui& ui, const FabricQuantity& quantity);
/// The same for body `index`.
void body_row(Ui& ui, const BodyRow& row, int index);

/// Scrolls the column where the row of that key and height, which is to be drawn next, is to be in sight and is not.
void come_into_sight(Ui& ui, std::string_view key, float height);
/// A constant that is one of some words, which panels show by their titles.
void word_row(Ui& ui, const char* key, const char* label, std::string Preset::*field,
              std::span<const std::string_view> names, std::span<const char* const> titles, const char* tip);

/// A line whose slider column `content` fills (combos, buttons): a plain label stands where symbols do.
void labeled_row(Ui& ui, const char* label, const std::function<void(float width)>& content);

/// "equation (2.5) of the report “Simulering av tyg” (2012)": a number alone would not say where to look.
std::string equation_of_report(std::string_view equation);

/// Height of a row and width of its columns, at the present scale.
struct RowColumns {
  float height, symbol, value, unit, gap;
};
RowColumns row_columns(const Ui& ui);

// The menu of engines and precisions in the top bar, which the palette also lists.

struct Ui;

/// Where the cloth is computed, and how exactly.
struct EngineMode {
  const char* name;   ///< in the session report: "cpu_float"
  const char* label;  ///< in the menu: "CPU · float"
  const char* title;  ///< in the palette: "CPU, float"
  EngineKind engine;
  Precision precision;
};
std::span<const EngineMode> engine_modes();

/// Why the mode cannot be chosen with these constants, in sentences; empty: it can, as far as is known. `devices`: what
/// OpenCL offers, null while that is not known.
std::string why_not(const EngineMode& mode, const Preset& preset, const OpenClInventory* devices);
/// What the mode is, in a sentence, with the device's name where it is known.
std::string words_of(const EngineMode& mode, const Preset& preset, const OpenClInventory* devices);

/// The menu, as a combo box of that width.
void engine_menu(Ui& ui, float width);

// The number of particles: halved, doubled or typed. A typed number may mean a finer cloth or more cloth; the row asks
// which, next to the constants, before anything is built.

struct Ui;

/// Other rows or columns than the cloth's, until it is said what they mean.
struct ResolutionQuestion {
  Preset more;                      ///< L and m stay: another size
  std::optional<Preset> same_size;  ///< where the cloth's proportions allow it: as large and as heavy as now
};

/// Asks what the change of rows or columns from the present preset means.
void ask_resolution(Ui& ui, const Preset& wanted);
/// The question, while it waits for its answer and still belongs to the present cloth.
std::optional<ResolutionQuestion> resolution_question(const Ui& ui);
/// Answers it, in one change that one undo takes back.
void answer_resolution(Ui& ui, bool same_size);

/// "÷ 2", "× 2", and the question.
void resolution_row(Ui& ui);

// The gauge under dt: dt relative to the worst-case limit of linear theory, and to the limit of the present cloth.

struct Ui;

/// dt over the worst-case limit, as a bar with a number; marks where this cloth's own limit lies and from where on
/// every shape is unstable. Each mark has a tooltip, and the bar one for all.
void stability_row(Ui& ui);

/// The gauge's number: "57 %", "no limit", "unstable at any dt".
std::string stability_text(const StabilityLimits& limits, double dt);
/// "dt is 75 % of the worst-case limit, 58 % of this cloth's as it hangs now." Of the mass on a spring "dt is
/// 75 % of the limit." Empty where there is no limit, or none that is stable.
std::string part_words(const StabilityLimits& limits, double dt);
/// The bar's tooltip.
std::string stability_words(const StabilityLimits& limits, double dt);

/// A place on the gauge that has something to say.
struct GaugeMark {
  std::string_view name;  ///< "dt", "worst case", "this cloth", "every shape"
  double at;              ///< s
  std::string words;      ///< its tooltip
};
/// None where there is no limit, or none that is stable.
std::vector<GaugeMark> gauge_marks(const StabilityLimits& limits, double dt);
/// Where a dt is drawn along the bar, 0 to 1: the worst-case limit is always in the middle, and no dt is beyond the
/// end.
double gauge_position(const StabilityLimits& limits, double dt);

// Stability zones on the controls: where along a constant the method is stable in any shape of the cloth, where this
// depends on the shape, and where the method is unstable in every shape.

/// A strip under the slider at `lo` to `hi`, for constants that have zones; nothing while dt is automatic, since it
/// then follows.
void draw_zones(Ui& ui, std::string_view key, const SliderScale& scale, ImVec2 lo, ImVec2 hi);

/// Color and paint of a zone, the same wherever it is drawn. Color is never the only sign: stable is a thin line, what
/// depends on the shape is dashed, what is unstable is hatched and thicker.
ImU32 zone_color(const Tokens& colors, Zone zone);
void draw_zone(Ui& ui, Zone zone, ImVec2 lo, ImVec2 hi);

/// The present zone, and where along the constant the zones lie: "Depends on the shape: dt is 115 % of …. Verlet at
/// this dt: k_s up to 133 N/m stable in any shape, …". Empty for a constant without zones, and for methods that no dt
/// makes unstable.
std::string zone_words(const StabilityLimits& limits, std::string_view key, std::string_view unit);

}  // namespace tyglab
