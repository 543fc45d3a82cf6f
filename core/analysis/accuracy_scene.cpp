#include "core/analysis/reference.h"

#include "core/model/notation.h"
#include "core/theory/modes.h"

namespace tyglab {
namespace {

constexpr int scene_side = 16;

/// The default cloth, pinned at its two upper corners.
Preset cloth() {
  Preset preset;
  preset.rows = preset.columns = scene_side;
  return preset;
}

Preset one_weight() {
  Preset preset;
  preset.kind = Kind::one_weight;
  preset.m = 0.1, preset.k = 10, preset.k_d = 0, preset.L = 0.3, preset.offset = 0.2;
  return preset;
}

Preset swinging() {
  Preset preset = cloth();
  preset.k_d = preset.k_b = 0;
  preset.pins.mode = Pins::Mode::top_row;
  preset.tilt_deg = 60;
  return preset;
}

Preset flag() {
  Preset preset = cloth();
  preset.L = 0.025, preset.m = 0.00012;
  preset.columns = 24;
  preset.tilt_deg = 90;
  preset.pins.mode = Pins::Mode::left_column;
  preset.k_s = 60, preset.k_b = 6, preset.k_d = 0.004;
  preset.W = {0.004, 0, 0.0004};
  return preset;
}

/// No spring ever switches: the forces are smooth, as the methods' orders assume.
Preset taut() {
  Preset preset = cloth();
  preset.L = 0.04, preset.m = 0.0004;
  preset.k_b = 0, preset.k_d = 0.0002, preset.g = 0;
  preset.v_0 = {0, 0, 1};
  preset.tilt_deg = 90, preset.initial_stretch = 1.1;
  preset.pins.mode = Pins::Mode::boundary;
  return preset;
}

/// With 3.5 times the critical damping of the fastest mode that any shape has.
Preset heavily_damped(double k_s) {
  constexpr double zeta = 3.5;
  Preset preset = cloth();
  preset.k_s = k_s;
  preset.k_d = rounded(zeta * any_configuration(preset).omega() * preset.m / 6, 2);
  return preset;
}

Preset on_sphere() {
  Preset preset = cloth();
  preset.pins.mode = Pins::Mode::none;
  preset.tilt_deg = 0;
  preset.x_0 = {0.004, 0.52, -0.22};
  preset.v_0 = {0, -1, 0};
  Body sphere;
  sphere.c = {0, 0.3, 0}, sphere.r = 0.2, sphere.friction = 0.5;
  preset.bodies = {sphere};
  return preset;
}

}  // namespace

std::vector<AccuracyScene> accuracy_scenes() {
  return {{"one_weight", "mass on a spring", one_weight(), 2},
          {"hanging", "hanging cloth with damping", cloth(), 0.4},
          {"swinging", "swinging sheet without damping", swinging(), 0.2},
          {"flag", "flag in the wind", flag(), 0.3},
          {"taut_sheet", "taut sheet", taut(), 0.2},
          {"sphere", "sheet on a sphere", on_sphere(), 0.06},
          {"damped", "hanging cloth, heavily damped", heavily_damped(50), 0.4, true},
          {"stiff", "stiff hanging cloth, heavily damped", heavily_damped(5000), 0.4, true}};
}

}  // namespace tyglab
