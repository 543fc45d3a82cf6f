// Where the cloth has parted (core/forces/parted.h), around the sweeps. The sweep finds no stencil of the lattice there;
// before it one thread adds what loose stencils do, in double, to the force that rows begin with. The sweep divides it
// by m, and a particle with a share of that mass is given that much more.
#include <algorithm>

#include "core/engines/cpu/cpu_engine.h"

namespace tyglab::cpu {

template <class R, unsigned Present>
void CpuEngine<R, Present>::follow_loose(const Tears& tears) {
  Loose& loose = loose_;
  if (loose.known_torn == tears.torn_count()) return;
  loose.stencils = loose_stencils(cloth_.preset, tears);
  // Weight acts on all particles alike.
  std::erase_if(loose.stencils, [](const LooseStencil& one) { return one.stencil->points == 1; });
  std::vector<int>& particles = loose.particles;
  particles.clear();
  for (const LooseStencil& one : loose.stencils)
    particles.insert(particles.end(), one.at.begin(), one.at.begin() + one.stencil->points);
  std::sort(particles.begin(), particles.end());
  particles.erase(std::unique(particles.begin(), particles.end()), particles.end());
  for (LooseStencil& one : loose.stencils)
    for (std::size_t n = 0; n < std::size_t(one.stencil->points); ++n)
      one.at[n] = int(std::lower_bound(particles.begin(), particles.end(), one.at[n]) - particles.begin());
  loose.per_share.clear();
  for (const int particle : particles) loose.per_share.push_back(1 / tears.share(particle));
  for (auto* vectors : {&loose.x, &loose.v, &loose.F}) vectors->resize(particles.size());
  loose.force = Field();
  if (!particles.empty()) loose.force.resize(array_rows(), cloth_.stride);
  loose.known_torn = tears.torn_count();
}

/// Before a sweep: the forces that it adds to those it computes.
template <class R, unsigned Present>
void CpuEngine<R, Present>::find_given_force(const ResolvedSweep& sweep) {
  find_near_force(sweep);
  Loose& loose = loose_;
  if (loose.particles.empty()) return;
  const int columns = cloth_.lattice.columns;
  const Field &x = cloth_.vector(sweep.position), &v = cloth_.vector(sweep.velocity);
  for (std::size_t n = 0; n < loose.particles.size(); ++n) {
    const int i = loose.particles[n] / columns, j = loose.particles[n] % columns;
    for (int c = 0; c < 3; ++c) {
      loose.x[n][c] = double(x.row(i, c)[j]), loose.v[n][c] = sweep.per_velocity * double(v.row(i, c)[j]);
    }
    loose.F[n] = glm::dvec3(0);
  }
  const auto x_of = [&](int n) { return loose.x[std::size_t(n)]; };
  const auto v_of = [&](int n) { return loose.v[std::size_t(n)]; };
  for (const LooseStencil& one : loose.stencils) {
    if (sweep.external && one.force->group == Force::Group::internal) continue;
    const ForceAction action = action_of(cloth_.preset, one, x_of, v_of);
    for (std::size_t n = 0; n < std::size_t(one.stencil->points); ++n) loose.F[std::size_t(one.at[n])] += action.F[n];
  }
  for (std::size_t n = 0; n < loose.particles.size(); ++n) {
    const int i = loose.particles[n] / columns, j = loose.particles[n] % columns;
    for (int c = 0; c < 3; ++c) loose.force.row(i, c)[j] = R(loose.per_share[n] * loose.F[n][c]);
  }
  cloth_.near_force = &loose.force;
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
  const auto place = [&](int particle) {
    const int i = particle / cloth_.lattice.columns, j = particle % cloth_.lattice.columns;
    return glm::dvec3(cloth_.row(vector_x, i, 0)[j], cloth_.row(vector_x, i, 1)[j], cloth_.row(vector_x, i, 2)[j]);
  };
  for (const LooseStencil& one : loose_.stencils) {
    if (one.force != &force::stretch) continue;
    const int a = loose_.particles[std::size_t(one.at[0])], b = loose_.particles[std::size_t(one.at[1])];
    if (!overload_parts(tears, guards_, a, b)) continue;
    const double longer = glm::distance(place(a), place(b)) - one.stencil->rest * p.L;
    const double k = spring_constant(p, directions[std::size_t(one.stencil->spring[0].direction)]);
    slack = std::min(slack, std::max(p.F_max / k - longer, 0.0));
  }
  return slack;
}

// What the engine's other files need of this one.
#define TYGLAB_MAKE(R, present)                                               \
  template void CpuEngine<R, (present)>::follow_loose(const Tears&);          \
  template void CpuEngine<R, (present)>::find_given_force(const ResolvedSweep&); \
  template double CpuEngine<R, (present)>::loose_slack(const Tears&) const; \
  template double CpuEngine<R, (present)>::share_held() const;
TYGLAB_FOR_EACH_CPU_ENGINE(TYGLAB_MAKE)
#undef TYGLAB_MAKE

}  // namespace tyglab::cpu
