
#include "core/energy/ledger.h"

#include <algorithm>
#include <cmath>

namespace tyglab {
namespace {

/// Weights of the last value, the one before it, … for the integral over the last step (Adams and Moulton).
constexpr std::array<double, 5> last_step{251.0 / 720, 646.0 / 720, -264.0 / 720, 106.0 / 720, -19.0 / 720};

}  // namespace

void RunningIntegral::restart(double value) {
  closed_ += open();
  last_[0] = value;
  count_ = 1;
}

void RunningIntegral::add(double value, double h) {
  if (count_ > 1 && h != h_) restart(last_[0]);  // the parts of a step that impacts split have lengths of their own
  if (count_ == int(last_.size())) {
    // Five values are there: what they span stands fixed, and each further step is added by itself.
    closed_ += open();
    count_ = int(last_.size()) + 1;
  }
  std::copy_backward(last_.begin(), last_.end() - 1, last_.end());
  last_[0] = value;
  h_ = h;
  if (count_ < int(last_.size())) {
    ++count_;
    return;
  }
  for (std::size_t n = 0; n < last_.size(); ++n) closed_ += h * last_step[n] * last_[n];
}

/// Of the first values, while there are no more than five: Newton and Cotes.
double RunningIntegral::open() const {
  const auto& y = last_;
  switch (count_) {
    case 2:
      return h_ / 2 * (y[0] + y[1]);
    case 3:
      return h_ / 3 * (y[0] + 4 * y[1] + y[2]);
    case 4:
      return h_ * 3 / 8 * (y[0] + 3 * y[1] + 3 * y[2] + y[3]);
    case 5:
      return h_ * 2 / 45 * (7 * y[0] + 32 * y[1] + 12 * y[2] + 32 * y[3] + 7 * y[4]);
    default:
      return 0;
  }
}

void Ledger::begin(const EnergyReading& now, double gravity_scale, double t) {
  *this = {};
  began_ = t;
  now_ = now.energy;
  start_ = now.energy.total();
  own_scale_ = now.energy.kinetic + now.energy.elastic() + gravity_scale;
  restart(now.power);
}

void Ledger::restart(const Power& power) {
  for (const Force* force : force::all) works_[*force].restart(power.of[*force]);
  hand_.restart(power.hand);
}

void Ledger::step(const EnergyReading& now, double h, double contact, double tearing) {
  now_ = now.energy;
  contact_ += contact, tearing_ += tearing;
  for (const Force* force : force::all) works_[*force].add(now.power.of[*force], h);
  hand_.add(now.power.hand, h);
  // Impacts and tears make what forces do jump: no polynomial reaches over them.
  if (contact != 0 || tearing != 0) restart(now.power);
}

void Ledger::edited(const EnergyReading& now, Source source) {
  const double jump = now.energy.total() - now_.total();
  (source == Source::hand ? grabbed_ : source == Source::tearing ? tearing_ : edits_) += jump;
  now_ = now.energy;
  restart(now.power);
}

LedgerReading Ledger::reading() const {
  LedgerReading out;
  out.energy = now_;
  out.began = began_, out.start = start_;
  out.works = {{}, contact_, tearing_, hand_.total() + grabbed_, edits_};
  out.scale = own_scale_ + std::abs(out.works.hand) + std::abs(out.works.edits);
  for (const Force* force : force::all) {
    out.works.of[*force] = works_[*force].total();
    if (force->group == Force::Group::external) out.scale += std::abs(out.works.of[*force]);
  }
  return out;
}

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
                             std::span<const DrivenPin> driven, std::span<const Contact> contacts) {
  const EnergyReading now = read_energy(preset, tears, state, held, driven);
  double tearing = 0, contact = 0, before_tearing = now.energy.total();
  const bool broken = preset.F_max > 0 && whole_.torn_count() != tears.torn_count();
  if (broken) {
    before_tearing = read_energy(preset, whole_, state, held, driven).energy.total();
    tearing = now.energy.total() - before_tearing;
  }
  if (!contacts.empty()) {
    freely_ = state;
    for (const Contact& s : contacts) {
      const std::size_t n = std::size_t(s.particle);
      freely_.x.x[n] += s.x.x, freely_.x.y[n] += s.x.y, freely_.x.z[n] += s.x.z;
      freely_.v.x[n] += s.v.x, freely_.v.y[n] += s.v.y, freely_.v.z[n] += s.v.z;
    }
    contact = before_tearing - read_energy(preset, broken ? whole_ : tears, freely_, held, driven).energy.total();
  }
  ledger_.step(now, preset.dt, contact, tearing);
}

}  // namespace tyglab
