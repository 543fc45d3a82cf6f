#include "tests/bench/stress_preset.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/analysis/frequency.h"
#include "core/contact/self_contact.h"
#include "core/forces/force.h"
#include "core/integrators/scheme.h"
#include "core/io/preset_io.h"
#include "core/model/notation.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

constexpr double smallest = 1e-6;  // other than 0, of a constant that may be 0
constexpr int longest_side = 64, narrow = 12;

/// A number from the whole range of a row: evenly over its decades where it spans some, 0 now and then where that is
/// allowed.
template <class T>
double anywhere(const Row<T>& row, StressRandom& random) {
  if (row.scale == Scale::linear) return random.uniform(row.min, row.max);
  if (row.min == 0 && random.chance(0.2)) return 0;
  return random.decades(row.min == 0 ? smallest : row.min, row.max);
}

double signed_decades(double most, StressRandom& random) {
  if (random.chance(0.4)) return 0;
  return random.decades(smallest, most) * (random.chance(0.5) ? 1 : -1);
}

/// Sets a row's field to something from its whole range. Sizes and names are chosen elsewhere.
template <class T>
void randomise(T& object, const Row<T>& row, StressRandom& random) {
  if (const auto* number = std::get_if<double T::*>(&row.field)) object.** number = anywhere(row, random);
  if (const auto* whole = std::get_if<int T::*>(&row.field)) object.** whole = int(anywhere(row, random));
  if (const auto* vector = std::get_if<glm::dvec3 T::*>(&row.field))
    for (int c = 0; c < 3; ++c)
      (object.**vector)[c] = row.min > 0 ? anywhere(row, random) : signed_decades(row.max, random);
}

bool is_size(const PresetRow& row) {
  return row.effect == Effect::rebuild;
}

void choose_size(Preset& p, StressRandom& random) {
  p.rows = int(random.decades(2, longest_side + 1)), p.columns = int(random.decades(1, longest_side + 1));
  if (random.chance(0.9)) return;
  p.rows = int(random.decades(2, 4097)), p.columns = int(random.decades(1, narrow + 1));
  if (random.chance(0.5) && p.columns >= 2) std::swap(p.rows, p.columns);
}

/// Those of one of the names, or some of a list.
void choose_sites(const Preset& p, StressRandom& random, Pins::Mode& mode, std::vector<Pins::Site>& list) {
  mode = Pins::Mode(random.below(int(Pins::Mode::list) + 1));
  if (mode != Pins::Mode::list) return;
  for (int n = random.below(20); n > 0; --n) {
    const Pins::Site site{random.below(p.rows), random.below(p.columns)};
    if (std::find(list.begin(), list.end(), site) == list.end()) list.push_back(site);
  }
}

/// Pins that rest, or some of them follow paths and turn.
Pins random_pins(const Preset& p, StressRandom& random) {
  Pins pins;
  choose_sites(p, random, pins.mode, pins.list);
  if (random.chance(0.8)) return pins;
  for (int n = 1 + random.below(2); n > 0; --n) {
    Pins::Motion& motion = pins.motions.emplace_back();
    choose_sites(p, random, motion.mode, motion.list);
    for (double t = 0; motion.path.size() < 4 && random.chance(0.7); t += random.decades(1e-3, 1))
      motion.path.push_back({t, {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}});
    for (int c = 0; c < 3; ++c)
      motion.spin[c] = signed_decades(1000, random), motion.center[c] = random.uniform(-1, 1) + p.x_0[c] * 0.999;
    motion.until = random.chance(0.5) ? 0 : random.decades(1e-3, 10);
  }
  return pins;
}

/// A body of any shape, where the cloth is likely to meet it. It may move.
Body random_body(const Preset& p, StressRandom& random) {
  Body body;
  for (const BodyRow& row : body_notation())
    if (random.chance(0.3)) randomise(body, row, random);
  body.shape = Body::Shape(random.below(int(shape_names.size())));
  const double size = std::min(100.0, p.L * std::max(p.rows, p.columns));
  const auto near = [&](double middle) { return std::clamp(middle + random.uniform(-size, size), -1e3, 1e3); };
  if (random.chance(0.7)) {
    body.c = {near(p.x_0.x), near(p.x_0.y), near(p.x_0.z)}, body.y = near(p.x_0.y);
    body.r = std::clamp(size * random.decades(0.01, 1), 1e-3, 100.0);
    body.length = std::clamp(size * random.decades(0.01, 1), 1e-3, 200.0);
    for (int c = 0; c < 3; ++c) body.size[c] = std::clamp(size * random.decades(0.01, 2), 1e-3, 200.0);
  }
  if (random.chance(0.1)) {
    body.velocity = glm::dvec3(0);
    for (double t = 0; body.path.size() < 4; t += random.decades(1e-3, 1))
      body.path.push_back({t, {near(body.c.x), near(body.c.y), near(body.c.z)}});
  }
  return body;
}

/// Of thicknesses that the spacing allows, where the method takes it.
void choose_self_contact(Preset& p, StressRandom& random) {
  if (random.chance(0.75)) return;
  p.self = random.chance(0.5) ? "repel" : "guard";
  p.initial_stretch = std::max(p.initial_stretch, 0.2);
  p.thickness = random.chance(0.5) ? 0 : largest_thickness(p.L) * random.decades(0.01, 1);
}

/// Where springs tear, half of the cloths part.
void choose_parting(Preset& p, StressRandom& random) {
  const bool can = parts_cloth(scheme(p.integrator)) && !force::curl.on(p) && p.columns > 1;
  if (can && random.chance(0.5)) p.tearing = "split";
}

/// Round what the method can take, so that cases fall on both sides of it.
void choose_dt(Preset& p, StressRandom& random) {
  const Mode fastest = any_configuration(p);
  const double omega = fastest.omega(), zeta = omega > 0 ? fastest.damping / (2 * omega) : 0;
  const double limit = 2 / (std::sqrt(1 + zeta * zeta) + zeta) / omega;  // Verlet's
  if (std::isfinite(limit) && random.chance(0.6)) p.dt = std::clamp(limit * random.decades(0.03, 3), 1e-7, 1.0);
}

/// Nothing holds the cloth, and its springs break soon, or all at once.
void tear_apart(Preset& p, StressRandom& random) {
  p.pins = Pins{};
  p.pins.mode = Pins::Mode::none;
  p.initial_stretch = random.uniform(1, 2);
  p.F_max = std::clamp(p.k_s * p.L * random.decades(smallest, 1), smallest, 1e9);
}

}  // namespace

StressRandom::StressRandom(std::uint64_t seed, std::uint64_t number)
    : bits_(seed * 0x9e3779b97f4a7c15u + number * 0xd1b54a32d192ed03u + 1) {}

double StressRandom::uniform(double low, double high) {
  return low + (high - low) * (double(bits_() >> 11) * 0x1p-53);
}

double StressRandom::decades(double low, double high) {
  assert(0 < low && low <= high);
  return std::clamp(std::exp(uniform(std::log(low), std::log(high))), low, high);
}

Preset random_preset(StressRandom& random, const std::string& integrator) {
  Preset p;
  p.name = "Stress";
  choose_size(p, random);
  // In half of the cases every constant comes from its whole range, in the others most keep their defaults: with all of
  // them wild, hardly a scene lives for long.
  const double wild = random.chance(0.5) ? 1 : 0.2;
  for (const PresetRow& row : notation())
    if (!is_size(row) && random.chance(wild)) randomise(p, row, random);
  if (random.chance(0.05)) p.kind = Kind::one_weight;
  const auto names = integrator_names();
  p.integrator = names[std::size_t(random.below(int(names.size())))];
  if (!integrator.empty()) p.integrator = integrator;
  p.precision = random.chance(0.5) ? Precision::float_ : Precision::double_;
  p.pins = random_pins(p, random);
  for (int n = std::max(0, random.below(6) - 2); n > 0; --n) p.bodies.push_back(random_body(p, random));
  p.contact = contact_names[std::size_t(random.below(int(contact_names.size())))];
  choose_self_contact(p, random);
  choose_dt(p, random);
  if (p.kind == Kind::cloth && random.chance(0.15)) tear_apart(p, random);
  choose_parting(p, random);
  return p;
}

Preset changed(const Preset& preset, StressRandom& random, bool keeps_integrator, std::string& what) {
  const auto rows = notation();
  for (;;) {
    Preset next = preset;
    const PresetRow& row = rows[std::size_t(random.below(int(rows.size())))];
    what = row.key;
    if (is_size(row)) {
      choose_size(next, random);
      next.pins = random_pins(next, random);
    } else if (row.key == "integrator") {
      next.integrator = integrator_names()[std::size_t(random.below(int(integrator_names().size())))];
    } else if (row.key == "texture") {
      what = "precision";
      next.precision = preset.precision == Precision::float_ ? Precision::double_ : Precision::float_;
    } else {
      randomise(next, row, random);
    }
    if (keeps_integrator) next.integrator = preset.integrator;
    if (next != preset && check_preset(next).empty()) return next;
  }
}

Edit random_edit(const Simulation& simulation, StressRandom& random, bool keeps_integrator, std::string& what) {
  const Lattice& lattice = simulation.lattice();
  const Preset& preset = simulation.preset();
  const int i = random.below(lattice.rows), j = random.below(lattice.columns);
  switch (random.below(8)) {
    case 0:
      return what = "grab", edit::Grab{i, j};
    case 1: {
      const glm::dvec3 here = simulation.positions().at(i, j);
      const auto off = [&] { return signed_decades(10, random); };
      return what = "move the hand", edit::MoveHand{here + glm::dvec3(off(), off(), off()), 1 + random.below(40)};
    }
    case 2:
      return what = "release", edit::Release{};
    case 3: {
      edit::Cut cut;
      for (int n = random.chance(0.2) ? lattice.size() : random.below(10); n >= 0; --n)
        cut.sites.push_back({random.below(lattice.rows), random.below(lattice.columns)});
      return what = "cut", cut;
    }
    case 4:
      return what = "pin", edit::Pin{i, j, random.chance(0.5)};
    case 5:
      if (!preset.bodies.empty()) {
        const auto to = [&] { return random.uniform(-1, 1); };
        return what = "move a body", edit::MoveBody{random.below(int(preset.bodies.size())),
                                                    preset.x_0 * 0.999 + glm::dvec3(to(), to(), to()),
                                                    random.chance(0.5) ? 0 : 1 + random.below(40)};
      }
      [[fallthrough]];
    case 6:
      if (random.chance(0.3)) return what = "restart", edit::Restart{};
      [[fallthrough]];
    default: {
      const Preset next = changed(preset, random, keeps_integrator, what);
      return edit::Change{next};
    }
  }
}

}  // namespace tyglab
