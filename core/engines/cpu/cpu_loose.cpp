// Where the cloth has parted (core/forces/parted.h), around the sweeps. The sweep finds no stencil of the lattice
// there; before it one thread adds what loose stencils do, in double, to the force that rows begin with. The sweep
// divides it by m, and a particle with a share of that mass is given that much more.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>

#include "core/engines/cpu/cpu_engine.h"

namespace tyglab::cpu {

template <class R, unsigned Present>
void CpuEngine<R, Present>::follow_loose(const Tears& tears) {
  Loose& loose = loose_;
  if (loose.known_torn == tears.torn_count()) return;
  std::vector<LooseStencil> all = loose_stencils(cloth_.preset, tears);
  // Weight acts on all particles alike.
  std::erase_if(all, [](const LooseStencil& one) { return one.stencil->points == 1; });
  std::vector<int>& particles = loose.particles;
  particles.clear();
  for (const LooseStencil& one : all)
    particles.insert(particles.end(), one.at.begin(), one.at.begin() + one.stencil->points);
  std::sort(particles.begin(), particles.end());
  particles.erase(std::unique(particles.begin(), particles.end()), particles.end());
  loose.others.clear(), loose.springs.clear();
  std::map<std::array<int, 3>, typename Loose::Spring> springs;  // by ends and direction
  const Preset& p = cloth_.preset;
  for (LooseStencil& one : all) {
    for (std::size_t n = 0; n < std::size_t(one.stencil->points); ++n)
      one.at[n] = int(std::lower_bound(particles.begin(), particles.end(), one.at[n]) - particles.begin());
    const bool bends = one.force == &force::bend, damps = one.force == &force::damping;
    if (!bends && !damps && one.force != &force::stretch) {
      loose.others.push_back(one);
      continue;
    }
    const int direction = one.spring.direction + (bends ? stretch_directions : 0);
    auto& spring = springs.try_emplace({one.at[0], one.at[1], direction}).first->second;
    spring.a = one.at[0], spring.b = one.at[1], spring.direction = direction, spring.sign = bends ? -1 : 1,
    spring.rest = one.stencil->rest * p.L;
    (damps ? spring.k_d : spring.k) += one.weight * (damps ? p.k_d : one.force->stiffness(p, *one.stencil));
  }
  for (const auto& [key, spring] : springs) loose.springs.push_back(spring);
  loose.per_share.clear(), loose.places.clear();
  for (const int particle : particles) {
    loose.per_share.push_back(1 / tears.share(particle));
    loose.places.push_back(particle / cloth_.lattice.columns * cloth_.vector(vector_x).pitch() +
                           particle % cloth_.lattice.columns);
  }
  for (auto* vectors : {&loose.x, &loose.v, &loose.F}) vectors->resize(particles.size());
  loose.force = Field();
  loose.rows.assign(particles.empty() ? 0 : std::size_t(cloth_.lattice.rows), 0);
  if (!particles.empty()) loose.force.resize(array_rows(), cloth_.stride);
  for (const int particle : particles) loose.rows[std::size_t(particle / cloth_.lattice.columns)] = 1;
  loose.known_torn = tears.torn_count();
}

/// What loose springs do to the particles that they join, N.
template <class R, unsigned Present>
void CpuEngine<R, Present>::add_loose_springs() {
  constexpr double shortest = 1e-9;  // of its rest length, under which a spring has no direction
  Loose& loose = loose_;
  for (const auto& spring : loose.springs) {
    const auto a = std::size_t(spring.a), b = std::size_t(spring.b);
    const glm::dvec3 d = loose.x[b] - loose.x[a];
    const double length = std::sqrt(glm::dot(d, d)), longer = spring.sign * (length - spring.rest);
    // Which springs act changes from step to step, so there is no branch to guess.
    const double acts = spring.k * spring.sign * double(length > shortest * spring.rest);
    const double factor = acts * std::max(longer, 0.0) / std::max(length, shortest * spring.rest);
    const glm::dvec3 F = factor * d + spring.k_d * (loose.v[b] - loose.v[a]);
    loose.F[a] += F, loose.F[b] -= F;
  }
}

/// Before a sweep: the forces that it adds to those it computes.
template <class R, unsigned Present>
void CpuEngine<R, Present>::find_given_force(const ResolvedSweep& sweep) {
  cloth_.near_force = nullptr;
  if (!loose_.particles.empty()) find_loose_force(sweep);
  if (self_ != nullptr) find_near_force(sweep);
}

template <class R, unsigned Present>
void CpuEngine<R, Present>::find_loose_force(const ResolvedSweep& sweep) {
  Loose& loose = loose_;
  using Air = ResolvedSweep::Air;
  const auto is_in = [&](const Force& force) {
    if (&force == &force::air ? sweep.air == Air::none : sweep.air == Air::alone) return false;
    return !sweep.external || force.group != Force::Group::internal;
  };
  const std::ptrdiff_t component = cloth_.stride;
  const R *x = cloth_.vector(sweep.position).row(0), *v = cloth_.vector(sweep.velocity).row(0);
  for (std::size_t n = 0; n < loose.particles.size(); ++n) {
    const R *at = x + loose.places[n], *moving = v + loose.places[n];
    loose.x[n] = {at[0], at[component], at[2 * component]};
    loose.v[n] = sweep.per_velocity * glm::dvec3(moving[0], moving[component], moving[2 * component]);
    loose.F[n] = glm::dvec3(0);
  }
  if (!sweep.external && sweep.air != Air::alone) add_loose_springs();
  const auto x_of = [&](int n) { return loose.x[std::size_t(n)]; };
  const auto v_of = [&](int n) { return loose.v[std::size_t(n)]; };
  for (const LooseStencil& one : loose.others) {
    if (!is_in(*one.force)) continue;
    const ForceAction action = action_of(cloth_.preset, one, x_of, v_of);
    for (std::size_t n = 0; n < std::size_t(one.stencil->points); ++n) loose.F[std::size_t(one.at[n])] += action.F[n];
  }
  for (std::size_t n = 0; n < loose.particles.size(); ++n) {
    R* to = loose.force.row(0) + loose.places[n];
    for (int c = 0; c < 3; ++c) to[c * component] = R(loose.per_share[n] * loose.F[n][c]);
  }
  cloth_.near_force = &loose.force, cloth_.near_rows = loose.rows.data();
}

/// What the next implicit stage has beside the lattice; null: nothing.
template <class R, unsigned Present>
const implicit::Beside* CpuEngine<R, Present>::begin_beside() {
  beside_.renew = {};
  const bool meets = self_ != nullptr && !lags_contact(*scheme_) && begin_self_solve();
  if (!meets && loose_.particles.empty()) return nullptr;
  beside_.lighter.clear();
  for (std::size_t n = 0; n < loose_.particles.size(); ++n)
    beside_.lighter.push_back({loose_.places[n], 1 / loose_.per_share[n]});
  beside_.couplings = [this](double h, std::vector<implicit::Coupling>& out) {
    out.clear();
    add_loose_couplings(h, out), add_self_couplings(h, out);
  };
  return &beside_;
}

/// How loose springs and stencils resist, where forces were computed last: like the lattice's own (newton.h).
template <class R, unsigned Present>
void CpuEngine<R, Present>::add_loose_couplings(double h, std::vector<implicit::Coupling>& out) const {
  constexpr double shortest = 1e-9;
  const Preset& p = cloth_.preset;
  const double scale = h * h / p.m;
  for (const auto& spring : loose_.springs) {
    const auto a = std::size_t(spring.a), b = std::size_t(spring.b);
    const glm::dvec3 d = loose_.x[b] - loose_.x[a];
    const double length = std::sqrt(glm::dot(d, d));
    implicit::Coupling one{.points = 2, .at = {loose_.places[a], loose_.places[b]}, .weights = {-1, 1}};
    one.all = h * spring.k_d / p.m;
    if (spring.sign * (length - spring.rest) > 0 && length > shortest * spring.rest) {
      const double across = spring.sign < 0 ? 0 : scale * spring.k * (1 - spring.rest / length);
      one.all += across, one.extra = scale * spring.k - across, one.along = d / length;
    }
    if (one.all > 0 || one.extra > 0) out.push_back(one);
  }
  for (const LooseStencil& loose : loose_.others) {
    if (loose.force->linear == nullptr) continue;
    static_assert(implicit::Coupling::most_points == Stencil::most_points);
    implicit::Coupling one{.points = loose.stencil->points};
    for (std::size_t n = 0; n < std::size_t(one.points); ++n)
      one.at[n] = loose_.places[std::size_t(loose.at[n])], one.weights[n] = loose.stencil->at[n].weight;
    one.all = scale * loose.weight * loose.force->linear(p, *loose.stencil);
    out.push_back(one);
  }
}

/// The share of its site's mass that the held particle has: what rows add up for it is its force by that.
template <class R, unsigned Present>
double CpuEngine<R, Present>::share_held() const {
  const auto at = std::lower_bound(loose_.particles.begin(), loose_.particles.end(), cloth_.held.particle);
  const bool found = at != loose_.particles.end() && *at == cloth_.held.particle;
  return found ? 1 / loose_.per_share[std::size_t(at - loose_.particles.begin())] : 1;
}

/// Of loose springs that part the cloth when they are overloaded: by how much the first may grow until then, m, at
/// least 0.
template <class R, unsigned Present>
double CpuEngine<R, Present>::loose_slack(const Tears& tears) const {
  const Preset& p = cloth_.preset;
  double slack = std::numeric_limits<double>::infinity();
  if (loose_.springs.empty()) return slack;
  // Guards stand round what is fixed in the lattice; a copy in the hand has its own.
  std::vector<std::uint8_t> guards = guards_;
  if (cloth_.held.particle >= cloth_.lattice.sites().size()) guards = guarded_sites(tears, all_fixed_);
  const auto place = [&](int particle) {
    const int i = particle / cloth_.lattice.columns, j = particle % cloth_.lattice.columns;
    return glm::dvec3(cloth_.row(vector_x, i, 0)[j], cloth_.row(vector_x, i, 1)[j], cloth_.row(vector_x, i, 2)[j]);
  };
  for (const auto& spring : loose_.springs) {
    const int a = loose_.particles[std::size_t(spring.a)], b = loose_.particles[std::size_t(spring.b)];
    if (spring.sign < 0 || !overload_parts(tears, guards, a, b)) continue;
    // A half is overloaded as its whole is.
    const double k = spring_constant(p, directions[std::size_t(spring.direction)]);
    slack = std::min(slack, std::max(p.F_max / k - (glm::distance(place(a), place(b)) - spring.rest), 0.0));
  }
  return slack;
}

// What the engine's other files need of this one.
#define TYGLAB_MAKE(R, present)                                                  \
  template void CpuEngine<R, (present)>::follow_loose(const Tears&);             \
  template void CpuEngine<R, (present)>::add_loose_springs();                    \
  template void CpuEngine<R, (present)>::find_given_force(const ResolvedSweep&); \
  template const implicit::Beside* CpuEngine<R, (present)>::begin_beside();      \
  template double CpuEngine<R, (present)>::loose_slack(const Tears&) const;      \
  template double CpuEngine<R, (present)>::share_held() const;
TYGLAB_FOR_EACH_CPU_ENGINE(TYGLAB_MAKE)
#undef TYGLAB_MAKE

}  // namespace tyglab::cpu
