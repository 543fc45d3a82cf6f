#include "app/session/recorded.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>

#include "app/session/session.h"

namespace tyglab {
namespace {

/// Magnitudes in the order of force_keys, N.
std::array<double, Recorded::forces_count> force_values(const ParticleReadout& r) {
  return {glm::length(r.F),   glm::length(r.F_s),   glm::length(r.F_b),  glm::length(r.F_d),
          glm::length(r.F_g), glm::length(r.F_int), glm::length(r.F_ext)};
}

std::array<double, Recorded::forces_count> force_values(const ForceSummary& s) {
  return {s.F, s.F_s, s.F_b, s.F_d, s.F_g, s.F_int, s.F_ext};
}

void sample_forces(Session& session) {
  Recorded& to = session.recorded;
  const double t = session.simulation->time();
  const Source source = force_source(session);
  if (source != Source::particle) {
    const auto reduction = source == Source::sum ? Reduction::sum : Reduction::maximum;
    to.forces.add(t, force_values(session.simulation->forces(reduction)));
  } else if (session.picked) {
    to.forces.add(t, force_values(session.simulation->particle(session.picked->i, session.picked->j)));
  }
}

void sample_height(Session& session, std::int64_t made) {
  Recorded& to = session.recorded;
  const double t = session.simulation->time(), y = session.simulation->position(0, 0).y;
  const bool fresh = to.height.empty() || t <= to.height.t().back();
  if (fresh) to.height_methods.clear();
  if (fresh || to.height_methods.back().second != session.preset().integrator)
    to.height_methods.emplace_back(t, session.preset().integrator);
  const ReferenceCurves::Heights others = session.curves.follow(*session.simulation, made);
  const std::array row{y, others[0], others[1], others[2], others[3]};
  to.height.add(t, row);
}

}  // namespace

const Variable& variable(std::string_view key) {
  const auto list = variables();
  const auto it = std::find_if(list.begin(), list.end(), [&](const Variable& v) { return v.key == key; });
  if (it == list.end()) throw std::logic_error("no variable is called " + std::string(key));
  return *it;
}

glm::dvec3 vector_of(const ParticleReadout& r, std::string_view key) {
  if (key == "F_s") return r.F_s;
  if (key == "F_b") return r.F_b;
  if (key == "F_d") return r.F_d;
  if (key == "F_g") return r.F_g;
  if (key == "F_int") return r.F_int;
  if (key == "F_ext") return r.F_ext;
  if (key == "F") return r.F;
  if (key == "x") return r.x;
  if (key == "v") return r.v;
  return r.a;
}

std::vector<std::string> height_column_names() {
  std::vector<std::string> names{"y [m]"};
  for (std::string_view curve : ReferenceCurves::curves) names.push_back("y_" + std::string(curve) + " [m]");
  return names;
}

std::vector<std::string> force_column_names() {
  std::vector<std::string> names;
  for (std::string_view key : force_keys) names.push_back(std::string(key) + " [N]");
  return names;
}

Source force_source(const Session& session) {
  return session.preset().kind == Kind::one_weight ? Source::particle : session.recorded.chosen;
}

void sample(Session& session) {
  Recorded& to = session.recorded;
  const Wants& wants = session.wants;
  const std::int64_t made = session.steps_made - to.sampled;
  to.sampled = session.steps_made;
  if (made == 0) return;
  if (to.paused || !wants.forces) to.forces.interrupt();
  if (to.paused || !wants.height) to.height.interrupt();
  if (to.paused || !wants.copies) session.copies.distance.interrupt(), session.copies.energy.interrupt();
  if (to.paused) return;
  const FrameCosts::Timer timer(session.costs, Part::sample);
  if (wants.forces) sample_forces(session);
  if (wants.copies) sample_copies(session);
  if (wants.height) sample_height(session, made);
}

int steps_between_samples(const Session& session) {
  constexpr double apart = 1.0 / 240;  // s, simulated
  const Wants& wants = session.wants;
  const bool particle = wants.forces && force_source(session) == Source::particle;
  const bool cheap = session.preset().engine == EngineKind::cpu && session.copies.lockstep.empty();
  if (session.recorded.paused || !cheap || !(particle || wants.height)) return std::numeric_limits<int>::max();
  return int(std::clamp(std::round(apart / session.preset().dt), 1.0, 1e9));
}

}  // namespace tyglab
