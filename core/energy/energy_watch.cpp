#include "core/energy/energy_watch.h"

#include <cmath>

namespace tyglab {
namespace {

/// J: what gravity gives a cloth that falls its own diagonal (a weight: as far as it starts from its rest).
double gravity_scale(const Preset& p) {
  if (p.kind == Kind::one_weight) return p.m * std::abs(p.g) * std::max(p.L, std::abs(p.offset));
  return p.m * p.rows * p.columns * std::abs(p.g) * p.L * std::hypot(p.rows - 1, p.columns - 1);
}

}  // namespace

void EnergyWatch::begin(const Preset& preset, const EnergyReading& now, double t) {
  ledger_.begin(now, gravity_scale(preset), t);
  whole_ = {};
}

void EnergyWatch::before_step(const Preset& preset, const Tears& tears) {
  const bool may_break = preset.kind == Kind::cloth && preset.F_max > 0;
  if (may_break && (whole_.lattice() != tears.lattice() || whole_.torn_count() != tears.torn_count())) whole_ = tears;
}

void EnergyWatch::after_step(const Preset& preset, const Tears& tears, const State& state, const Held& held,
                             std::span<const Contact> contacts) {
  const EnergyReading now = read_energy(preset, tears, state, held);
  double tearing = 0, contact = 0, before_tearing = now.energy.total();
  const bool broken = preset.F_max > 0 && whole_.torn_count() != tears.torn_count();
  if (broken) {
    before_tearing = read_energy(preset, whole_, state, held).energy.total();
    tearing = now.energy.total() - before_tearing;
  }
  if (!contacts.empty()) {
    freely_ = state;
    for (const Contact& s : contacts) {
      const std::size_t n = std::size_t(s.particle);
      freely_.x.x[n] += s.x.x, freely_.x.y[n] += s.x.y, freely_.x.z[n] += s.x.z;
      freely_.v.x[n] += s.v.x, freely_.v.y[n] += s.v.y, freely_.v.z[n] += s.v.z;
    }
    contact = before_tearing - read_energy(preset, broken ? whole_ : tears, freely_, held).energy.total();
  }
  ledger_.step(now, preset.dt, contact, tearing);
}

}  // namespace tyglab
