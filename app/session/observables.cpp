#include "app/session/observables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <sstream>

#include "app/session/session.h"
#include "core/cloth/lattice.h"
#include "core/integrators/names.h"
#include "core/model/changes.h"
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

/// Whether a study of those constants says nothing of the present motion.
bool moved_on(const Preset& of, const Session& session) {
  return !changes(of, session.preset()).within(motionless);
}

/// The limits of the present constants; null while they are worked out, or nobody shows them.
const StabilityLimits* present_limits(const Session& session) {
  const auto& limits = session.studies.stability.limits();
  return limits && !moved_on(limits->of, session) ? &*limits : nullptr;
}

Known crit(Session& session) {
  const StabilityLimits* limits = present_limits(session);
  return limits != nullptr ? Known(limits->any) : std::nullopt;
}
Known crit_now(Session& session) {
  const StabilityLimits* limits = present_limits(session);
  return limits != nullptr ? limits->now : std::nullopt;
}
Known fastest_omega(Session& session) {
  const StabilityLimits* limits = present_limits(session);
  return limits != nullptr && limits->now ? Known(limits->omega) : std::nullopt;
}
/// Where the last stable or near zone of a constant ends.
Known zone_end(Session& session, std::string_view key) {
  const StabilityLimits* limits = present_limits(session);
  if (limits == nullptr) return std::nullopt;
  const auto zones = limits->zones.find(key);
  if (zones == limits->zones.end()) return std::nullopt;
  for (const ZoneSpan& span : zones->second)
    if (span.zone == Zone::unstable) return span.from;
  return std::nullopt;
}

/// The study of the accuracy card, once it has checked the present settings.
std::optional<AccuracyStudy> present_study(const Session& session) {
  auto study = session.studies.accuracy.study();
  if (!study || !study->present || moved_on(study->of, session)) return std::nullopt;
  return study;
}
Known present_error(Session& session) {
  const auto study = present_study(session);
  return study ? Known(study->present->error_rms_m) : std::nullopt;
}
Known present_cost(Session& session) {
  const auto study = present_study(session);
  return study ? Known(study->present->cost) : std::nullopt;
}
Known references_agreement(Session& session) {
  const auto study = present_study(session);
  return study ? Known(study->reference.agreement_rms_m) : std::nullopt;
}

/// What table B.1 says of the picked particle.
std::optional<ParticleReadout> picked_particle(const Session& session) {
  if (!session.picked || !session.simulation->lattice().contains(session.picked->i, session.picked->j))
    return std::nullopt;
  return session.simulation->particle(session.picked->i, session.picked->j);
}
template <glm::dvec3 ParticleReadout::*vector>
Known length_of(Session& session) {
  const auto particle = picked_particle(session);
  return particle ? Known(glm::length((*particle).*vector)) : std::nullopt;
}
template <int component>
Known position_of(Session& session) {
  const auto particle = picked_particle(session);
  return particle ? Known(particle->x[component]) : std::nullopt;
}

Known fastest_particle(Session& session) {
  return largest_speed(*session.simulation);
}
Known mean_height(Session& session) {
  const Array<double>& y = session.simulation->read().x.y;
  double sum = 0;
  for (const double value : y) sum += value;
  return sum / double(y.size());
}
Known lowest_height(Session& session) {
  const Array<double>& y = session.simulation->read().x.y;
  return *std::min_element(y.begin(), y.end());
}

/// Root of the mean square of the particles' ways from where they were when the step before was completed.
Known distance_to_before(Session& session) {
  const auto& run = session.labs.run;
  if (!run || run->step == 0) return std::nullopt;
  const auto& then = run->records[run->step - 1].outcome.state;
  const State& now = session.simulation->read();
  if (!then || then->x.x.size() != now.x.x.size()) return std::nullopt;
  return rms_distance(now, *then);
}

Known pinned_particles(Session& session) {
  const Lattice& lattice = session.simulation->lattice();
  int count = 0;
  for (int i = 0; i < lattice.rows; ++i)
    for (int j = 0; j < lattice.columns; ++j) count += session.simulation->pinned(i, j);
  return count;
}
Known ledger_share(Session& session) {
  const auto ledger = session.simulation->ledger();
  return ledger ? Known(ledger->share()) : std::nullopt;
}
Known time_of_divergence(Session& session) {
  const auto& divergence = session.simulation->divergence();
  return divergence ? Known(divergence->t) : std::nullopt;
}

constexpr std::string_view limits_hint = "Show the constants; it is computed in a moment.",
                           study_hint = "Open the card Accuracy; it measures for a few seconds.",
                           pick_hint = "Right-click a particle to pick it.";

const std::array rows{
    Observable{"t", "s", "Simulated time.", "", [](Session& session) -> Known { return session.simulation->time(); }},
    Observable{"steps", "", "Steps of dt since the start.", "",
               [](Session& session) -> Known { return double(session.simulation->steps()); }},
    Observable{"playing", "", "Whether the motion runs.", "", nullptr, nullptr,
               [](const Session& session) { return said(session.pacing.playing); }, no_or_yes},
    Observable{"diverged", "", "Whether the simulation has diverged.", "", nullptr, nullptr,
               [](const Session& session) { return said(session.simulation->divergence().has_value()); }, no_or_yes},
    Observable{"diverged_at", "s", "Simulated time at which it diverged.", "It has not diverged.", time_of_divergence},
    Observable{"integrator", "", "The method, by its name in presets.", "", nullptr, nullptr,
               [](const Session& session) -> std::string_view { return session.preset().integrator; },
               integrator_names},
    Observable{"engine", "", "What computes the steps.", "", nullptr, nullptr,
               [](const Session& session) { return engine_names[std::size_t(session.preset().engine)]; },
               []() -> std::span<const std::string_view> { return engine_names; }},
    Observable{"precision", "", "The numbers' precision.", "", nullptr, nullptr,
               [](const Session& session) { return precision_names[std::size_t(session.preset().precision)]; },
               []() -> std::span<const std::string_view> { return precision_names; }},
    Observable{"dt_crit", "s", "Largest stable dt of the method in any configuration of the springs, by linear theory.",
               limits_hint, crit, &Wants::stability},
    Observable{"dt_crit_now", "s", "The same of the cloth as it hangs now.", limits_hint, crit_now, &Wants::stability},
    Observable{"k_s_crit", "N/m", "k_s at which the method breaks at this dt, in any configuration.", limits_hint,
               [](Session& session) { return zone_end(session, "k_s"); }, &Wants::stability},
    Observable{"k_d_crit", "N s/m", "k_d at which the method breaks at this dt, in any configuration.", limits_hint,
               [](Session& session) { return zone_end(session, "k_d"); }, &Wants::stability},
    Observable{"omega", "1/s", "The cloth's fastest angular frequency as it hangs now.", limits_hint, fastest_omega,
               &Wants::stability},
    Observable{"energy", "J", "Kinetic energy plus that of springs and height (zero at y = 0).", "",
               [](Session& session) -> Known { return session.simulation->energy().energy.total(); }},
    Observable{"kinetic", "J", "Kinetic energy.", "",
               [](Session& session) -> Known { return session.simulation->energy().energy.kinetic; }},
    Observable{"made", "",
               "Energy that no force explains, as a fraction of the scene's: above 0 the integrator added it.",
               "Open the card Energy.", ledger_share},
    Observable{"error", "m", "Error (rms) of the present settings over the time shown on the card Accuracy.",
               study_hint, present_error},
    Observable{"agreement", "m", "How far two references of that card differ.", study_hint, references_agreement},
    Observable{"cost", "", "CPU seconds per simulated second with the present settings.", study_hint, present_cost},
    Observable{"apart", "m",
               "Distance (rms over the particles) from their positions when the step before was completed.",
               "Complete the step before with the same cloth.", distance_to_before},
    Observable{"picked", "", "Whether a particle is picked.", "", nullptr, nullptr,
               [](const Session& session) { return said(session.picked.has_value()); }, no_or_yes},
    Observable{"x", "m", "Position of the picked particle (or of the mass on a spring), to the right.", pick_hint,
               position_of<0>},
    Observable{"y", "m", "Its height.", pick_hint, position_of<1>},
    Observable{"z", "m", "Toward the viewer.", pick_hint, position_of<2>},
    Observable{"v", "m/s", "Its speed.", pick_hint, length_of<&ParticleReadout::v>},
    Observable{"a", "m/s²", "Magnitude of its acceleration.", pick_hint, length_of<&ParticleReadout::a>},
    Observable{"F", "N", "Magnitude of the total force on it.", pick_hint, length_of<&ParticleReadout::F>},
    Observable{"F_s", "N", "Magnitude of its stretching force.", pick_hint, length_of<&ParticleReadout::F_s>},
    Observable{"F_b", "N", "Magnitude of its bending force.", pick_hint, length_of<&ParticleReadout::F_b>},
    Observable{"F_d", "N", "Magnitude of its damping force.", pick_hint, length_of<&ParticleReadout::F_d>},
    Observable{"F_g", "N", "Its weight.", pick_hint, length_of<&ParticleReadout::F_g>},
    Observable{"fastest", "m/s", "Speed of the fastest particle.", "", fastest_particle},
    Observable{"mean_y", "m", "Mean height of the particles.", "", mean_height},
    Observable{"lowest_y", "m", "Height of the lowest particle.", "", lowest_height},
    Observable{"torn", "", "Stretch springs that are torn or cut.", "",
               [](Session& session) -> Known { return double(session.simulation->tears().torn_count()); }},
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

std::optional<double> observe(Session& session, std::string_view name) {
  if (const Observable* row = find_observable(name))
    return row->number != nullptr ? row->number(session) : std::nullopt;
  const ConstantPlace place = constant_place(name);
  if (place.row == nullptr) return std::nullopt;
  return constant_value(place, session.preset());
}

std::string_view observe_word(const Session& session, std::string_view name) {
  const Observable* row = find_observable(name);
  return row != nullptr && row->word != nullptr ? row->word(session) : std::string_view();
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
    if (!row.hint.empty() && row.number != nullptr) out << " Where it is not known: " << row.hint;
    out << " |\n";
  }
  return out.str();
}

}  // namespace tyglab
