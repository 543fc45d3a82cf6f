#include "app/session/observables.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <sstream>

#include "app/session/lab_check.h"
#include "app/session/motion.h"
#include "app/session/session.h"
#include "core/analysis/area.h"
#include "core/cloth/lattice.h"
#include "core/integrators/scheme.h"
#include "core/model/effect.h"
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
/// The same, once they have been worked out for the cloth as it is at this moment.
const StabilityLimits* limits_of_moment(const Session& session) {
  const StabilityLimits* limits = present_limits(session);
  return limits != nullptr && limits->at == session.study_moment().mark() ? limits : nullptr;
}
Known crit_now(Session& session) {
  const StabilityLimits* limits = limits_of_moment(session);
  return limits != nullptr ? limits->now : std::nullopt;
}
Known fastest_omega(Session& session) {
  const StabilityLimits* limits = limits_of_moment(session);
  return limits != nullptr && limits->now ? Known(limits->omega) : std::nullopt;
}
/// Where the zone of a constant begins in which not every shape of the cloth is stable any more.
Known zone_end(Session& session, std::string_view key) {
  const StabilityLimits* limits = present_limits(session);
  if (limits == nullptr) return std::nullopt;
  const auto zones = limits->zones.find(key);
  if (zones == limits->zones.end()) return std::nullopt;
  for (const ZoneSpan& span : zones->second)
    if (span.zone != Zone::stable) return span.from;
  return std::nullopt;
}

/// The study of the accuracy card, once it has checked the present settings from the present moment on.
std::optional<AccuracyStudy> present_study(const Session& session) {
  auto study = session.studies.accuracy.study();
  if (!study || !study->present || moved_on(study->of, session)) return std::nullopt;
  if (study->at != session.study_moment().mark()) return std::nullopt;
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
  if (!session.picked || !session.simulation->has(session.picked->i, session.picked->j)) return std::nullopt;
  return session.simulation->particle(session.picked->i, session.picked->j);
}
template <glm::dvec3 ParticleReadout::*vector>
Known length_of(Session& session) {
  const auto particle = picked_particle(session);
  return particle ? Known(glm::length((*particle).*vector)) : std::nullopt;
}
/// Of force_keys()[n].
template <std::size_t n>
Known size_of_force(Session& session) {
  const auto particle = picked_particle(session);
  return particle ? Known(glm::length(particle->forces.values[n])) : std::nullopt;
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
  const Tears& tears = session.simulation->tears();
  double sum = 0;
  for (int n = 0; n < tears.particles(); ++n) sum += tears.share(n) * y[std::size_t(n)];
  return sum / double(tears.lattice().sites().size());
}
Known lowest_height(Session& session) {
  const Array<double>& y = session.simulation->read().x.y;
  assert(!y.empty());
  return *std::min_element(y.begin(), y.begin() + session.simulation->tears().particles());
}

/// Root of the mean square of the particles' ways from where they were when the step before was completed.
Known distance_to_before(Session& session) {
  const auto& run = session.labs.run;
  if (!run || run->step == 0) return std::nullopt;
  const auto& then = run->records[run->step - 1].outcome.state;
  const State& now = session.simulation->read();
  const auto sites = std::size_t(session.simulation->lattice().sites().size());
  if (!then || std::min(then->x.x.size(), now.x.x.size()) < sites) return std::nullopt;
  return rms_distance(now, *then, sites);
}

Known pinned_particles(Session& session) {
  const Lattice lattice = session.simulation->lattice().sites();
  int count = 0;
  for (int i = 0; i < lattice.rows; ++i)
    for (int j = 0; j < lattice.columns; ++j) count += session.simulation->pinned(i, j);
  return count;
}
Known ledger_share(Session& session) {
  const auto ledger = session.simulation->ledger();
  return ledger ? Known(ledger->share()) : std::nullopt;
}
Known counted_crossings(Session& session) {
  const FoundCrossings* found = session.studies.crossings.of(session.study_moment().mark());
  return found != nullptr && found->complete ? Known(double(found->pairs)) : std::nullopt;
}
Known time_of_divergence(Session& session) {
  const auto& divergence = session.simulation->divergence();
  return divergence ? Known(divergence->t) : std::nullopt;
}

constexpr std::string_view
    limits_hint = "It is computed in a moment.",
    moment_hint = "Pause: it is then computed in a moment, for cloths of up to 128 × 128 particles.",
    study_hint = "Pause, and open the Accuracy card: it measures for a few seconds from the present moment on.",
    pick_hint = "Right-click a particle to pick it.", readings = "below the constants";

const std::array rows_but_forces{
    Observable{.name = "t",
               .unit = "s",
               .meaning = "Simulated time.",
               .place = "top bar",
               .number = [](Session& session) -> Known { return clock_time(session); }},
    Observable{.name = "steps",
               .meaning = "Steps of dt since the start.",
               .place = "top bar",
               .number = [](Session& session) -> Known { return double(session.simulation->steps()); }},
    Observable{.name = "playing",
               .meaning = "Whether the motion is running.",
               .place = "top bar",
               .word = [](const Session& session) { return said(session.pacing.playing); },
               .words = no_or_yes,
               .label = "Running",
               .asked = {"The motion is paused", "The motion runs"},
               .present = {"not yet", "it runs"}},
    Observable{.name = "diverged",
               .meaning = "Whether the simulation has diverged.",
               .place = "banner below the cloth",
               .word = [](const Session& session) { return said(session.simulation->divergence().has_value()); },
               .words = no_or_yes,
               .label = "Diverged",
               .asked = {"The simulation does not diverge", "The simulation diverges"},
               .present = {"not yet", "it has diverged"}},
    Observable{.name = "diverged_at",
               .unit = "s",
               .meaning = "Simulated time at which it diverged.",
               .hint = "It has not diverged.",
               .place = "banner below the cloth",
               .number = time_of_divergence},
    Observable{.name = "integrator",
               .meaning = "Name of the method in presets.",
               .word = [](const Session& session) -> std::string_view { return session.preset().integrator; },
               .words = integrator_names,
               .label = "Integrator"},
    Observable{.name = "engine",
               .meaning = "Engine that computes the steps.",
               .place = "top bar",
               .word = [](const Session& session) { return engine_names[std::size_t(session.preset().engine)]; },
               .words = []() -> std::span<const std::string_view> { return engine_names; },
               .label = "Engine"},
    Observable{.name = "precision",
               .meaning = "Precision of the numbers.",
               .place = "top bar",
               .word = [](const Session& session) { return precision_names[std::size_t(session.preset().precision)]; },
               .words = []() -> std::span<const std::string_view> { return precision_names; },
               .label = "Precision"},
    Observable{.name = "contact",
               .meaning = "When bodies act: when particles meet them, or at the end of the step.",
               .place = "Bodies",
               .word = [](const Session& session) -> std::string_view { return session.preset().contact; },
               .words = []() -> std::span<const std::string_view> { return contact_names; },
               .label = "Contact"},
    Observable{.name = "self",
               .meaning = "Contact of the cloth with itself.",
               .place = "Self-contact",
               .word = [](const Session& session) -> std::string_view { return session.preset().self; },
               .words = []() -> std::span<const std::string_view> { return self_names; },
               .label = "Layers"},
    Observable{.name = "tearing.mode",
               .meaning = "What an overload does.",
               .place = "Tearing",
               .word = [](const Session& session) -> std::string_view { return session.preset().tearing; },
               .words = []() -> std::span<const std::string_view> { return tearing_names; },
               .label = "Overload"},
    Observable{.name = "untouched",
               .meaning = "Whether the constants are those with which the step began, apart from those that its checks "
                          "name, and nobody has pulled or cut the cloth since the motion began.",
               .word = [](const Session& session) { return said(touched_by(session).empty()); },
               .words = no_or_yes,
               .label = "Nothing else changed",
               .asked = {"Something else changed", "Nothing else changed"}},
    Observable{.name = "dt_crit",
               .unit = "s",
               .meaning = "Largest stable dt of the method in any configuration of the springs, by linear theory.",
               .hint = limits_hint,
               .place = "gauge under dt",
               .number = crit,
               .needs = &Wants::stability,
               .measured = true},
    Observable{.name = "dt_crit_now",
               .unit = "s",
               .meaning = "Largest stable dt in the present shape of the cloth, by linear theory.",
               .hint = moment_hint,
               .place = "gauge under dt",
               .number = crit_now,
               .needs = &Wants::stability,
               .measured = true},
    Observable{.name = "k_s_crit",
               .unit = "N/m",
               .meaning = "k_s above which the method is unstable at this dt, in the worst configuration.",
               .hint = limits_hint,
               .place = "strip under k_s",
               .number = [](Session& session) { return zone_end(session, "k_s"); },
               .needs = &Wants::stability,
               .measured = true},
    Observable{.name = "k_d_crit",
               .unit = "N s/m",
               .meaning = "k_d above which the method is unstable at this dt, in the worst configuration.",
               .hint = limits_hint,
               .place = "strip under k_d",
               .number = [](Session& session) { return zone_end(session, "k_d"); },
               .needs = &Wants::stability,
               .measured = true},
    Observable{.name = "omega",
               .unit = "1/s",
               .meaning = "Largest angular frequency of the cloth in its present shape.",
               .hint = moment_hint,
               .place = "Stability card",
               .number = fastest_omega,
               .needs = &Wants::stability,
               .measured = true},
    Observable{.name = "energy",
               .unit = "J",
               .meaning = "Kinetic energy plus that of springs and height (zero at y = 0).",
               .place = "Energy card",
               .number = [](Session& session) -> Known { return session.simulation->energy().energy.total(); }},
    Observable{.name = "kinetic",
               .unit = "J",
               .meaning = "Kinetic energy.",
               .place = "Energy card",
               .number = [](Session& session) -> Known { return session.simulation->energy().energy.kinetic; }},
    Observable{.name = "made",
               .meaning = "Energy that no force explains, relative to the energy scale of the scene; above 0 the "
                          "integrator added it.",
               .hint = "Restart with R; the ledger is kept from the beginning of the motion.",
               .place = "Energy card",
               .number = ledger_share,
               .needs = &Wants::ledger},
    Observable{
        .name = "error",
        .unit = "m",
        .meaning =
            "Error (rms) of the present settings over the time shown on the Accuracy card, from the present moment on.",
        .hint = study_hint,
        .place = "Accuracy card",
        .number = present_error,
        .measured = true,
        .shown_by = &Wants::accuracy},
    Observable{.name = "agreement",
               .unit = "m",
               .meaning = "Difference between the two references on the Accuracy card.",
               .hint = study_hint,
               .place = "Accuracy card",
               .number = references_agreement,
               .measured = true,
               .shown_by = &Wants::accuracy},
    Observable{.name = "cost",
               .meaning = "CPU seconds per simulated second with the present settings.",
               .hint = study_hint,
               .place = "Accuracy card",
               .number = present_cost,
               .measured = true,
               .shown_by = &Wants::accuracy},
    Observable{
        .name = "apart",
        .unit = "m",
        .meaning = "Distance (rms over the particles) from their positions when the previous lab step was completed.",
        .hint = "Complete the previous lab step with the same cloth.",
        .number = distance_to_before,
        .label = "Distance from the cloth of the previous lab step"},
    Observable{.name = "picked",
               .meaning = "Whether a particle is picked.",
               .place = "below the constants",
               .word = [](const Session& session) { return said(session.picked.has_value()); },
               .words = no_or_yes,
               .label = "Picked",
               .asked = {"No particle is picked", "A particle is picked"},
               .present = {"not yet", "one is picked"}},
    Observable{.name = "x",
               .unit = "m",
               .meaning = "Position of the picked particle (or of the mass on a spring), to the right.",
               .hint = pick_hint,
               .place = readings,
               .number = position_of<0>},
    Observable{.name = "y",
               .unit = "m",
               .meaning = "Height of the picked particle.",
               .hint = pick_hint,
               .place = readings,
               .number = position_of<1>},
    Observable{.name = "z",
               .unit = "m",
               .meaning = "Position of the picked particle, toward the viewer.",
               .hint = pick_hint,
               .place = readings,
               .number = position_of<2>},
    Observable{.name = "v",
               .unit = "m/s",
               .meaning = "Speed of the picked particle.",
               .hint = pick_hint,
               .place = readings,
               .number = length_of<&ParticleReadout::v>},
    Observable{.name = "a",
               .unit = "m/s²",
               .meaning = "Magnitude of the acceleration of the picked particle.",
               .hint = pick_hint,
               .place = readings,
               .number = length_of<&ParticleReadout::a>},
    Observable{
        .name = "fastest", .unit = "m/s", .meaning = "Speed of the fastest particle.", .number = fastest_particle},
    Observable{.name = "mean_y", .unit = "m", .meaning = "Mean height of the particles.", .number = mean_height},
    Observable{.name = "lowest_y", .unit = "m", .meaning = "Height of the lowest particle.", .number = lowest_height},
    Observable{.name = "torn",
               .meaning = "Stretch springs that are torn or cut; where the cloth parts, particles that did.",
               .place = "bottom bar",
               .number = [](Session& session) -> Known { return double(session.simulation->tears().torn_count()); }},
    Observable{.name = "pinned", .meaning = "Pinned particles.", .number = pinned_particles},
    Observable{.name = "particles",
               .meaning = "Particles, with those that were added where the cloth parted.",
               .number = [](Session& session) -> Known { return double(session.simulation->tears().particles()); }},
    Observable{.name = "area",
               .unit = "m²",
               .meaning = "Area of the whole triangles.",
               .number = [](Session& session) -> Known { return cloth_area(*session.simulation); },
               .label = "Area of the cloth"},
    Observable{.name = "crossings",
               .meaning = "Pairs of triangles that cross or touch each other.",
               .hint = "Pause: they are then counted in a moment.",
               .place = "Performance card",
               .number = counted_crossings,
               .needs = &Wants::crossings,
               .measured = true},
    Observable{.name = "held_back",
               .meaning = "Moves of particles that the guard has cut short since the start.",
               .place = "Performance card",
               .number = [](Session& session) -> Known { return double(session.simulation->engine().held_back()); },
               .label = "Moves cut short by the guard"},
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
  assert(place.row != nullptr && place.component >= 0 && place.component < 3);
  if (is_absent(*place.row, preset)) return constant_value(constant_place(place.row->otherwise), preset);
  if (const auto* number = std::get_if<double Preset::*>(&place.row->field)) return preset.**number;
  if (const auto* integer = std::get_if<int Preset::*>(&place.row->field)) return preset.**integer;
  return (preset.*std::get<glm::dvec3 Preset::*>(place.row->field))[place.component];
}

/// One for each force.
template <std::size_t... n>
std::vector<Observable> with_forces(std::index_sequence<n...>) {
  static const std::array<std::string, sizeof...(n)> meanings{
      (std::string(variable(force_keys()[n]).quantity) + " on the picked particle, its magnitude.")...};
  std::vector<Observable> all(rows_but_forces.begin(), rows_but_forces.end());
  (all.push_back({.name = force_keys()[n],
                  .unit = "N",
                  .meaning = meanings[n],
                  .hint = pick_hint,
                  .place = readings,
                  .number = size_of_force<n>}),
   ...);
  return all;
}

const std::vector<Observable>& all_rows() {
  static const std::vector<Observable> all = with_forces(std::make_index_sequence<force::all.size() + 3>());
  return all;
}

}  // namespace

std::span<const Observable> observables() {
  return all_rows();
}

const Observable* find_observable(std::string_view name) {
  const auto row =
      std::find_if(all_rows().begin(), all_rows().end(), [&](const Observable& o) { return o.name == name; });
  return row == all_rows().end() ? nullptr : &*row;
}

bool is_observable(std::string_view name) {
  return find_observable(name) != nullptr || constant_place(name).row != nullptr;
}

bool is_word(std::string_view name) {
  const Observable* row = find_observable(name);
  return row != nullptr && row->word != nullptr;
}

bool is_measured(std::string_view name) {
  const Observable* row = find_observable(name);
  return row != nullptr && row->measured;
}

std::string place_of(std::string_view name) {
  if (const Observable* row = find_observable(name)) return std::string(row->place);
  const PresetRow* row = constant_place(name).row;
  if (row == nullptr) return {};
  return std::string(heading_of(*row));
}

std::string_view unit_of(std::string_view name) {
  if (const Observable* row = find_observable(name)) return row->unit;
  const PresetRow* row = constant_place(name).row;
  return row != nullptr ? row->unit : std::string_view();
}

std::vector<std::string_view> observable_names() {
  std::vector<std::string_view> names;
  for (const Observable& row : all_rows()) names.push_back(row.name);
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
  for (const Observable& row : all_rows()) {
    out << "| `" << row.name << "` | " << (row.unit.empty() ? "–" : row.unit) << " | " << row.meaning;
    if (row.words != nullptr && row.name != "integrator") {
      out << " One of";
      for (const std::string_view word : row.words()) out << " `" << word << "`";
      out << '.';
    }
    if (!row.hint.empty() && row.number != nullptr) out << " If unknown: " << row.hint;
    out << " |\n";
  }
  return out.str();
}

}  // namespace tyglab
