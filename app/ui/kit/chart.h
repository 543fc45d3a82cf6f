// A complete chart with title, axes and legend, for the benchmarks, and its PNG without a display.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/base/image.h"
#include "app/ui/kit/curve_plot.h"
#include "app/ui/kit/overlay_layout.h"
#include "app/ui/kit/theme.h"
#include "app/ui/kit/ui_context.h"
#include "core/analysis/convergence.h"
#include "core/analysis/stability_map.h"
#include "core/lockstep.h"

namespace tyglab {

struct ChartAxis {
  std::string title;  ///< with its unit
  bool log = false;
  bool from_zero = false;  ///< a linear axis begins at 0
  std::vector<PlotTick>
      ticks;  ///< in place of worked-out ones: the axis then holds them, and half a step on either side
  std::optional<std::pair<double, double>> span = {};  ///< exactly this, in place of what holds the series
};

/// A filled rectangle under the curves; `hatched` too where its color alone would say something bad.
struct ChartCell {
  double x_lo, x_hi, y_lo, y_hi;
  ImU32 color;
  bool hatched = false;
};

struct ChartSeries {
  std::string name;  ///< empty: not in the legend
  CurveStyle style;
  bool line = true;
  float marks = 3;  ///< radius of the discs, at scale 1; 0: none
  std::vector<double> x, y;
  bool hollow = false;  ///< rings in place of discs
};

struct Chart {
  std::string title;
  std::string note;  ///< a quiet line under the title
  ChartAxis x, y;
  std::vector<ChartSeries> series;
  std::vector<ChartCell> cells = {};
  float padding = 20;  ///< on all sides, at scale 1
};

/// A color and a line style for the k-th of many series, the same in every chart; alike only eight apart.
CurveStyle series_style(const Tokens& colors, int k);

/// Draws a chart into the rectangle: title, the plot, and as many lines of legend as it needs. Returns where values are
/// in it.
PlotAxes draw_chart(const PlotPaint& paint, ImVec2 at, ImVec2 size, const Chart& chart);

inline constexpr float chart_width = 640, chart_height = 400;  ///< points at scale 1

/// Charts side by side in rows of `columns`, each chart_width x `height` points at that scale, drawn in the OpenGL
/// context that is current, outside Dear ImGui's frames. Throws GraphicsError.
Image picture_of(const std::vector<Chart>& charts, int columns = 2, float scale = 2, float height = chart_height);
/// Writes that picture as PNG ("-" is standard output). Needs no display (EGL's surfaceless platform). Throws
/// GraphicsError, OutputError.
void write_charts(const std::filesystem::path& file, const std::vector<Chart>& charts, Reach reach, int columns = 2,
                  float scale = 2, float height = chart_height);

// A chart of error over dt, in the window and as a picture.

/// The errors of a study (quiet where the reference cannot tell them), the slope through them, and the slope that the
/// method's table promises.
Chart convergence_chart(const Tokens& colors, const Convergence& study);

// The map of stiffness against dt as a chart, in the window and as a picture.

/// Cells colored by the energy added or removed, or hatched where it diverged; theory's borders between
/// its zones as lines; the preset's own place as a disc.
Chart map_chart(const Tokens& colors, const Preset& preset, const MapGrid& grid, const MapBoundary& boundary,
                std::span<const MapCell> cells);

/// The same with a title and a quiet note under it, as it is written to a file.
Chart map_page(const Tokens& colors, const Preset& preset, const std::string& label, const std::string& note,
               const MapGrid& grid, const MapBoundary& boundary, std::span<const MapCell> cells);

/// What a short run came to, as a sentence without its end: "k_s = 92 N/m, dt = 0.0013 s: diverged after 0.12 s".
std::string cell_words(const Preset& preset, const MapCell& cell);

// Colors and line styles of curves: one for each force, method and copy, in all plots.

/// Of a variable of table B.1, by its key: in plots, lists and as an arrow.
CurveStyle curve_style(const Tokens& colors, std::string_view key);
/// Of a method's curve in every chart, legend and list: figure 3.2's blue Verlet, green improved Euler and magenta
/// Euler; "exact" is the closed form's. No two methods have the same color. Gray for a method without a row.
CurveStyle integrator_style(const Tokens& colors, std::string_view name);
/// Of a cloth among copies, in plots, labels and as an overlay: its method's or, with a seat, one that no method has.
CurveStyle copy_style(const Tokens& colors, std::string_view method, std::optional<std::size_t> seat);

// The window's plots: curves over simulated time, with a read-out under the pointer.

struct PlotFrame {
  double x_min, x_max;  ///< s
  bool log = false;
  bool from_zero = false;  ///< a linear axis of magnitudes begins at 0
  std::string_view unit;
  std::string when_empty;   ///< said where there is nothing to plot, or all of it was earlier
  double time_step = 1e-3;  ///< s, that the read-out of t tells apart
};

/// The scale of the y axis: it holds nearly all of what the window shows. A few values far beyond (a blow-up) do not
/// flatten the rest; they leave the scale and are flagged.
PlotRange plot_range(std::span<const PlotCurve> curves, const PlotFrame& frame);

/// Draws it at the cursor, with axes, flags for what is off the scale, and a read-out under the pointer. The curves
/// share their x. Returns how far the wheel was turned over it, where it does not scroll the column.
float draw_plot(UiContext& ui, const char* id, ImVec2 size, std::span<const PlotCurve> curves, const PlotFrame& frame);

// A card with a plot: its background, with a title, a note and buttons above the contents.

/// Begins where the cursor stands, as wide as its region; the cursor then goes inside it.
class PlotCard {
 public:
  /// `buttons`: how many head_buttons follow; the note stands to their left.
  PlotCard(UiContext& ui, const char* id, std::string_view title, std::string_view note, float height, int buttons = 0);
  ~PlotCard();
  PlotCard(const PlotCard&) = delete;
  PlotCard& operator=(const PlotCard&) = delete;
  const Region& inner() const { return inner_; }

  /// A button on the title's line, the n-th from the right; the cursor stays.
  bool head_button(UiContext& ui, int n, const char* id, const char* glyph, const char* word, const char* tip) const;

 private:
  Region inner_;
};

/// Height of a card with that much in it, and width of what a card of that width holds, px.
float plot_card_height(const UiContext& ui, float content);
float plot_card_inner_width(const UiContext& ui, float width);
/// The width that is left for its title beside that many buttons, px.
float plot_card_title_width(const UiContext& ui, float width, int buttons);

}  // namespace tyglab
