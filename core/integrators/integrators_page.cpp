#include "core/integrators/stabilized.h"

#include <sstream>

#include "core/integrators/scheme.h"

namespace tyglab {
namespace {

constexpr const char* head =
    R"(# Integrators

*`TYGLAB_WRITE_DOCS=1 build/release/bin/presets_tests` generates this page from the table of methods )"
    R"((core/integrators); a test checks that it is current.*

A method advances position and velocity from one time step to the next, using the acceleration $a = \ddot x(x, v)$ )"
    R"(of all forces. `--integrator NAME`, `solver.integrator` in a preset, or the first row of the sandbox's panel selects )"
    R"(it, even while the cloth moves. [accuracy.md](accuracy.md) measures which method is fastest for a given error, and )"
    R"([stability.md](stability.md) where each becomes unstable; [model.md](model.md#integrators) describes what they have )"
    R"(in common.

The *order* is that of the whole method, position and velocity, on a smooth motion: with order 2, half the step gives a )"
    R"(quarter of the error. No method keeps its order when springs switch between taut and slack. *h* is $dt$ (for `dopri5` )"
    R"(and `rkc2`, an inner step), $\omega$ the fastest angular frequency of the cloth, $\zeta$ its damping ratio.

)";

std::string order_of(const Scheme& scheme) {
  const std::string plain = std::to_string(scheme.order_undamped);
  return scheme.order_damped == scheme.order_undamped ? plain
                                                      : plain + ", damped " + std::to_string(scheme.order_damped);
}

/// The preset's keys that the method reads besides dt, and the studies that do not support it.
std::string particulars(const Scheme& scheme) {
  std::string text;
  if (chooses_steps(scheme)) text += " It uses `tolerance`.";
  if (iterates(scheme)) text += " It uses `iterations`.";
  if (chooses_steps(scheme))
    text += " Linear theory gives no limit of $dt$ for it, so `stability boundary` does not include it.";
  if (projects(scheme))
    text +=
        " It has no amplification matrix, since a step is not linear even for a linear cloth: `stability boundary` "
        "does "
        "not include it, and the sandbox's gauge shows no limit.";
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
