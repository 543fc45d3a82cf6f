
#include "core/model/preset.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <utility>

namespace tyglab {

// With s springs of constant k_s abreast and s in series, stiffness against stretching does not depend on the
// resolution; a spring's share of a given load falls as 1/q, a triangle's share of a given wind as 1/q².
Preset with_resolution(const Preset& preset, double q) {
  Preset fine = preset;
  const auto scaled = [q](int count) { return int(std::llround((count - 1) * q)) + 1; };
  fine.rows = std::clamp(scaled(preset.rows), 2, 4096);
  fine.columns = preset.columns == 1 ? 1 : std::clamp(scaled(preset.columns), 2, 4096);
  // Rounding and the ends of the range decide the factor that is really taken.
  const double taken = double(fine.rows - 1) / (preset.rows - 1);
  fine.L = preset.L / taken;
  fine.F_max = preset.F_max / taken;
  fine.W = preset.W / (taken * taken);
  fine.dt = preset.dt / taken;
  fine.m = preset.m * (double(preset.rows) * preset.columns) / (double(fine.rows) * fine.columns);
  const auto in_fine = [&](std::vector<Pins::Site>& list) {
    for (const Pins::Site& pin : std::exchange(list, {}))
      if (const Pins::Site site = site_in_resolution(pin, preset, fine);
          std::find(list.begin(), list.end(), site) == list.end())
        list.push_back(site);
  };
  in_fine(fine.pins.list);
  for (Pins::Motion& motion : fine.pins.motions) in_fine(motion.list);
  return fine;
}

Pins::Site site_in_resolution(Pins::Site site, const Preset& from, const Preset& to) {
  const auto moved = [](int index, int count, int new_count) {
    return count > 1 ? int(std::llround(index * (double(new_count - 1) / (count - 1)))) : 0;
  };
  return {moved(site.i, from.rows, to.rows), moved(site.j, from.columns, to.columns)};
}

double thread_seconds() {
  timespec now{};
  if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now) != 0) return wall_seconds();
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double computing_seconds(EngineKind engine) {
  return engine == EngineKind::opencl ? wall_seconds() : thread_seconds();
}

}  // namespace tyglab
