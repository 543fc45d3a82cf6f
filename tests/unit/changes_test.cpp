// What a change of one field alone asks for, and that a simulation given the change does just that.
#include "core/model/effect.h"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#include <map>
#include <sstream>

#include "core/io/preset_io.h"
#include "core/model/fields.h"
#include "core/simulation.h"
#include "tests/support/devices.h"
#include "tests/support/scenes.h"

namespace tyglab::changes_test {

using enum Effect;

/// Stands for a value of any type.
struct Any {
  template <class T>
  operator T() const;
};
template <class... Members>
constexpr int members() {
  if constexpr (requires { Preset{Members{}..., Any{}}; })
    return members<Members..., Any>();
  else
    return sizeof...(Members);
}

/// Every constant counts in it, and what is changed a little stays stable.
Preset scene(Kind kind, const std::string& integrator = "verlet") {
  Preset preset = kind == Kind::cloth ? test::cloth(7, 6, integrator) : test::one_weight(integrator);
  preset.rows = 7, preset.columns = 6, preset.dt = 5e-4, preset.k_d = 0.003;
  preset.B = 1e-5, preset.twist = 0.5, preset.kappa_warp = 5, preset.kappa_weft = -3;
  preset.k_warp = 45, preset.k_shear = 40;
  preset.air_density = 1.2, preset.C_T = 0.1, preset.u = {0.5, 0.2, 1};
  preset.v_0 = {0.1, 0.2, 0.3}, preset.initial_stretch = 1.02, preset.pins.mode = Pins::Mode::top_corners;
  preset.W = {0, 1e-4, 2e-3}, preset.gust = 0.5, preset.gust_period = 0.05, preset.F_max = 0.4, preset.F_release = 1e3;
  preset.thickness = 0.1 * preset.L, preset.self_friction = 0.2;
  preset.bodies.resize(1);
  preset.bodies[0].c = {0, 0.9, 0.05}, preset.bodies[0].r = 0.05;  // in the cloth's way
  return preset;
}

void change(double& value) {
  value = value == left_out ? 48 : value * 0.99;
}
void change(int& value) {
  ++value;
}
void change(glm::dvec3& value) {
  value = value * 0.99 + glm::dvec3(0.0001, 0.0002, 0.0003);
}
void change(Kind& value) {
  value = value == Kind::cloth ? Kind::one_weight : Kind::cloth;
}
void change(EngineKind& value) {
  value = value == EngineKind::cpu ? EngineKind::opencl : EngineKind::cpu;
}
void change(Precision& value) {
  value = value == Precision::float_ ? Precision::double_ : Precision::float_;
}
void change(Pins& value) {
  value.mode = value.mode == Pins::Mode::none ? Pins::Mode::four_corners : Pins::Mode::none;
}
void change(std::vector<Body>& value) {
  value[0].r *= 0.9;
}
void change(std::string& value) {
  value = value == "verlet"    ? "rk4"
          : value == "rk4"     ? "velocity_verlet"
          : value == "local"   ? "step"
          : value == "springs" ? "split"
          : value == "off"     ? "repel"
          : value == "repel"   ? "guard"
                               : value + "2";
}

/// The preset with another, allowed value of that field alone.
Preset changed(Preset preset, const PresetField& field) {
  std::visit([&](auto member) { change(preset.*member); }, field.member);
  return preset;
}

/// What is to be said of each key, written down once more: as a cloth has it, and as the one weight has it.
struct Said {
  EffectSet cloth, weight;
};
std::map<std::string, Said> expected() {
  std::map<std::string, Said> all;
  const auto add = [&](const char* keys, EffectSet cloth, EffectSet weight) {
    std::istringstream list(keys);
    for (std::string key; list >> key;) all[key] = {cloth, weight};
  };
  add("name description", name, name);
  add("mode", view, view);
  add("texture", texture, texture);
  add("kind", rebuild, rebuild);
  add("rows columns", rebuild, unused);
  add("x_0", start, {start, force});
  add("v_0", start, start);
  add("tilt_deg initial_stretch", start, unused);
  add("offset", unused, start);
  add("m k_d g", force, force);
  add("L k_s k_warp k_weft k_shear k_b B twist kappa_warp kappa_weft W air_density u C_N C_T gust gust_period", force,
      unused);
  add("k", unused, force);
  add("self thickness friction", force, unused);
  add("F_max F_release tearing.mode", tearing, unused);
  add("bodies", bodies, bodies);
  add("contact", bodies, bodies);
  add("pins", pins, pins);
  add("integrator", integrator, integrator);
  add("dt", dt, dt);
  add("tolerance iterations", tolerance, tolerance);
  add("engine", engine, engine);
  add("device", unused, unused);
  add("precision", precision, precision);
  return all;
}

TEST_CASE("every field of a preset is compared") {
  CHECK(int(preset_fields().size()) == members<>());
}

TEST_CASE("a change of a field alone says what it asks for, and equal presets ask for nothing") {
  const auto said = expected();
  CHECK(said.size() == preset_fields().size());
  for (const Kind kind : {Kind::cloth, Kind::one_weight}) {
    const Preset preset = scene(kind);
    CHECK(changes(preset, preset).empty());
    for (const PresetField& field : preset_fields()) {
      CAPTURE(std::string(field.key));
      CAPTURE(int(kind));
      const Preset next = changed(preset, field);
      CHECK(next != preset);
      const Said& what = said.at(std::string(field.key));
      const bool weight = next.kind == Kind::one_weight;
      CHECK(changes(preset, next) == (weight ? what.weight : what.cloth));
    }
  }
}

TEST_CASE("a device counts where the engine asks for one") {
  Preset preset = scene(Kind::cloth), next = preset;
  next.device = 1;
  CHECK(changes(preset, next) == unused);
  preset.engine = next.engine = EngineKind::opencl;
  CHECK(changes(preset, next) == device);
  preset.engine = EngineKind::cpu;
  CHECK(changes(preset, next) == (engine | device));
}

TEST_CASE("several changes ask for all that each asks for") {
  const Preset preset = scene(Kind::cloth);
  Preset next = preset;
  next.mode = 3, next.k_s *= 2, next.dt /= 2;
  const EffectSet all = changes(preset, next);
  CHECK(all == EffectSet{view, force, dt});
  CHECK(all.touches(view));
  CHECK(all.touches({dt, rebuild}));
  CHECK_FALSE(all.touches({start, rebuild}));
  CHECK(all.within({view, force, dt, rebuild}));
  CHECK_FALSE(all.within({view, force}));
}

TEST_CASE("a merge carries the field that was changed, and that one alone") {
  for (const Kind kind : {Kind::cloth, Kind::one_weight}) {
    const Preset before = scene(kind);
    Preset present = before;
    for (const PresetField& field : preset_fields()) present = changed(changed(present, field), field);
    present.kind = before.kind == Kind::cloth ? Kind::one_weight : Kind::cloth;
    present.engine = EngineKind::opencl, present.precision = Precision::float_;
    present.pins.mode = Pins::Mode::left_column;
    CHECK(merge(before, before, present) == present);
    for (const PresetField& field : preset_fields()) {
      CAPTURE(std::string(field.key));
      const Preset after = changed(before, field), merged = merge(before, after, present);
      for (const PresetField& other : preset_fields()) {
        CAPTURE(std::string(other.key));
        const bool carried = std::visit([&](auto m) { return merged.*m == after.*m; }, other.member);
        const bool kept = std::visit([&](auto m) { return merged.*m == present.*m; }, other.member);
        if (other.key == field.key)
          CHECK(carried);
        else
          CHECK(kept);
      }
    }
  }
}

TEST_CASE("clearing effects leaves everything else") {
  const Preset preset = scene(Kind::cloth);
  Preset expects = preset;
  expects.name.clear(), expects.description.clear(), expects.texture.clear();
  expects.mode = 1;
  Preset full = preset;
  full.mode = 4, full.description = "what it is";
  CHECK(cleared(full, appearance) == expects);
  for (const PresetField& field : preset_fields()) {
    CAPTURE(std::string(field.key));
    const bool told_apart = preset_hash(changed(preset, field)) != preset_hash(preset);
    CHECK(told_apart == (field.key != "device" && !EffectSet(field.effect).within(appearance)));
  }
}

/// Of a simulation that has made so many steps: what is done is what was said.
void check_change(const Preset& preset, const Preset& next, int steps) {
  const EffectSet what = changes(preset, next);
  Simulation simulation(preset), same(preset);
  simulation.advance(steps), same.advance(steps);
  REQUIRE_FALSE(same.divergence().has_value());
  const State before = simulation.read_raw(), now = simulation.read();
  const double t = simulation.time();
  const edit::Change edit{next};
  const bool anew = what.touches(rebuild), taken_over = what.touches({integrator, precision, engine, device});
  const bool begins = steps == 0 && what.touches({start, force, pins, dt});
  CHECK(simulation.rebuilds(edit) == (anew || taken_over || begins));
  const std::unique_ptr<Simulation> beside = simulation.rebuilds(edit) ? simulation.rebuilt(edit) : nullptr;
  simulation.apply(edit);
  CHECK(simulation.preset() == next);
  if (beside) CHECK(test::identical(beside->read(), simulation.read()));
  if (anew || begins) {
    Simulation fresh(next);
    CHECK(simulation.steps() == 0);
    CHECK(test::identical(simulation.read_raw(), fresh.read_raw()));
    return;
  }
  CHECK(simulation.steps() == steps);
  CHECK(simulation.time() == doctest::Approx(t).epsilon(1e-14));
  if (!taken_over && !what.touches({force, pins, dt})) CHECK(test::identical(simulation.read_raw(), before));
  for (std::size_t p = 0; p < now.x.x.size(); ++p) {
    const double digits = what.touches(precision) ? 1e-6 : 1e-12;
    CHECK(glm::length(test::position(simulation.read(), p) - test::position(now, p)) <= digits);
    if (!what.touches(pins))
      CHECK(glm::length(test::velocity(simulation.read(), p) - test::velocity(now, p)) <= digits);
  }
  if (what.within(motionless)) CHECK(simulation.time() == t);
  simulation.advance(60), same.advance(60);
  const bool alike = test::identical(simulation.read_raw(), same.read_raw());
  if (what.within(motionless | start)) CHECK(alike);
  EffectSet felt{force, dt, integrator, precision};
  if (preset.kind == Kind::cloth) felt |= pins | bodies;  // the one weight has no pins, and meets no body here
  if (what.touches(felt)) CHECK_FALSE(alike);
  simulation.apply(edit::Restart{});
  same.apply(edit::Restart{});
  if (what.touches(start)) CHECK_FALSE(test::identical(simulation.read(), same.read()));
}

TEST_CASE("a simulation does what the effect of a field says, at its start and under way") {
  for (const Kind kind : {Kind::cloth, Kind::one_weight})
    for (const int steps : {0, 40})
      for (const PresetField& field : preset_fields()) {
        CAPTURE(std::string(field.key));
        CAPTURE(int(kind));
        CAPTURE(steps);
        if (field.key == "engine" && test::skipped_without_device()) continue;
        Preset preset = scene(kind);
        if (field.key == "engine") preset.B = 0;  // which OpenCL does not compute
        if (field.key == "tearing.mode") preset.kappa_warp = preset.kappa_weft = 0;
        // Parts that are near each other from the start.
        const bool near = field.key == "self" || field.key == "thickness" || field.key == "friction";
        if (near && kind == Kind::cloth) preset.initial_stretch = 0.25;
        if (near && field.key != "self") preset.self = "repel";
        check_change(preset, changed(preset, field), steps);
      }
}

TEST_CASE("tolerance and iterations count for the methods that have them, from the next step") {
  for (const auto& [method, field] : {std::pair{"dopri5", &Preset::tolerance}}) {
    Preset preset = scene(Kind::cloth, method);
    preset.*field = 1e-6;
    Preset next = preset;
    next.*field = 1e-10;
    check_change(preset, next, 40);
    Simulation a(preset), b(next);
    a.advance(40), b.advance(40);
    CHECK_FALSE(test::identical(a.read(), b.read()));
  }
  Preset preset = scene(Kind::cloth, "xpbd"), next = preset;
  next.iterations = 3;
  check_change(preset, next, 40);
  Simulation a(preset), b(next);
  a.advance(40), b.advance(40);
  CHECK_FALSE(test::identical(a.read(), b.read()));
}

TEST_CASE("in gusts a change of the view alone leaves wind and motion as they are") {
  Preset preset = scene(Kind::cloth, "dopri5");
  preset.gust = 2, preset.gust_period = 0.05;
  Simulation simulation(preset), same(preset);
  for (int n = 0; n < 30; ++n) {
    simulation.advance(7), same.advance(7);
    Preset next = simulation.preset();
    next.mode = 1 + n % 5, next.name += "x";
    simulation.apply(edit::Change{next});
    CHECK(simulation.wind() == same.wind());
    CHECK(simulation.time() == same.time());
  }
  CHECK(test::identical(simulation.read_raw(), same.read_raw()));
}

}  // namespace tyglab::changes_test
