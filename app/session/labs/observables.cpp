#include "app/session/labs/observables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <sstream>

#include "app/ui/app.h"
#include "core/cloth/lattice.h"
#include "core/integrators/names.h"
#include "core/model/notation.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

using Known = std::optional<double>;

constexpr std::array<std::string_view, 2> no_yes{"no", "yes"};

std::string_view said(bool yes) {
  return no_yes[yes ? 1 : 0];
}
std::span<const std::string_view> no_or_yes() {
  return no_yes;
}

/// The limits of the present constants; null while they are worked out, or nobody shows them.
const StabilityLimits* present_limits(const App& app) {
  const auto& limits = app.stability.limits();
  return limits && limits->of == app.preset() ? &*limits : nullptr;
}

Known crit(App& app) {
  const StabilityLimits* limits = present_limits(app);
  return limits != nullptr ? Known(limits->any) : std::nullopt;
}
Known crit_now(App& app) {
  const StabilityLimits* limits = present_limits(app);
  return limits != nullptr ? limits->now : std::nullopt;
}
Known fastest_omega(App& app) {
  const StabilityLimits* limits = present_limits(app);
  return limits != nullptr && limits->now ? Known(limits->omega) : std::nullopt;
}
/// Where the last stable or near zone of a constant ends.
Known zone_end(App& app, std::string_view key) {
  const StabilityLimits* limits = present_limits(app);
  if (limits == nullptr) return std::nullopt;
  const auto zones = limits->zones.find(key);
  if (zones == limits->zones.end()) return std::nullopt;
  for (const ZoneSpan& span : zones->second)
    if (span.zone == Zone::unstable) return span.from;
  return std::nullopt;
}

/// The study of the accuracy card, once it has judged the present settings.
std::optional<AccuracyStudy> present_study(const App& app) {
  auto study = app.accuracy.study();
  if (!study || !study->present || study->of != app.preset()) return std::nullopt;
  return study;
}
Known present_error(App& app) {
  const auto study = present_study(app);
  return study ? Known(study->present->error_rms_m) : std::nullopt;
}
Known present_cost(App& app) {
  const auto study = present_study(app);
  return study ? Known(study->present->cost) : std::nullopt;
}
Known references_agreement(App& app) {
  const auto study = present_study(app);
  return study ? Known(study->reference.agreement_rms_m) : std::nullopt;
}

/// What table B.1 says of the picked particle.
std::optional<ParticleReadout> picked_particle(const App& app) {
  if (!app.picked || !app.simulation->lattice().contains(app.picked->i, app.picked->j)) return std::nullopt;
  return app.simulation->particle(app.picked->i, app.picked->j);
}
template <glm::dvec3 ParticleReadout::*vector>
Known length_of(App& app) {
  const auto particle = picked_particle(app);
  return particle ? Known(glm::length((*particle).*vector)) : std::nullopt;
}
template <int component>
Known position_of(App& app) {
  const auto particle = picked_particle(app);
  return particle ? Known(particle->x[component]) : std::nullopt;
}

Known fastest_particle(App& app) {
  const VectorField<double>& v = app.simulation->read().v;
  double most = 0;
  for (std::size_t p = 0; p < v.x.size(); ++p)
    most = std::max(most, v.x[p] * v.x[p] + v.y[p] * v.y[p] + v.z[p] * v.z[p]);
  return std::sqrt(most);
}
Known mean_height(App& app) {
  const Array<double>& y = app.simulation->read().x.y;
  double sum = 0;
  for (const double value : y) sum += value;
  return sum / double(y.size());
}
Known lowest_height(App& app) {
  const Array<double>& y = app.simulation->read().x.y;
  return *std::min_element(y.begin(), y.end());
}

/// Root of the mean square of the particles' ways from where they were when the step before was completed.
Known distance_to_before(App& app) {
  const auto& run = app.labs.run;
  if (!run || run->step == 0) return std::nullopt;
  const auto& then = run->records[run->step - 1].moment.state;
  const VectorField<double>& x = app.simulation->read().x;
  if (!then || then->x.x.size() != x.x.size()) return std::nullopt;
  double sum = 0;
  for (std::size_t p = 0; p < x.x.size(); ++p) {
    const glm::dvec3 way(x.x[p] - then->x.x[p], x.y[p] - then->x.y[p], x.z[p] - then->x.z[p]);
    sum += glm::dot(way, way);
  }
  return std::sqrt(sum / double(x.x.size()));
}

Known pinned_particles(App& app) {
  const Lattice& lattice = app.simulation->lattice();
  int count = 0;
  for (int i = 0; i < lattice.rows; ++i)
    for (int j = 0; j < lattice.columns; ++j) count += app.simulation->pinned(i, j);
  return count;
}
Known ledger_share(App& app) {
  const auto ledger = app.simulation->ledger();
  return ledger ? Known(ledger->share()) : std::nullopt;
}
Known time_of_divergence(App& app) {
  const auto& divergence = app.simulation->divergence();
  return divergence ? Known(divergence->t) : std::nullopt;
}

constexpr std::string_view limits_cure = "Show the constants; it is worked out in a moment.",
                           study_cure = "Open the card Accuracy; it measures for a few seconds.",
                           pick_cure = "Right-click a particle to pick it.";

const std::array rows{
    Observable{"t", "s", "Simulated time.", "", [](App& app) -> Known { return app.simulation->time(); }},
    Observable{"steps", "", "Steps of dt since the start.", "",
               [](App& app) -> Known { return double(app.simulation->steps()); }},
    Observable{"playing", "", "Whether the motion runs.", "", nullptr,
               [](const App& app) { return said(app.pacing.playing); }, no_or_yes},
    Observable{"diverged", "", "Whether the simulation has diverged.", "", nullptr,
               [](const App& app) { return said(app.simulation->divergence().has_value()); }, no_or_yes},
    Observable{"diverged_at", "s", "Simulated time at which it diverged.", "It has not diverged.", time_of_divergence},
    Observable{"integrator", "", "The method, by its name in presets.", "", nullptr,
               [](const App& app) -> std::string_view { return app.preset().integrator; }, integrator_names},
    Observable{"engine", "", "What computes the steps.", "", nullptr,
               [](const App& app) { return engine_names[std::size_t(app.preset().engine)]; },
               []() -> std::span<const std::string_view> { return engine_names; }},
    Observable{"precision", "", "The numbers' precision.", "", nullptr,
               [](const App& app) { return precision_names[std::size_t(app.preset().precision)]; },
               []() -> std::span<const std::string_view> { return precision_names; }},
    Observable{"dt_crit", "s", "Largest stable dt of the method in any configuration of the springs, by linear theory.",
               limits_cure, crit},
    Observable{"dt_crit_now", "s", "The same of the cloth as it hangs now.", limits_cure, crit_now},
    Observable{"k_s_crit", "N/m", "k_s at which the method breaks at this dt, in any configuration.", limits_cure,
               [](App& app) { return zone_end(app, "k_s"); }},
    Observable{"k_d_crit", "N s/m", "k_d at which the method breaks at this dt, in any configuration.", limits_cure,
               [](App& app) { return zone_end(app, "k_d"); }},
    Observable{"omega", "1/s", "The cloth's fastest angular frequency as it hangs now.", limits_cure, fastest_omega},
    Observable{"energy", "J", "Energy of motion, springs and height (zero at y = 0).", "",
               [](App& app) -> Known { return app.simulation->energy().energy.total(); }},
    Observable{"kinetic", "J", "Energy of motion.", "",
               [](App& app) -> Known { return app.simulation->energy().energy.kinetic; }},
    Observable{"made", "", "Energy that nothing explains, as a part of the scene's: above 0 the integrator made it.",
               "Open the card Energy.", ledger_share},
    Observable{"error", "m", "Error (rms) of the present settings over the time that the card Accuracy says.",
               study_cure, present_error},
    Observable{"agreement", "m", "How far two references of that card differ.", study_cure, references_agreement},
    Observable{"cost", "", "Processor seconds that a simulated second takes with the present settings.", study_cure,
               present_cost},
    Observable{"apart", "m",
               "Distance (rms over the particles) from where they were when the step before was completed.",
               "Complete the step before with the same cloth.", distance_to_before},
    Observable{"picked", "", "Whether a particle is picked.", "", nullptr,
               [](const App& app) { return said(app.picked.has_value()); }, no_or_yes},
    Observable{"x", "m", "Position of the picked particle (or the weight), to the right.", pick_cure, position_of<0>},
    Observable{"y", "m", "Its height.", pick_cure, position_of<1>},
    Observable{"z", "m", "Towards the viewer.", pick_cure, position_of<2>},
    Observable{"v", "m/s", "Its speed.", pick_cure, length_of<&ParticleReadout::v>},
    Observable{"a", "m/s²", "Magnitude of its acceleration.", pick_cure, length_of<&ParticleReadout::a>},
    Observable{"F", "N", "Magnitude of the total force on it.", pick_cure, length_of<&ParticleReadout::F>},
    Observable{"F_s", "N", "Magnitude of its stretching force.", pick_cure, length_of<&ParticleReadout::F_s>},
    Observable{"F_b", "N", "Magnitude of its bending force.", pick_cure, length_of<&ParticleReadout::F_b>},
    Observable{"F_d", "N", "Magnitude of its damping force.", pick_cure, length_of<&ParticleReadout::F_d>},
    Observable{"F_g", "N", "Its weight.", pick_cure, length_of<&ParticleReadout::F_g>},
    Observable{"fastest", "m/s", "Speed of the fastest particle.", "", fastest_particle},
    Observable{"mean_y", "m", "Mean height of the particles.", "", mean_height},
    Observable{"lowest_y", "m", "Height of the lowest particle.", "", lowest_height},
    Observable{"torn", "", "Stretch springs that are torn or cut.", "",
               [](App& app) -> Known { return double(app.simulation->tears().torn_count()); }},
    Observable{"pinned", "", "Pinned particles.", "", pinned_particles},
};

/// A number of the notation table: "k_s", "W.x".
struct ConstantPlace {
  const PresetRow* row = nullptr;
  int component = 0;
};

ConstantPlace constant_place(std::string_view name) {
  const bool component = name.size() > 2 && name[name.size() - 2] == '.' && name.back() >= 'x' && name.back() <= 'z';
  const PresetRow* row = find_row(component ? name.substr(0, name.size() - 2) : name);
  if (row == nullptr || std::holds_alternative<std::string Preset::*>(row->field)) return {};
  if (component != std::holds_alternative<glm::dvec3 Preset::*>(row->field)) return {};
  return {row, component ? name.back() - 'x' : 0};
}

double constant_value(const ConstantPlace& place, const Preset& preset) {
  if (const auto* number = std::get_if<double Preset::*>(&place.row->field)) return preset.**number;
  if (const auto* integer = std::get_if<int Preset::*>(&place.row->field)) return preset.**integer;
  return (preset.*std::get<glm::dvec3 Preset::*>(place.row->field))[place.component];
}

}  // namespace

std::span<const Observable> observables() {
  return rows;
}

const Observable* find_observable(std::string_view name) {
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const Observable& o) { return o.name == name; });
  return row == rows.end() ? nullptr : &*row;
}

bool is_observable(std::string_view name) {
  return find_observable(name) != nullptr || constant_place(name).row != nullptr;
}

bool is_word(std::string_view name) {
  const Observable* row = find_observable(name);
  return row != nullptr && row->word != nullptr;
}

std::string_view unit_of(std::string_view name) {
  if (const Observable* row = find_observable(name)) return row->unit;
  const PresetRow* row = constant_place(name).row;
  return row != nullptr ? row->unit : std::string_view();
}

std::vector<std::string_view> observable_names() {
  std::vector<std::string_view> names;
  for (const Observable& row : rows) names.push_back(row.name);
  for (const PresetRow& row : notation())
    if (constant_place(row.key).row != nullptr) names.push_back(row.key);
  return names;
}

std::optional<double> observe(App& app, std::string_view name) {
  if (const Observable* row = find_observable(name)) return row->number != nullptr ? row->number(app) : std::nullopt;
  const ConstantPlace place = constant_place(name);
  if (place.row == nullptr) return std::nullopt;
  return constant_value(place, app.preset());
}

std::string_view observe_word(const App& app, std::string_view name) {
  const Observable* row = find_observable(name);
  return row != nullptr && row->word != nullptr ? row->word(app) : std::string_view();
}

std::string observables_markdown() {
  std::ostringstream out;
  out << "| Name | Unit | What it is |\n|---|---|---|\n";
  for (const Observable& row : rows) {
    out << "| `" << row.name << "` | " << (row.unit.empty() ? "–" : row.unit) << " | " << row.meaning;
    if (row.words != nullptr && row.name != "integrator") {
      out << " One of";
      for (const std::string_view word : row.words()) out << " `" << word << "`";
      out << '.';
    }
    if (!row.suggested_fix.empty() && row.number != nullptr) out << " Where it is not known: " << row.suggested_fix;
    out << " |\n";
  }
  return out.str();
}

}  // namespace tyglab
