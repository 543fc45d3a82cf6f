// Where along a constant a method is stable, near its limit or unstable, the others being as they are: by linear
// theory, for any configuration of the springs (modes.h).
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "core/model/preset.h"

namespace tyglab {

enum class Zone { stable, near, unstable };  ///< near: dt is above 0.9 of the limit

struct ZoneSpan {
  double from, to;  ///< values of the constant
  Zone zone;
};

/// A constant that decides over stability.
struct ZonedConstant {
  std::string_view key;
  double Preset::*field;
};
/// L has one zone only: the largest frequency does not depend on rest lengths, √((12 k_s + 8 k_b)/m), and a slider that
/// shows so says that shortening springs is no fix.
inline constexpr std::array<ZonedConstant, 6> zoned_cloth{{{"dt", &Preset::dt},
                                                           {"k_s", &Preset::k_s},
                                                           {"k_b", &Preset::k_b},
                                                           {"k_d", &Preset::k_d},
                                                           {"m", &Preset::m},
                                                           {"L", &Preset::L}}};
inline constexpr std::array<ZonedConstant, 5> zoned_weight{
    {{"dt", &Preset::dt}, {"k", &Preset::k}, {"k_d", &Preset::k_d}, {"m", &Preset::m}, {"L", &Preset::L}}};

/// The present zone. stable for methods that no dt makes unstable.
Zone zone_of(const Preset& preset);

/// The zones from `least` (above 0) to `most` without gaps, borders within a thousandth of themselves. The first begins
/// at 0 where the constant may be 0 and is in that zone there too.
std::vector<ZoneSpan> stability_zones(const Preset& preset, double Preset::*field, double least, double most);

}  // namespace tyglab
