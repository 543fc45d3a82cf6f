#include "app/session/copies.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <limits>
#include <map>
#include <span>

#include "app/session/session.h"
#include "core/engines/opencl/opencl_devices.h"
#include "core/integrators/scheme.h"
#include "core/io/preset_io.h"
#include "core/model/effect.h"
#include "core/model/notation.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

void say(Session& session, const std::vector<std::string>& gone) {
  for (const std::string& sentence : gone) session.messages.warning(sentence);
  if (gone.empty()) return;
  session.copies.reference = Copies::original;
  session.copies.forget();
  ++session.counts.cloths;
}

/// "k_s = 80", or of a method its title alone.
std::string spoken(const Difference& difference, int digits = 6) {
  if (const auto* method = difference.value_of(&Preset::integrator)) return std::string(scheme(*method).title);
  if (const auto* engine = difference.value_of(&Preset::engine)) return std::string(title_of(*engine));
  if (const auto* precision = difference.value_of(&Preset::precision)) return std::string(name_of(*precision));
  return difference.key() + " = " + difference.value_text(digits);
}

/// What the original has where its copies differ from it: its method first, the rest by key.
std::string name_of_original(const Session& session) {
  std::map<std::string, Difference> own;
  for (std::size_t n = 0; n < session.copies.lockstep.size(); ++n)
    for (const Difference& difference : session.copies.lockstep[n].differences)
      if (const auto here = difference.in(session.preset())) own.emplace(here->key(), *here);
  std::string name(scheme(session.preset().integrator).title);
  for (const auto& [key, here] : own)
    if (!here.value_of(&Preset::integrator) && !here.value_of(&Preset::tolerance)) name += ", " + spoken(here, 4);
  return name;
}

/// A method whose own tolerance keeps its error far below that of any other that is watched beside it.
std::vector<Difference> accurate_settings() {
  return {{&Preset::integrator, "dopri5"}, {&Preset::tolerance, 1e-9}, {&Preset::precision, Precision::double_}};
}

/// Where the original needs it, the engine is one more.
bool is_accurate_solution(std::span<const Difference> differences) {
  const std::vector<Difference> accurate = accurate_settings();
  const auto same = [](const Difference& a, const Difference& b) { return a.text() == b.text(); };
  return differences.size() >= accurate.size() &&
         std::equal(accurate.begin(), accurate.end(), differences.begin(), same) &&
         std::all_of(differences.begin() + std::ptrdiff_t(accurate.size()), differences.end(),
                     [](const Difference& more) { return more.value_of(&Preset::engine) != nullptr; });
}

/// Whether a copy's method, or a force with it, runs only on the CPU engine.
bool needs_cpu(const Preset& original, std::span<const Difference> differences) {
  return std::any_of(differences.begin(), differences.end(), [&](const Difference& difference) {
    Preset copy = original;
    const std::string* method = difference.value_of(&Preset::integrator);
    if (method != nullptr) copy.integrator = *method;
    return method != nullptr && (!runs_on_opencl(scheme(*method)) || missing_on_opencl(copy) != nullptr);
  });
}

/// Whether a copy would make its OpenCL device build programs; they are built beside the frames from then on.
bool awaits_programs(Session& session, const std::vector<Difference>& differences, bool as_reference) {
  const auto& prepare = session.rebuild.prepare_programs;
  if (!prepare || session.scripted) return false;
  Preset preset = session.preset();
  for (const Difference& difference : differences)
    if (!difference.apply(preset)) return false;  // who adds it says what is wrong
  if (preset.engine != EngineKind::opencl || !check_preset(preset).empty()) return false;
  Copies& copies = session.copies;
  if (copies.awaited && changes(copies.awaited->built_for, preset).within(motionless)) return false;
  const bool same_device = !changes(session.preset(), preset).touches({Effect::engine, Effect::device});
  if (same_device && session.simulation->engine().ready_for(preset)) return false;
  copies.awaited = Copies::Awaited{differences, as_reference, preset};
  copies.programs.start(Priority::normal, [prepare, preset](const JobControl&) {
    prepare(preset, false);
    return std::monostate();
  });
  return true;
}

/// All that brings a copy back.
CopyChange remembered(const Session& session, std::size_t n) {
  const Copies& copies = session.copies;
  const Lockstep::Copy& copy = copies.lockstep[n];
  return {copy.differences,
          n,
          copy.seat,
          copies.reference == int(n),
          copy.cost,
          copy.simulation->divergence().has_value(),
          std::make_shared<const Snapshot>(copy.simulation->snapshot())};
}

/// Stores how to undo the removal of a copy, which is still there, or its addition.
void record(Session& session, const char* what, std::size_t n, bool removal) {
  CopyChange change = remembered(session, n);
  if (!removal) change.motion.reset();
  HistoryEntry entry{session.requested_preset(), session.copies.t, what + name_of_cloth(session, int(n)) + ")"};
  entry.copy = std::make_shared<const CopyChange>(std::move(change));
  session.history.record(std::move(entry), 0);
}

void take_away(Session& session, std::size_t n) {
  Copies& copies = session.copies;
  copies.lockstep.remove(n);
  ++session.counts.copies;
  if (copies.reference == int(n)) copies.reference = Copies::original;
  if (copies.reference > int(n)) --copies.reference;
  assert(copies.reference >= Copies::original && copies.reference < int(copies.lockstep.size()));
  copies.forget();
  ++session.counts.hands, ++session.counts.cloths;
}

/// Makes the steps that a copy has missed, if that is quick; otherwise it starts from the original. Returns whether it
/// has its own motion.
bool catch_up(Session& session, const CopyChange& change, std::size_t n) {
  constexpr double quick_s = 0.1;  // of a frame
  Copies& copies = session.copies;
  Simulation& copy = *copies.lockstep[n].simulation;
  const double missed = copies.t - copy.time(), ahead = 0.5 * copy.preset().dt;
  if (change.diverged && missed > -ahead) copy.advance(1);
  if (copy.divergence()) return true;
  if (missed < -ahead || missed * change.cost.per_second() > quick_s) {
    copy.restore(session.simulation->snapshot());
    return false;
  }
  copies.lockstep.follow(copies.t);
  return true;
}

/// Returns whether the copy has its own motion again.
bool put_back(Session& session, const CopyChange& change) {
  Copies& copies = session.copies;
  if (session.simulation->held()) apply_to_all(session, edit::Release{});
  const bool first = copies.lockstep.empty(), fits = session.simulation->fits(*change.motion);
  const Snapshot now = fits ? *change.motion : session.simulation->snapshot();
  const std::size_t n = std::min(change.index, copies.lockstep.size());
  // Without copies nobody has counted on past a divergence.
  if (first) copies.t = session.simulation->time();
  copies.lockstep.put_back(*session.simulation, n, change.differences, change.seat, change.cost, now, session.threads);
  if (copies.reference >= int(n)) ++copies.reference;
  if (change.reference) copies.reference = int(n);
  copies.forget();
  ++session.counts.hands, ++session.counts.cloths, ++session.counts.copies_added;
  return fits && catch_up(session, change, n);
}

void add_now(Session& session, const std::vector<Difference>& differences, bool as_reference) {
  Copies& copies = session.copies;
  settle(session);
  try {
    copies.lockstep.add(*session.simulation, differences, session.threads);
  } catch (const std::exception& error) {
    return session.messages.error(error.what());
  }
  assert(!copies.lockstep.empty() && copies.lockstep.size() <= Lockstep::most);
  record(session, "new copy (", copies.lockstep.size() - 1, false);
  if (as_reference) copies.reference = int(copies.lockstep.size()) - 1;
  copies.t = session.simulation->time();
  copies.forget();
  // All have been loaded again, and the hand has let go.
  ++session.counts.hands, ++session.counts.cloths, ++session.counts.copies_added;
}

}  // namespace

Simulation& cloth_of(const Session& session, int n) {
  assert(n >= Copies::original && n < int(session.copies.lockstep.size()));
  return n == Copies::original ? *session.simulation : *session.copies.lockstep[std::size_t(n)].simulation;
}

std::optional<std::size_t> seat_of_style(const Session& session, int n) {
  assert(n >= Copies::original && n < int(session.copies.lockstep.size()));
  for (int before = Copies::original; before < n; ++before)
    if (cloth_of(session, before).preset().integrator == cloth_of(session, n).preset().integrator)
      return session.copies.lockstep[std::size_t(n)].seat;
  return std::nullopt;
}

std::string name_of_cloth(const Session& session, int n) {
  const bool accurate =
      n != Copies::original && is_accurate_solution(session.copies.lockstep[std::size_t(n)].differences);
  return accurate ? "accurate solution" : settings_of_cloth(session, n);
}

std::string settings_of_cloth(const Session& session, int n) {
  if (n == Copies::original) return name_of_original(session);
  const auto& differences = session.copies.lockstep[std::size_t(n)].differences;
  if (differences.empty()) return "equal copy";
  return joined(differences, ", ", [](const Difference& difference) { return spoken(difference); });
}

std::vector<CopyChoice> copy_choices(const Preset& preset) {
  const bool single = preset.precision == Precision::float_, cpu = preset.engine == EngineKind::cpu;
  std::vector<CopyChoice> choices{{.label = "Accurate solution: Dormand-Prince 5(4), tolerance 1e-9 m",
                                   .differences = accurate_settings(),
                                   .reference = true},
                                  {.label = "Equal copy", .differences = {}}};
  const auto add = [&](std::string label, Difference difference, std::string_view group) {
    choices.push_back({std::move(label), {std::move(difference)}, group});
  };
  for (const Scheme& method : schemes())
    if (method.name != preset.integrator)
      add(std::string(method.title), {&Preset::integrator, std::string(method.name)}, "Method");
  const auto with_dt = [&](const char* label, double dt) {
    add(label + short_number(dt) + " s", {&Preset::dt, rounded(dt, 6)}, "Step");
  };
  with_dt("dt / 2 = ", preset.dt / 2), with_dt("dt · 2 = ", preset.dt * 2);
  const Precision other = single ? Precision::double_ : Precision::float_;
  add(std::string(name_of(other)), {&Preset::precision, other}, "Precision");
  if (!cpu) add("CPU", {&Preset::engine, EngineKind::cpu}, "Engine");
  if (cpu && runs_on_opencl(scheme(preset.integrator)) && missing_on_opencl(preset) == nullptr)
    add("OpenCL", {&Preset::engine, EngineKind::opencl}, "Engine");
  for (CopyChoice& choice : choices)
    if (!cpu && needs_cpu(preset, choice.differences))
      choice.differences.emplace_back(&Preset::engine, EngineKind::cpu);
  return choices;
}

void add_copy(Session& session, const std::vector<Difference>& differences, bool as_reference) {
  if (session.rebuild.busy())
    return session.messages.note("Another cloth is being built; add a copy once it is ready.");
  if (session.copies.awaited)
    return session.messages.note("Programs for another copy are being built; add this one when that is done.");
  if (awaits_programs(session, differences, as_reference))
    return session.messages.note("OpenCL is building its programs; the copy appears when they are ready.");
  add_now(session, differences, as_reference);
}

void poll_copies(Session& session) {
  Copies& copies = session.copies;
  if (!copies.programs.ready() || session.rebuild.busy()) return;
  const auto outcome = copies.programs.take();
  if (!copies.awaited) return;
  const auto* error = std::get_if<JobError>(&outcome);
  const Copies::Awaited made = *copies.awaited;
  // The constants may have changed meanwhile.
  if (error == nullptr && awaits_programs(session, made.differences, made.as_reference)) return;
  copies.awaited.reset();
  if (error != nullptr) return session.messages.error(error->what);
  add_now(session, made.differences, made.as_reference);
}

void remove_copy(Session& session, std::size_t n) {
  if (n >= session.copies.lockstep.size()) return;
  settle(session);
  record(session, "removal of the copy (", n, true);
  take_away(session, n);
}

CopyChange undo_copy_change(Session& session, const CopyChange& change, std::string& said) {
  settle(session);
  Copies& copies = session.copies;
  if (change.motion) {
    if (!put_back(session, change)) said += ". The copy starts from the present cloth";
    CopyChange added = change;
    added.motion.reset();
    return added;
  }
  for (std::size_t n = 0; n < copies.lockstep.size(); ++n)
    if (copies.lockstep[n].seat == change.seat) {
      CopyChange removed = remembered(session, n);
      take_away(session, n);
      return removed;
    }
  said += ". The copy had gone already";
  return change;
}

bool put_away_copies(Session& session) {
  Copies& copies = session.copies;
  copies.awaited.reset();
  if (copies.lockstep.empty()) return false;
  settle(session);
  copies.lockstep.clear();
  ++session.counts.copies;
  copies.reference = Copies::original;
  copies.forget();
  ++session.counts.hands, ++session.counts.cloths;
  return true;
}

void copies_apply(Session& session, const Edit& edit) {
  Copies& copies = session.copies;
  if (copies.lockstep.empty()) return;
  say(session, copies.lockstep.apply(*session.simulation, edit));
  if (!std::holds_alternative<edit::Restart>(edit)) return;
  copies.t = session.simulation->time();
  copies.forget();
}

void copies_resume(Session& session) {
  if (session.copies.lockstep.empty()) return;
  ++session.counts.copies;
  say(session, session.copies.lockstep.resume(*session.simulation, session.threads));
  session.copies.t = session.simulation->time();
  session.copies.forget();
}

void copies_note(Session& session, double t, double computing_s) {
  assert(!(computing_s < 0));
  Copies& copies = session.copies;
  if (copies.lockstep.empty()) return;
  copies.cost.add(t - copies.t, computing_s);
  copies.t = t;
}

void copies_follow(Session& session, double computing_s) {
  copies_note(session, session.simulation->time(), computing_s);
  session.copies.lockstep.follow(session.copies.t);
}

int copies_go_on(Session& session, int steps) {
  assert(steps >= 0 && session.simulation->divergence());
  if (BackgroundSteps::wanted(session)) return session.background_steps.start(session, steps), 0;
  const double dt = session.preset().dt;
  const auto start = std::chrono::steady_clock::now();
  session.copies.t += steps * dt;
  session.copies.lockstep.follow(session.copies.t);
  session.pacing.made(steps, dt, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  return steps;
}

void sample_copies(Session& session) {
  Copies& copies = session.copies;
  if (copies.lockstep.empty()) return;
  std::array<double, 1 + Lockstep::most> distance, energy;
  distance.fill(std::numeric_limits<double>::quiet_NaN());
  energy.fill(std::numeric_limits<double>::quiet_NaN());
  Simulation& reference = cloth_of(session, copies.reference);
  for (int n = Copies::original; n < int(copies.lockstep.size()); ++n) {
    Simulation& cloth = cloth_of(session, n);
    if (cloth.divergence()) continue;
    distance[std::size_t(n + 1)] = rms_distance(cloth, reference);
    energy[std::size_t(n + 1)] = cloth.energy().energy.total();
  }
  copies.distance.add(copies.t, distance);
  copies.energy.add(copies.t, energy);
}

}  // namespace tyglab
