#include "app/session/copies.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <set>

#include "app/ui/app.h"
#include "app/ui/cards/cards.h"
#include "core/engines/opencl/opencl_devices.h"
#include "core/integrators/scheme.h"
#include "core/io/preset_io.h"
#include "core/model/notation.h"
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

Simulation& cloth_of(App& app, int n) {
  return n == Copies::original ? *app.simulation : *app.copies.lockstep[std::size_t(n)].simulation;
}

const Simulation& cloth_of(const App& app, int n) {
  return n == Copies::original ? *app.simulation : *app.copies.lockstep[std::size_t(n)].simulation;
}

std::string name_of_cloth(const App& app, int n) {
  std::string name;
  const auto add = [&](const std::string& setting) {
    if (!setting.empty()) name += (name.empty() ? "" : ", ") + spoken(setting);
  };
  const Lockstep& lockstep = app.copies.lockstep;
  if (n != Copies::original) {
    for (const std::string& difference : lockstep[std::size_t(n)].differences) add(difference);
    return name.empty() ? "equal copy" : name;
  }
  std::set<std::string> keys{"integrator"};
  for (std::size_t k = 0; k < lockstep.size(); ++k)
    for (const std::string& difference : lockstep[k].differences) keys.insert(parse_setting(difference).key);
  add(present(app.preset(), "integrator"));
  for (const std::string& key : keys)
    if (key != "integrator" && key != "tolerance") add(present(app.preset(), key));
  return name;
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

void add_copy(App& app, const std::vector<std::string>& differences, bool as_reference) {
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
