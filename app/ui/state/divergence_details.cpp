#include "app/ui/state/ui.h"

#include <cmath>
#include <cstdio>

#include "app/base/text.h"

namespace tyglab {

std::string what_happened(const Divergence& d, const Preset& then, double limit) {
  const char* unit = d.quantity == "velocity" ? "m/s" : "m";
  char text[256];
  std::snprintf(text, sizeof text, "At t = %s s (step %lld), %s: %s = %s %s.", time_number(d.t, then.dt).c_str(),
                static_cast<long long>(d.step), d.where().c_str(), d.quantity.c_str(), short_number(d.value).c_str(),
                unit);
  const bool cloth = then.kind == Kind::cloth;
  std::string all = std::string(text) + "\nWith " +
                    (cloth ? "k_s = " + short_number(then.k_s) : "k = " + short_number(then.k)) +
                    " N/m, k_d = " + short_number(then.k_d) + " N s/m, m = " + short_number(then.m) +
                    " kg, dt = " + short_number(then.dt) + " s";
  if (limit > 0 && std::isfinite(limit))
    all += ", " + short_number(then.dt / limit, 2) + (cloth ? " times the worst-case limit" : " times the limit");
  return all + ".";
}

}  // namespace tyglab
