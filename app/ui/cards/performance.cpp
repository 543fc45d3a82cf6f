#include "app/ui/cards/cards.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "app/base/text.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"
#include "core/contact/self_contact.h"
#include "core/engines/vertex_sharing.h"
#include "core/integrators/scheme.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

constexpr const char* performance_heading = card_name::performance;

bool cloth(const Ui& ui) {
  return ui.session.preset().kind == Kind::cloth;
}
bool stepping(const Ui& ui) {
  return ui.session.pacing.playing && !ui.session.simulation->divergence();
}

/// Where a feature's time is spent.
enum class Spent {
  step,   ///< fused into the step's one pass
  frame,  ///< a part of the frame
};

/// Whether the engine needs the feature of that name for the present scene.
bool stepped(const Ui& ui, std::string_view name) {
  const auto all = ui.session.simulation->engine().features();
  return std::any_of(all.begin(), all.end(), [&](const StepFeature& f) { return f.name == name && f.on; });
}

/// One row a feature: whether the scene and what is shown need it. What belongs to the step sleeps with it.
struct Feature {
  std::string_view name, help;
  bool (*needed)(const Ui&);  ///< null: the engine says, under the same name
  Spent spent;
  Part part = Part::simulate;
};

constexpr Feature features[] = {
    {"all steps", "Time for the motion, including the features below, down to the ledger.",
     [](const Ui&) { return true; }, Spent::frame, Part::simulate},
    {"bending", "Springs to every second particle: on if their constant is above 0.", nullptr, Spent::step},
    {"rigidity", "Constants of springs that B and twist change: on if B > 0.", nullptr, Spent::step},
    {"curl", "On if κ_warp or κ_weft is not 0, and B > 0.", nullptr, Spent::step},
    {"self", "Contact of the cloth with itself: on while parts are near each other.", nullptr, Spent::step},
    {"damping", "On if k_d > 0.", nullptr, Spent::step},
    {"wind", "On if W is not 0.", nullptr, Spent::step},
    {"air", "Drag and lift: on if ρ_air > 0.", nullptr, Spent::step},
    {"bodies", "Contact with bodies.", nullptr, Spent::step},
    {"tearing", "On if F_max > 0: springs are measured when one may be long enough to tear.", nullptr, Spent::step},
    {"pins", "Particles that forces do not move.", nullptr, Spent::step},
    {"hand", "The particle that follows the pointer.", nullptr, Spent::step},
    {"tear masks", "On once a spring is torn.", [](const Ui& u) { return !u.session.simulation->tears().untorn(); },
     Spent::step},
    {"divergence watch", "Always on: checks how far particles moved, and whether all values are finite.",
     [](const Ui&) { return true; }, Spent::step},
    {"energy ledger", "On while its card is open or dt is automatic: every step is examined.",
     [](const Ui& u) { return u.session.simulation->ledger().has_value(); }, Spent::step},
    {"plot data", "Collected only for visible plots, and while the cloth moves.",
     [](const Ui& u) { return (u.session.wants.forces || u.session.wants.height) && !u.session.recorded.paused; },
     Spent::frame, Part::sample},
    {"colors", "The values that color the cloth: computed only while they are shown and the cloth moves.",
     [](const Ui& u) { return shown_colors(u.scene) != nullptr; }, Spent::frame, Part::colors},
    {"normals", "Only views 1 and 3 have light.", [](const Ui& u) { return cloth(u) && u.scene.view.lit(); },
     Spent::frame, Part::normals},
    {"upload",
     "Positions (and normals) are copied for drawing when the cloth moves, unless the device writes them into OpenGL's "
     "buffer or memory.",
     [](const Ui& u) { return cloth(u); }, Spent::frame, Part::upload},
    {"shadow", "Redrawn when the picture changes.", [](const Ui& u) { return u.scene.view.shadows; }, Spent::frame,
     Part::shadow},
};

/// How many pairs of triangles cross, as far as that is known.
std::string crossings_text(const Ui& ui) {
  const std::optional<FoundCrossings>& found = ui.session.studies.crossings.found();
  if (!found) return "–";
  return (found->complete ? "" : "at least ") + grouped(found->pairs);
}

std::string text(const char* format, double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

std::string megabytes(double bytes) {
  return bytes < 1e6 ? text("%.0f kB", bytes / 1e3) : text("%.1f MB", bytes / 1e6);
}

/// How they come there.
std::string drawn_from(VertexPath path) {
  switch (path) {
    case VertexPath::shared_buffer:
      return "a shared buffer";
    case VertexPath::shared_memory:
      return "shared memory";
    case VertexPath::copied:
      break;
  }
  return "a copy";
}

ImU32 color_of(const Tokens& c, Activity activity) {
  return activity == Activity::on ? c.good : activity == Activity::asleep ? c.accent : c.quiet;
}

constexpr float state_at_1 = 130, states_from_at_1 = 250;  // pixels at scale 1

/// Where state and time have no room beside a feature's name, they stand below it.
bool states_below(const Ui& ui, float width) {
  return width < ui.theme.px(states_from_at_1);
}

/// Name, state, milliseconds a frame.
void feature_line(Ui& ui, const FeatureRow& row, float width) {
  const Tokens& c = ui.theme.colors;
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const bool below = states_below(ui, width);
  const float line = ui.theme.px(card::line), height = below ? 2 * line : line;
  const float name_baseline = baseline_at(ui.fonts, std::round(lo.y + line / 2));
  const float baseline = below ? name_baseline + line : name_baseline;
  ImGui::PushID(row.name.data(), row.name.data() + row.name.size());
  gui::press_area("feature", {width, height});
  tooltip(ui, gui::item_id(), row.help);
  ImGui::PopID();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImU32 ink = row.activity == Activity::on ? c.text : c.quiet;
  draw_on_baseline(draw, *ui.fonts.small, {lo.x, name_baseline}, ink, row.name);
  draw_on_baseline(draw, *ui.fonts.small, {lo.x + ui.theme.px(below ? 12 : state_at_1), baseline},
                   color_of(c, row.activity), name_of(row.activity));
  const ImFont& font = row.ms ? *ui.fonts.mono : *ui.fonts.small;
  const std::string time = row.activity != Activity::on ? "–" : row.ms ? text("%.3f ms", *row.ms) : "in the steps";
  draw_on_baseline(draw, font, {lo.x + width - text_width(font, time), baseline}, ink, time);
}

/// A value in as many lines as it needs; beside its name where one is enough.
struct FactPlaces {
  std::string lines;
  bool beside;
  float height;  ///< px
};

FactPlaces fact_places(const Ui& ui, const PerformanceFact& fact, float width) {
  const ImFont& mono = *ui.fonts.mono;
  const float room = width - text_width(*ui.fonts.small, fact.name) - ui.theme.px(16);
  if (text_width(mono, fact.value) <= room) return {fact.value, true, ui.theme.px(card::line)};
  std::string lines = in_lines(mono, fact.value, width - ui.theme.px(12));
  const auto count = 2 + std::count(lines.begin(), lines.end(), '\n');
  return {std::move(lines), false, float(count) * ui.theme.px(card::line)};
}

void fact_line(Ui& ui, const PerformanceFact& fact, float width) {
  const Tokens& c = ui.theme.colors;
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const FactPlaces places = fact_places(ui, fact, width);
  float baseline = baseline_at(ui.fonts, std::round(lo.y + ui.theme.px(card::line) / 2));
  ImGui::PushID(fact.name.data(), fact.name.data() + fact.name.size());
  gui::press_area("fact", {width, places.height});
  ImGui::PopID();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw_on_baseline(draw, *ui.fonts.small, {lo.x, baseline}, c.quiet, fact.name);
  const ImFont& mono = *ui.fonts.mono;
  std::istringstream lines(places.lines);
  for (std::string value; std::getline(lines, value);) {
    if (!places.beside) baseline += ui.theme.px(card::line);
    draw_on_baseline(draw, mono, {lo.x + width - text_width(mono, value), baseline}, c.text, value);
  }
  if (!fact.help.empty()) tooltip(ui, gui::item_id(), fact.help);
}

}  // namespace

std::string_view name_of(Activity activity) {
  switch (activity) {
    case Activity::on:
      return "on";
    case Activity::skipped:
      return "skipped";
    case Activity::asleep:
      break;
  }
  return "asleep";
}

std::vector<FeatureRow> feature_rows(const Ui& ui) {
  std::vector<FeatureRow> rows;
  for (const Feature& feature : features) {
    FeatureRow row{feature.name, feature.help, Activity::skipped, std::nullopt};
    const bool needed = feature.needed != nullptr ? feature.needed(ui) : stepped(ui, feature.name);
    const bool runs = needed && stepping(ui);
    if (runs) row.activity = ui.session.asleep() ? Activity::asleep : Activity::on;
    if (feature.spent == Spent::frame) row.ms = ui.session.costs.recent_ms(feature.part);
    rows.push_back(row);
  }
  return rows;
}

std::vector<PerformanceFact> performance_facts(const Ui& ui) {
  Engine& engine = ui.session.simulation->engine();
  const double particles = ui.session.simulation->lattice().size();
  const double arrays = double(engine.bytes());
  const double buffers = ui.scene.renderer != nullptr ? double(ui.scene.renderer->bytes()) : 0;
  const double plots = double(ui.session.recorded.forces.bytes() + ui.session.recorded.height.bytes() +
                              ui.session.copies.distance.bytes() + ui.session.copies.energy.bytes());
  std::vector<PerformanceFact> facts;
  facts.push_back({"engine", engine.name()});
  // The pace counts the copies' steps too; their card has measured the original's alone.
  const double step = ui.session.copies.lockstep.empty() ? ui.session.pacing.step_cost_s()
                                                         : ui.session.copies.cost.per_second() * ui.session.preset().dt;
  facts.push_back({"per particle and step", text("%.2f ns", 1e9 * step / particles)});
  if (const Scheme& method = scheme(ui.session.preset().integrator); solves_equations(method)) {
    const SolveCounts solves = engine.solves();
    const auto steps = double(std::max<std::int64_t>(1, ui.session.simulation->steps()));
    const std::string linear = text("%.0f", double(solves.linear) / steps);
    if (solves_damping(method))
      facts.push_back({"products per step", linear});
    else
      facts.push_back({"Newton, CG per step", text("%.1f, ", double(solves.newton) / steps) + linear});
    facts.push_back({"steps not converged", std::to_string(solves.unconverged)});
    if (solves.ended_early > 0) {
      facts.push_back({"ended by the time limit", std::to_string(solves.ended_early)});
      facts.push_back({"longest limited step", text("%.3g ms", 1000 * solves.longest_limited)});
    }
  }
  if (const InnerSteps inner = engine.inner_steps(); inner.accepted > 0) {
    const auto steps = double(std::max<std::int64_t>(1, ui.session.simulation->steps()));
    const auto share = [&](std::int64_t part) { return text("%.0f %%", 100 * double(part) / double(inner.accepted)); };
    facts.push_back({"inner steps, rejected",
                     short_number(double(inner.accepted) / steps, 2) + " per dt, " + share(inner.rejected)});
    facts.push_back({"limited by stability", share(inner.by_stability)});
    facts.push_back({"by accuracy, by dt", share(inner.by_accuracy) + ", " + share(inner.by_dt)});
    facts.push_back({"tolerance missed", std::to_string(inner.too_short + inner.below_digits)});
  }
  facts.push_back({"steps per frame", std::to_string(ui.session.pacing.steps_per_frame())});
  facts.push_back({"whole frame", text("%.2f ms", ui.session.costs.recent_ms(Part::frame))});
  const std::string without = ui.scene.effects.words();
  if (cloth(ui))
    facts.push_back({"crossings", crossings_text(ui),
                     "Pairs of triangles that cross or touch each other: the cloth passes through itself. They are "
                     "outlined in the picture."});
  if (guards_itself(ui.session.requested_preset()))
    facts.push_back(
        {"cut short by the guard", grouped(engine.held_back()) + " moves",
         "The guard has shortened these moves of particles so that layers do not cross. With a smaller dt it cuts less "
         "or nothing, and the motion has the accuracy of the method."});
  facts.push_back({"effects turned off", without.empty() ? "nothing" : without});
  const std::string& why = ui.session.costs.why_copied();
  facts.push_back({"positions are drawn from", drawn_from(ui.session.costs.vertex_path()),
                   why.empty() ? "" : "Copied because " + why});
  const std::size_t copied = ui.session.costs.last_copied();
  facts.push_back({"copied for drawing", copied > 0 ? megabytes(double(copied)) + " per frame" : "0 B"});
  if (bytes_read(engine) > 0)
    facts.push_back({"read by others", megabytes(ui.session.costs.recent_read()) + " per frame"});
  facts.push_back({"solver's arrays", megabytes(arrays) + text(", %.0f B/particle", arrays / particles)});
  facts.push_back(
      {"masks and read-outs", megabytes(double(ui.session.simulation->bytes() + ui.session.sleep.bytes()))});
  facts.push_back({"drawing's buffers", megabytes(buffers)});
  facts.push_back({"plots' history", megabytes(plots)});
  if (!ui.session.copies.lockstep.empty())
    facts.push_back({"copies, without drawing", megabytes(double(ui.session.copies.lockstep.bytes()))});
  facts.push_back({"states for rewinding", megabytes(double(ui.session.rewind.bytes()))});
  facts.push_back({"undo", megabytes(double(ui.session.history.bytes()))});
  return facts;
}

float performance_card_height(const Ui& ui, float width) {
  const float inner = card_width(ui, width);
  float facts = 0;
  for (const PerformanceFact& fact : performance_facts(ui)) facts += fact_places(ui, fact, inner).height;
  const float rows = float(std::size(features)) * (states_below(ui, inner) ? 2 : 1);
  return card_height(ui, performance_heading, rows * card::line + facts / ui.theme.scale);
}

void performance_card(Ui& ui, float height) {
  if (begin_card(ui, performance_heading, height)) {
    const float width = card_width(ui);
    for (const PerformanceFact& fact : performance_facts(ui)) fact_line(ui, fact, width);
    for (const FeatureRow& row : feature_rows(ui)) feature_line(ui, row, width);
  }
  end_card(ui);
}

}  // namespace tyglab
