#include "app/session/reference_curves.h"

#include <limits>

#include "core/analysis/one_weight.h"

namespace tyglab {
namespace {

/// The constants with a start at y (m) and v (m/s).
Preset starting_at(Preset preset, double y, double v) {
  preset.offset = y - preset.x_0.y;
  preset.v_0.y = v;
  return preset;
}

}  // namespace

void ReferenceCurves::begin(const Simulation& weight, double y, double v, double t) {
  of_ = weight.preset();
  exact_ = starting_at(of_, y, v);
  exact_t_ = t_ = t;
  for (std::size_t n = 0; n < companions_.size(); ++n) {
    Preset own = of_;
    own.integrator = curves[n], own.precision = Precision::double_;
    companions_[n] = std::make_unique<Simulation>(own);
    if (exact_ == of_) continue;
    // A weight may have come to where no preset lets it start.
    State state = companions_[n]->read();
    state.x.y[0] = y, state.v.y[0] = v;
    companions_[n]->load(state);
  }
}

/// What counts while the weight moves; each companion keeps its method.
void ReferenceCurves::take_constants(const Preset& preset) {
  const WeightMotion now = exact_weight(exact_, t_ - exact_t_);
  exact_ = starting_at(preset, now.y, now.v);
  exact_t_ = t_;
  for (const auto& companion : companions_) {
    Preset own = companion->preset();
    own.m = preset.m, own.k = preset.k, own.k_d = preset.k_d, own.g = preset.g, own.dt = preset.dt;
    own.x_0 = preset.x_0;
    if (own != companion->preset()) companion->apply(edit::Change{own});
  }
  of_ = preset;
}

ReferenceCurves::Heights ReferenceCurves::follow(Simulation& weight, std::int64_t steps) {
  const bool from_start = weight.steps() == steps;
  const bool unseen = companions_[0] == nullptr || weight.steps() != steps_ + steps;
  if (from_start) {
    begin(weight, weight.preset().x_0.y + weight.preset().offset, weight.preset().v_0.y, 0);
  } else if (unseen) {
    const State& state = weight.read();
    begin(weight, state.x.y[0], state.v.y[0], weight.time());
    steps = 0;
  }
  if (of_ != weight.preset()) take_constants(weight.preset());
  Heights y;
  y.fill(std::numeric_limits<double>::quiet_NaN());
  for (std::size_t n = 0; n < companions_.size(); ++n) {
    Simulation& companion = *companions_[n];
    companion.advance(int(steps));
    if (!companion.divergence()) y[n] = companion.position(0, 0).y;
  }
  steps_ = weight.steps(), t_ = weight.time();
  y.back() = exact_weight(exact_, t_ - exact_t_).y;
  return y;
}

}  // namespace tyglab
