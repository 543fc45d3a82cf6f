#include "core/integrators/integrators_page.h"

#include <sstream>

#include "core/integrators/scheme.h"

namespace tyglab {
namespace {

constexpr const char* head =
    R"(# Integrators

*This page is made from the table of methods (core/integrators): a test holds it current, and )"
    R"(`TYGLAB_WRITE_DOCS=1 build/release/bin/presets_tests` writes it anew.*

A method carries position and velocity from one time step to the next, with $a = \ddot x(x, v)$ from all )"
    R"(forces. `--integrator NAME`, `solver.integrator` in a preset and the first row of the sandbox's )"
    R"(panel choose it; it can be changed while the cloth moves. Which one is the fastest for a wished )"
    R"(error is measured in [accuracy.md](accuracy.md), where each becomes unstable in )"
    R"([stability.md](stability.md); what all of them have in common stands in )"
    R"([model.md](model.md#integrators).

*Order* is that of the whole method, position and velocity, on a smooth motion: order 2 means that half the )"
    R"(step gives a quarter of the error. Springs that switch between pulling and slack take that away )"
    R"(from any method. *h* is $dt$ (of `dopri5` an inner step), $\omega$ the fastest angular frequency )"
    R"(of the cloth, $\zeta$ its damping ratio.

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
    text += " It has no limit of $dt$ that linear theory could tell, so `stability boundary` leaves it out.";
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
