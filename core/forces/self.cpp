// F_self: layers of the cloth that are near repel each other, and F_slip: friction against their slip
// (core/contact/self_contact.h). Pairs of a particle and a triangle, or of edges, at a distance D have the energy
// k s⁴/d², s = d - D, d = 2·thickness, with the largest constant of the stretch springs as k. Friction is Coulomb's,
// which grows from 0 up to a slip of about 1 cm/s.
#include "core/contact/self_contact.h"
#include "core/forces/force.h"

namespace tyglab {
namespace {

SelfContact looked_at(const Preset& p, const Tears& tears, std::span<const glm::dvec3> x) {
  SelfContact contact(tears.lattice());
  contact.set_preset(p, layer_constant(p));
  const auto placed = x.first(std::size_t(tears.particles()));
  contact.follow(tears, placed);
  contact.look(placed);
  return contact;
}

}  // namespace

const Force force::self{
    .symbol = "F_self",
    .name = "self",
    .title = "elastic, layers",
    .help = "Σ k s⁴/d² of parts nearer than d = 2·thickness, s = d − distance.",
    .group = Force::Group::internal,
    .conserves = true,
    .in_report = false,
    .on = [](const Preset& p) { return touches_itself(p); },
    .stencils = [](const Preset&) { return std::span<const Stencil>(); },
    .act = nullptr,
    .among = [](const Preset& p, const Tears& tears, std::span<const glm::dvec3> x, std::span<const glm::dvec3>,
                std::span<glm::dvec3> F) { return looked_at(p, tears, x).add_forces(F); },
};

const Force force::slip{
    .symbol = "F_slip",
    .name = "slip",
    .title = "friction of layers",
    .help = "Work of the friction between layers of the cloth.",
    .group = Force::Group::internal,
    .conserves = false,
    .in_report = false,
    .on = [](const Preset& p) { return touches_itself(p) && p.self_friction > 0; },
    .stencils = [](const Preset&) { return std::span<const Stencil>(); },
    .act = nullptr,
    .among =
        [](const Preset& p, const Tears& tears, std::span<const glm::dvec3> x, std::span<const glm::dvec3> v,
           std::span<glm::dvec3> F) {
          looked_at(p, tears, x).add_friction(v, F);
          return 0.0;
        },
};

}  // namespace tyglab
