#include "tests/fuzz/run_case.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>
#include <variant>

#include "core/contact/self_contact.h"
#include "core/engines/newton.h"
#include "core/engines/opencl/opencl_devices.h"
#include "core/forces/parted.h"
#include "core/integrators/scheme.h"
#include "core/io/preset_io.h"
#include "core/model/notation.h"
#include "core/model/words.h"

namespace tyglab::fuzz {
namespace {

using test::Random;

const std::vector<std::string> all_outputs{"values", "series", "ledger", "pc2", "obj"};

/// Ends of the range, 0, and what lies between on a logarithmic scale.
double extreme(Random& random, double min, double max, double usual) {
  const double tiny = std::max(std::abs(max), std::abs(min)) * std::pow(10, random.uniform(-15, 0));
  switch (random.below(6)) {
    case 0:
      return min;
    case 1:
      return max;
    case 2:
      return std::clamp(0.0, min, max);
    case 3:
      return std::clamp(min < 0 && random.below(2) == 0 ? -tiny : tiny, min, max);
    default:
      return std::clamp(usual * std::pow(10, random.uniform(-3, 3)), min, max);
  }
}

template <class T>
void make_extreme(Random& random, const Row<T>& row, T& object) {
  std::visit(
      [&](auto field) {
        auto& value = object.*field;
        using Value = std::decay_t<decltype(value)>;
        if constexpr (std::is_same_v<Value, glm::dvec3>) {
          for (int c = 0; c < 3; ++c)
            if (random.below(2) == 0) value[c] = extreme(random, row.min, row.max, value[c] == 0 ? 1e-3 : value[c]);
        } else if constexpr (std::is_same_v<Value, double>) {
          value = extreme(random, row.min, row.max, value == 0 ? 1 : value);
        } else if constexpr (std::is_same_v<Value, int>) {
          value = int(extreme(random, row.min, row.max, value));
        }
      },
      row.field);
}

int length(Random& random) {
  constexpr int odd[]{1, 1, 2, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 33, 63, 64};
  return odd[random.below(int(std::size(odd)))];
}

void choose_sites(Random& random, const Preset& preset, Pins::Mode& mode, std::vector<Pins::Site>& list) {
  mode = Pins::Mode(random.below(int(Pins::Mode::list) + 1));
  if (mode != Pins::Mode::list) return;
  for (int n = random.below(6); n > 0; --n) {
    const Pins::Site site{random.below(preset.rows), random.below(preset.columns)};
    if (std::find(list.begin(), list.end(), site) == list.end()) list.push_back(site);
  }
}

Pins pins(Random& random, const Preset& preset) {
  Pins out;
  choose_sites(random, preset, out.mode, out.list);
  for (int n = std::max(0, random.below(5) - 2); n > 0; --n) {
    Pins::Motion& motion = out.motions.emplace_back();
    choose_sites(random, preset, motion.mode, motion.list);
    for (double t = 0; random.below(4) != 0; t += std::pow(10, random.uniform(-4, 0)))
      motion.path.push_back({t, {extreme(random, -1000, 1000, 0.1), random.uniform(-1, 1), random.uniform(-1, 1)}});
    for (int c = 0; c < 3; ++c)
      if (random.below(3) == 0) motion.spin[c] = extreme(random, -1000, 1000, 1);
    if (random.below(2) == 0) motion.center = preset.x_0 * 0.1;
    if (random.below(2) == 0) motion.until = extreme(random, 0, 1000, 0.1);
  }
  return out;
}

void add_bodies(Random& random, Preset& preset) {
  for (int n = random.below(4); n > 0; --n) {
    Body& body = preset.bodies.emplace_back();
    body.shape = Body::Shape(random.below(int(shape_names.size())));
    body.c = preset.x_0, body.y = random.uniform(-1, 2);
    for (const BodyRow& row : body_notation())
      if (random.below(3) == 0) make_extreme(random, row, body);
  }
}

/// A free cloth whose springs tear at once, at a dt that may be above every limit.
void make_tear(Random& random, Preset& preset) {
  preset.kind = Kind::cloth, preset.pins = {Pins::Mode::none, {}};
  preset.k_s = std::pow(10, random.uniform(3, 7)), preset.F_max = std::pow(10, random.uniform(-4, 0));
  preset.initial_stretch = random.uniform(1, 2), preset.dt = std::pow(10, random.uniform(-5, -2));
}

Preset preset_of(Random& random, bool with_opencl) {
  Preset preset;
  preset.name = "a run\nwith two lines";
  if (random.below(10) == 0) preset.kind = Kind::one_weight;
  preset.integrator = integrator_names()[std::size_t(random.below(int(integrator_names().size())))];
  preset.precision = random.below(2) == 0 ? Precision::float_ : Precision::double_;
  // From a tame scene with one or two things unusual to one in which everything is.
  const int wild = 1 + random.below(random.below(3) == 0 ? int(notation().size()) : 4);
  for (int n = 0; n < wild; ++n) {
    const PresetRow& row = notation()[std::size_t(random.below(int(notation().size())))];
    if (row.section != "view" && row.key != "rows" && row.key != "columns") make_extreme(random, row, preset);
  }
  preset.rows = std::max(length(random), 1), preset.columns = length(random);
  if (preset.rows == 1) std::swap(preset.rows, preset.columns);
  if (random.below(3) == 0) preset.dt = std::pow(10, random.uniform(-7, 0));
  if (random.below(3) == 0) preset.F_max = std::pow(10, random.uniform(-4, 2));
  if (random.below(3) == 0) preset.initial_stretch = random.uniform(0.5, 3);
  if (random.below(2) == 0) preset.pins = pins(random, preset);
  if (random.below(3) == 0) add_bodies(random, preset);
  if (random.below(6) == 0) make_tear(random, preset);
  if (random.below(8) == 0) {
    preset.self = self_names[1 + std::size_t(random.below(2))];
    preset.initial_stretch = std::max(preset.initial_stretch, 0.2);
    preset.thickness = random.below(2) == 0 ? 0 : random.uniform(0, largest_thickness(preset.L));
  }
  preset.contact = contact_names[std::size_t(random.below(int(contact_names.size())))];
  if (with_opencl && random.below(50) == 0 && runs_on_opencl(scheme(preset.integrator)) &&
      missing_on_opencl(preset) == nullptr)
    preset.engine = EngineKind::opencl;
  if (preset.F_max > 0 && random.below(2) == 0 && preset.engine == EngineKind::cpu && !force::curl.on(preset) &&
      preset.columns > 1 && parts_cloth(scheme(preset.integrator)))
    preset.tearing = "split";
  return preset;
}

/// Particles that a sweep visits in a step, and how often; with as many iterations as there may be.
double visits_of_step(const Preset& p) {
  const Scheme& method = scheme(p.integrator);
  const double particles = p.kind == Kind::cloth ? double(p.rows) * p.columns : 1;
  double sweeps = double(method.tables.empty() ? method.sweeps.size() : method.tables.back().sweeps.size());
  if (iterates(method)) sweeps *= p.iterations;
  if (is_implicit(method)) sweeps *= 30 + max_gradient_steps({p.rows, p.columns});
  if (chooses_steps(method)) sweeps *= 1e4;
  if (p.self != "off") sweeps *= 1000;
  if (parts(p)) sweeps *= 100;
  return particles * sweeps;
}

}  // namespace

double most_seconds(const RunCase& one) {
  const double seconds_a_visit = one.preset.engine == EngineKind::opencl ? 1e-6 : 2e-7;
  const double looked_at = std::find(one.outputs.begin(), one.outputs.end(), "ledger") == one.outputs.end() ? 1 : 4;
  return visits_of_step(one.preset) * seconds_a_visit * looked_at * one.steps;
}

double most_bytes(const RunCase& one) {
  const Preset& p = one.preset;
  if (p.kind == Kind::one_weight) return 0;
  // A few dozen numbers for each vector, spring and backup, and each row of text of the outputs.
  // Where the cloth parts, up to four of each, and their stencils.
  const double particle = parts(p) ? 60e3 : 6e3;
  // Lists of what is near in a cloth that is pressed together.
  const double pairs = p.self != "off" ? 2e4 : 0;
  // The band of a factorized system: three numbers a particle, and two rows of particles on one side.
  const double band = is_implicit(scheme(p.integrator)) ? 3 * 3 * (2.0 * std::min(p.rows, p.columns) + 4) * 8 * 2 : 0;
  return (particle + pairs + band) * p.rows * p.columns;
}

RunCase run_case(std::uint64_t seed, std::int64_t number, bool with_opencl) {
  Random random(seed * 0x9E3779B97F4A7C15u + std::uint64_t(number));
  RunCase one;
  do {
    one.preset = preset_of(random, with_opencl);
  } while (!check_preset(one.preset).empty());
  constexpr double most_visits = 2e7;
  one.steps = int(std::clamp(most_visits / visits_of_step(one.preset), 1.0, 400.0));
  one.steps = 1 + random.below(one.steps);
  one.threads = 1 + random.below(3);
  for (const std::string& output : all_outputs)
    if (random.below(3) == 0 && !(output == "obj" && one.preset.kind == Kind::one_weight))
      one.outputs.push_back(output);
  if (random.below(8) == 0) one.interrupt_after = random.uniform(0, 0.2), one.steps = 1'000'000'000;
  one.twin = !one.interrupt_after && random.below(5) == 0;
  return one;
}

std::vector<RunCase> simpler_cases(const RunCase& of) {
  std::vector<RunCase> all;
  const auto add = [&](const auto& change) {
    RunCase next = of;
    change(next);
    if (!(next == of) && check_preset(next.preset).empty()) all.push_back(next);
  };
  const Preset usual;
  for (const PresetRow& row : notation())
    add([&](RunCase& c) { std::visit([&](auto field) { c.preset.*field = usual.*field; }, row.field); });
  add([&](RunCase& c) { c.preset.pins = usual.pins; });
  add([](RunCase& c) { c.preset.pins = {Pins::Mode::none, {}}; });
  add([&](RunCase& c) { c.preset.precision = Precision::double_; });
  add([&](RunCase& c) { c.preset.engine = EngineKind::cpu; });
  for (std::size_t n = 0; n < of.preset.bodies.size(); ++n)
    add([&](RunCase& c) { c.preset.bodies.erase(c.preset.bodies.begin() + std::ptrdiff_t(n)); });
  for (std::size_t n = 0; n < of.outputs.size(); ++n)
    add([&](RunCase& c) { c.outputs.erase(c.outputs.begin() + std::ptrdiff_t(n)); });
  add([](RunCase& c) { c.threads = 1; });
  add([](RunCase& c) { c.steps = (c.steps + 1) / 2; });
  return all;
}

std::vector<std::string> arguments_of(const RunCase& one) {
  std::vector<std::string> all{"run",       "preset.json",
                               "--steps",   std::to_string(one.steps),
                               "--threads", std::to_string(one.threads),
                               "--state",   "state.csv",
                               "--json",    "summary.json"};
  const auto wants = [&](const char* output) {
    return std::find(one.outputs.begin(), one.outputs.end(), output) != one.outputs.end();
  };
  if (wants("series") || wants("ledger")) all.insert(all.end(), {"--series-every", "3"});
  for (const std::string& output : one.outputs) {
    all.push_back("--" + output);
    all.push_back(output + (output == "obj" ? "" : output == "pc2" ? ".pc2" : ".csv"));
  }
  return all;
}

}  // namespace tyglab::fuzz
