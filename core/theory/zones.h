// The zones of a constant, with the others fixed, in which a method is stable in any shape of the cloth,
// depends on the shape, or is unstable in every shape: by linear theory (docs/model.md, "What the shape
// decides").
#pragma once

#include <string_view>
#include <vector>

#include "core/model/preset.h"

namespace tyglab {

/// stable: in any shape of the cloth. depends: some shapes are stable, others are not. unstable: in every shape in
/// which at least one spring pulls, or in every shape at all where damping alone is too much. A mass on a spring has
/// only one shape, so it has no zone `depends`.
enum class Zone { stable, depends, unstable };

/// "stable in any shape", "depends on the shape", "unstable in every shape"; of a mass on a spring "stable",
/// "unstable".
std::string_view zone_name(Zone zone, Kind kind);

struct ZoneSpan {
  double from, to;  ///< values of the constant
  Zone zone;
};

/// A constant that affects stability.
struct ZonedConstant {
  std::string_view key;
  double Preset::*field;
};
/// Those of the preset's kind: dt, a constant for each force that has one, k_d, m and L. L has one zone only: the
/// largest frequency of springs does not depend on rest lengths, and its slider shows that shorter ones are no remedy.
std::vector<ZonedConstant> zoned_constants(const Preset& preset);

/// The present zone; `stable` for methods that are stable at every dt.
Zone zone_of(const Preset& preset);

/// dt (s) above which the method is unstable in every shape: at least the worst-case limit (stable_dt), within a
/// thousandth; 0 where no dt is stable in any, infinity where the method has no limit.
double every_shape_limit(const Preset& preset);

/// The zones from `least` (above 0) to `most` without gaps, borders within a thousandth of themselves. The first begins
/// at 0 where the constant may be 0 and is in that zone there too. Where rounding decides, so that zones take turns,
/// some of them are left out. Once it is stopped, the result is meaningless.
std::vector<ZoneSpan> stability_zones(const Preset& preset, double Preset::*field, double least, double most,
                                      const Stop& stop = {});

}  // namespace tyglab
