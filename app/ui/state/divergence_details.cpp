#include "app/ui/state/ui.h"

#include <cmath>
#include <cstdio>

#include "app/base/text.h"
#include "core/forces/force.h"
#include "core/model/words.h"

namespace tyglab {

std::string what_happened(const Divergence& d, const Preset& then, double limit) {
  const std::string value = quantity(d.value, d.quantity == "velocity" ? "m/s" : "m");
  char text[256];
  std::snprintf(text, sizeof text, "At t = %s s (step %lld), %s: %s = %s.", time_number(d.t, then.dt).c_str(),
                static_cast<long long>(d.step), d.where().c_str(), d.quantity.c_str(), value.c_str());
  const bool cloth = then.kind == Kind::cloth;
  std::string all = std::string(text) + "\nWith " + std::string(force::stretch.constant(then)) + " = " +
                    quantity(cloth ? spring_constants(then).largest() : then.k, "N/m") +
                    ", k_d = " + quantity(then.k_d, "N s/m") + ", m = " + quantity(then.m, "kg") +
                    ", dt = " + quantity(then.dt, "s");
  if (limit > 0 && std::isfinite(limit))
    all += ", " + power_number(then.dt / limit, 2) + (cloth ? " times the worst-case limit" : " times the limit");
  return all + ".";
}

}  // namespace tyglab
