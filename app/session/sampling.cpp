#include "app/session/sampling.h"

#include <array>

#include "app/ui/app.h"
#include "app/ui/kit/curves.h"

namespace tyglab {

void sample(App& app) {
  Plots& plots = app.ui.plots;
  if (app.steps_made == 0) return;
  if (plots.paused || !plots.forces_shown) plots.forces.interrupt();
  if (plots.paused || !plots.height_shown) plots.height.interrupt();
  if (plots.paused || !app.copies.shown) app.copies.distance.interrupt(), app.copies.energy.interrupt();
  if (plots.paused) return;
  const FrameCosts::Timer timer(app.costs, Part::sample);
  const double t = app.simulation->time();
  if (plots.forces_shown && plots.source == Source::particle && app.picked) {
    plots.forces.add(t, force_values(app.simulation->particle(app.picked->i, app.picked->j)));
  } else if (plots.forces_shown && plots.source != Source::particle) {
    const auto reduction = plots.source == Source::sum ? Reduction::sum : Reduction::maximum;
    plots.forces.add(t, force_values(app.simulation->forces(reduction)));
  }
  if (app.copies.shown) sample_copies(app);
  if (plots.height_shown) {
    const double y = app.simulation->position(0, 0).y;
    const bool fresh = plots.height.empty() || t <= plots.height.t().back();
    if (fresh) plots.height_methods.clear();
    if (fresh || plots.height_methods.back().second != app.preset().integrator)
      plots.height_methods.emplace_back(t, app.preset().integrator);
    const ReferenceCurves::Heights others = app.figure.follow(*app.simulation, app.steps_made);
    const std::array row{y, others[0], others[1], others[2], others[3]};
    plots.height.add(t, row);
  }
}

}  // namespace tyglab
