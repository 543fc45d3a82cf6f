#include "app/session/copies.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <set>

#include "app/session/session.h"
#include "core/engines/opencl/opencl_devices.h"
#include "core/integrators/scheme.h"
#include "core/io/preset_io.h"
#include "core/model/notation.h"
#include "core/model/readable.h"
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
std::string spoken(const std::string& setting) {
  const Setting parsed = parse_setting(setting);
  if (parsed.key == "integrator") return std::string(scheme(parsed.value).title);
  if (parsed.key == "engine") return parsed.value == "cpu" ? "CPU" : "OpenCL";
  if (parsed.key == "precision") return parsed.value;
  return parsed.key + " = " + parsed.value;
}

/// What a constant is in the original, as a setting.
std::string present(const Preset& preset, const std::string& key) {
  if (key == "integrator") return key + "=" + preset.integrator;
  if (key == "engine") return key + "=" + std::string(name_of(preset.engine));
  if (key == "precision") return key + "=" + std::string(name_of(preset.precision));
  const PresetRow* row = find_row(key);
  if (row == nullptr) return {};
  const auto* number = std::get_if<double Preset::*>(&row->field);
  return number != nullptr ? key + "=" + short_number(preset.**number) : "";
}

/// Whether a copy's method runs on the CPU engine alone.
bool needs_cpu(const std::vector<std::string>& differences) {
  return std::any_of(differences.begin(), differences.end(), [](const std::string& difference) {
    const Setting setting = parse_setting(difference);
    return setting.key == "integrator" && !runs_on_opencl(scheme(setting.value));
  });
}

}  // namespace

Simulation& cloth_of(const Session& session, int n) {
  return n == Copies::original ? *session.simulation : *session.copies.lockstep[std::size_t(n)].simulation;
}

std::optional<std::size_t> seat_of_cloth(const Session& session, int n) {
  if (n == Copies::original) return std::nullopt;
  return session.copies.lockstep[std::size_t(n)].seat;
}

std::string name_of_cloth(const Session& session, int n) {
  std::string name;
  const auto add = [&](const std::string& setting) {
    if (!setting.empty()) name += (name.empty() ? "" : ", ") + spoken(setting);
  };
  const Lockstep& lockstep = session.copies.lockstep;
  if (n != Copies::original) {
    for (const std::string& difference : lockstep[std::size_t(n)].differences) add(difference);
    return name.empty() ? "equal copy" : name;
  }
  std::set<std::string> keys{"integrator"};
  for (std::size_t k = 0; k < lockstep.size(); ++k)
    for (const std::string& difference : lockstep[k].differences) keys.insert(parse_setting(difference).key);
  add(present(session.preset(), "integrator"));
  for (const std::string& key : keys)
    if (key != "integrator" && key != "tolerance") add(present(session.preset(), key));
  return name;
}

std::vector<CopyChoice> copy_choices(const Preset& preset) {
  const bool single = preset.precision == Precision::float_, cpu = preset.engine == EngineKind::cpu;
  std::vector<CopyChoice> choices{{.label = "Reference: Dormand-Prince, error 1e-9 m a step",
                                   .differences = {"integrator=dopri5", "tolerance=1e-9", "precision=double"},
                                   .reference = true},
                                  {.label = "Equal copy", .differences = {}}};
  for (const Scheme& method : schemes())
    if (method.name != preset.integrator)
      choices.push_back({std::string(method.title), {"integrator=" + std::string(method.name)}, 1});
  const auto with_dt = [&](const char* label, double dt) {
    choices.push_back({label + short_number(dt) + " s", {"dt=" + short_number(dt, 6)}, 2});
  };
  with_dt("dt / 2 = ", preset.dt / 2), with_dt("dt · 2 = ", preset.dt * 2);
  choices.push_back({single ? "double" : "float", {single ? "precision=double" : "precision=float"}, 2});
  if (!cpu) choices.push_back({"CPU", {"engine=cpu"}, 2});
  if (cpu && runs_on_opencl(scheme(preset.integrator))) choices.push_back({"OpenCL", {"engine=opencl"}, 2});
  for (CopyChoice& choice : choices)
    if (!cpu && needs_cpu(choice.differences)) choice.differences.emplace_back("engine=cpu");
  return choices;
}

void add_copy(Session& session, const std::vector<std::string>& differences, bool as_reference) {
  Copies& copies = session.copies;
  if (session.rebuild.busy())
    return session.messages.note("Another cloth is being built; add a copy when it is there.");
  try {
    copies.lockstep.add(*session.simulation, differences, session.threads);
  } catch (const std::exception& error) {
    return session.messages.error(error.what());
  }
  if (as_reference) copies.reference = int(copies.lockstep.size()) - 1;
  copies.t = session.simulation->time();
  copies.forget();
  // All have been loaded anew, and the hand has let go.
  ++session.counts.hands, ++session.counts.cloths, ++session.counts.copies_added;
}

void remove_copy(Session& session, std::size_t n) {
  Copies& copies = session.copies;
  if (n >= copies.lockstep.size()) return;
  copies.lockstep.remove(n);
  ++session.counts.copies;
  if (copies.reference == int(n)) copies.reference = Copies::original;
  if (copies.reference > int(n)) --copies.reference;
  copies.forget();
  ++session.counts.hands, ++session.counts.cloths;
}

bool put_away_copies(Session& session) {
  Copies& copies = session.copies;
  if (copies.lockstep.empty()) return false;
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

void copies_follow(Session& session, double wall_s) {
  Copies& copies = session.copies;
  if (copies.lockstep.empty()) return;
  const double t = session.simulation->time();
  copies.cost.add(t - copies.t, wall_s);
  copies.t = t;
  copies.lockstep.follow(t);
}

int copies_go_on(Session& session, int steps) {
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
