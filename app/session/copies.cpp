#include "app/session/copies.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <map>
#include <span>

#include "app/ui/app.h"
#include "app/ui/cards/cards.h"
#include "core/engines/opencl/opencl_devices.h"
#include "core/integrators/scheme.h"
#include "core/model/readable.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

void say(App& app, const std::vector<std::string>& gone) {
  for (const std::string& sentence : gone) app.messages.warning(sentence);
  if (gone.empty()) return;
  app.copies.reference = Copies::original;
  app.copies.forget();
  app.redraw_cloth = true;
}

/// "k_s = 80", or of a method its title alone.
std::string spoken(const Difference& difference, int digits = 6) {
  if (const auto* method = difference.value_of(&Preset::integrator)) return std::string(scheme(*method).title);
  if (const auto* engine = difference.value_of(&Preset::engine)) return *engine == EngineKind::cpu ? "CPU" : "OpenCL";
  if (const auto* precision = difference.value_of(&Preset::precision)) return std::string(name_of(*precision));
  return difference.key() + " = " + difference.value_text(digits);
}

/// What the original has where its copies differ from it: its method first, the rest by key.
std::string name_of_original(const App& app) {
  std::map<std::string, Difference> own;
  for (std::size_t n = 0; n < app.copies.lockstep.size(); ++n)
    for (const Difference& difference : app.copies.lockstep[n].differences)
      if (const auto here = difference.in(app.preset())) own.emplace(here->key(), *here);
  std::string name(scheme(app.preset().integrator).title);
  for (const auto& [key, here] : own)
    if (!here.value_of(&Preset::integrator) && !here.value_of(&Preset::tolerance)) name += ", " + spoken(here, 4);
  return name;
}

/// Whether a copy's method runs on the CPU engine alone.
bool needs_cpu(std::span<const Difference> differences) {
  return std::any_of(differences.begin(), differences.end(), [](const Difference& difference) {
    const std::string* method = difference.value_of(&Preset::integrator);
    return method != nullptr && !runs_on_opencl(scheme(*method));
  });
}

}  // namespace

Simulation& cloth_of(App& app, int n) {
  return n == Copies::original ? *app.simulation : *app.copies.lockstep[std::size_t(n)].simulation;
}

const Simulation& cloth_of(const App& app, int n) {
  return n == Copies::original ? *app.simulation : *app.copies.lockstep[std::size_t(n)].simulation;
}

std::string name_of_cloth(const App& app, int n) {
  if (n == Copies::original) return name_of_original(app);
  std::string name;
  for (const Difference& difference : app.copies.lockstep[std::size_t(n)].differences)
    name += (name.empty() ? "" : ", ") + spoken(difference);
  return name.empty() ? "equal copy" : name;
}

CurveStyle style_of_cloth(const App& app, int n) {
  const Tokens& c = app.theme.colors;
  static constexpr std::array<ImU32 Tokens::*, Lockstep::most> colors{&Tokens::orange, &Tokens::green, &Tokens::magenta,
                                                                      &Tokens::yellow, &Tokens::vermilion};
  static constexpr std::array<LineStyle, Lockstep::most> lines{
      LineStyle::dashed, LineStyle::long_dash, LineStyle::dotted, LineStyle::dash_dot, LineStyle::sparse_dots};
  if (n == Copies::original) return {c.sky, LineStyle::solid, 2};
  const std::size_t seat = app.copies.lockstep[std::size_t(n)].seat;
  return {c.*colors[seat], lines[seat], 2};
}

std::vector<CopyChoice> copy_choices(const Preset& preset) {
  const bool single = preset.precision == Precision::float_, cpu = preset.engine == EngineKind::cpu;
  std::vector<CopyChoice> choices{{.label = "Reference: Dormand-Prince, error 1e-9 m a step",
                                   .differences = {{&Preset::integrator, "dopri5"},
                                                   {&Preset::tolerance, 1e-9},
                                                   {&Preset::precision, Precision::double_}},
                                   .reference = true},
                                  {.label = "Equal copy", .differences = {}}};
  const auto add = [&](std::string label, Difference difference, int group) {
    choices.push_back({std::move(label), {std::move(difference)}, group});
  };
  for (const Scheme& method : schemes())
    if (method.name != preset.integrator)
      add(std::string(method.title), {&Preset::integrator, std::string(method.name)}, 1);
  const auto with_dt = [&](const char* label, double dt) {
    add(label + short_number(dt) + " s", {&Preset::dt, rounded(dt, 6)}, 2);
  };
  with_dt("dt / 2 = ", preset.dt / 2), with_dt("dt · 2 = ", preset.dt * 2);
  const Precision other = single ? Precision::double_ : Precision::float_;
  add(std::string(name_of(other)), {&Preset::precision, other}, 2);
  if (!cpu) add("CPU", {&Preset::engine, EngineKind::cpu}, 2);
  if (cpu && runs_on_opencl(scheme(preset.integrator))) add("OpenCL", {&Preset::engine, EngineKind::opencl}, 2);
  for (CopyChoice& choice : choices)
    if (!cpu && needs_cpu(choice.differences)) choice.differences.emplace_back(&Preset::engine, EngineKind::cpu);
  return choices;
}

void add_copy(App& app, const std::vector<Difference>& differences, bool as_reference) {
  Copies& copies = app.copies;
  if (app.building.busy()) return app.messages.note("Another cloth is being built; add a copy when it is there.");
  try {
    copies.lockstep.add(*app.simulation, differences, app.threads);
  } catch (const std::exception& error) {
    return app.messages.error(error.what());
  }
  if (as_reference) copies.reference = int(copies.lockstep.size()) - 1;
  copies.t = app.simulation->time();
  copies.forget();
  app.tool.kind = Tool::Kind::none;  // all have been loaded anew, and the hand has let go
  app.settings.layout.folded.erase(card_name::copies);
  if (!in_front(app, card_name::copies)) app.ui.plots.wanted = card_name::distances;
  app.redraw_cloth = true;
}

void remove_copy(App& app, std::size_t n) {
  Copies& copies = app.copies;
  if (n >= copies.lockstep.size()) return;
  copies.lockstep.remove(n);
  app.views.forget_copies();
  if (copies.reference == int(n)) copies.reference = Copies::original;
  if (copies.reference > int(n)) --copies.reference;
  copies.forget();
  app.tool.kind = Tool::Kind::none;
  app.redraw_cloth = true;
}

bool put_away_copies(App& app) {
  Copies& copies = app.copies;
  if (copies.lockstep.empty()) return false;
  copies.lockstep.clear();
  app.views.forget_copies();
  copies.reference = Copies::original;
  copies.forget();
  app.tool.kind = Tool::Kind::none;
  return app.redraw_cloth = true;
}

void copies_apply(App& app, const Edit& edit) {
  Copies& copies = app.copies;
  if (copies.lockstep.empty()) return;
  say(app, copies.lockstep.apply(*app.simulation, edit));
  if (!std::holds_alternative<edit::Restart>(edit)) return;
  copies.t = app.simulation->time();
  copies.forget();
}

void copies_resume(App& app) {
  if (app.copies.lockstep.empty()) return;
  app.views.forget_copies();
  say(app, app.copies.lockstep.resume(*app.simulation, app.threads));
  app.copies.t = app.simulation->time();
  app.copies.forget();
}

void copies_follow(App& app, double wall_s) {
  Copies& copies = app.copies;
  if (copies.lockstep.empty()) return;
  const double t = app.simulation->time();
  copies.cost.add(t - copies.t, wall_s);
  copies.t = t;
  copies.lockstep.follow(t);
}

int copies_go_on(App& app, int steps) {
  const double dt = app.preset().dt;
  const auto start = std::chrono::steady_clock::now();
  app.copies.t += steps * dt;
  app.copies.lockstep.follow(app.copies.t);
  app.pacing.made(steps, dt, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  return steps;
}

void sample_copies(App& app) {
  Copies& copies = app.copies;
  if (copies.lockstep.empty()) return;
  std::array<double, 1 + Lockstep::most> distance, energy;
  distance.fill(std::numeric_limits<double>::quiet_NaN());
  energy.fill(std::numeric_limits<double>::quiet_NaN());
  Simulation& reference = cloth_of(app, copies.reference);
  for (int n = Copies::original; n < int(copies.lockstep.size()); ++n) {
    Simulation& cloth = cloth_of(app, n);
    if (cloth.divergence()) continue;
    distance[std::size_t(n + 1)] = rms_distance(cloth, reference);
    energy[std::size_t(n + 1)] = cloth.energy().energy.total();
  }
  copies.distance.add(copies.t, distance);
  copies.energy.add(copies.t, energy);
}

}  // namespace tyglab
