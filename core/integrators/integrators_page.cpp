#include "core/integrators/integrators_page.h"

#include <sstream>

#include "core/integrators/scheme.h"

namespace tyglab {
namespace {

constexpr const char* head =
    R"(# Integrators

*This page is generated from the table of methods (core/integrators) by `TYGLAB_WRITE_DOCS=1 )"
    R"(build/release/bin/presets_tests`; a test checks that it is current.*

A method advances position and velocity from one time step to the next, with $a = \ddot x(x, v)$ from all forces. )"
    R"(`--integrator NAME`, `solver.integrator` in a preset and the first row of the sandbox's panel choose it; it )"
    R"(can be changed while the cloth moves. [accuracy.md](accuracy.md) measures which one is fastest for a given )"
    R"(error, [stability.md](stability.md) where each becomes unstable; [model.md](model.md#integrators) describes )"
    R"(what they have in common.

*Order* is that of the whole method, position and velocity, on a smooth motion: order 2 means that half the step )"
    R"(gives a quarter of the error. No method keeps its order where springs switch between pulling and slack. *h* )"
    R"(is $dt$ (of `dopri5` and `rkc2` an inner step), $\omega$ the fastest angular frequency of the cloth, $\zeta$ its damping )"
    R"(ratio.

)";

std::string order_of(const Scheme& scheme) {
  const std::string plain = std::to_string(scheme.order_undamped);
  return scheme.order_damped == scheme.order_undamped ? plain
                                                      : plain + ", damped " + std::to_string(scheme.order_damped);
}

/// What it reads of the preset beside dt, and what it cannot do.
std::string particulars(const Scheme& scheme) {
  std::string text;
  if (chooses_steps(scheme)) text += " It reads `tolerance`.";
  if (iterates(scheme)) text += " It reads `iterations`.";
  if (chooses_steps(scheme))
    text += " Linear theory gives no limit of $dt$ for it, so `stability boundary` leaves it out.";
  if (projects(scheme))
    text +=
        " It has no amplification matrix, since a step is not linear even where the cloth is: `stability boundary` "
        "leaves it out, and the sandbox's gauge shows no limit.";
  return text;
}

}  // namespace

std::string integrators_markdown() {
  std::ostringstream out;
  out << head << "| name | order | stability | cost of a step |\n|---|---|---|---|\n";
  for (const Scheme& scheme : schemes())
    out << "| [`" << scheme.name << "`](#" << scheme.name << ") | " << order_of(scheme) << " | " << scheme.stability
        << " | " << scheme.cost << " |\n";
  for (const Scheme& scheme : schemes()) {
    out << "\n## " << scheme.name << "\n\n**" << scheme.title;
    if (!scheme.equation.empty()) out << " (" << scheme.equation << ")";
    out << ".** " << scheme.note << particulars(scheme) << "\n\n"
        << scheme.formula << "\n\n*Source:* " << scheme.source << ".\n";
  }
  return out.str();
}

}  // namespace tyglab
