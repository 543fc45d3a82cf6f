#include "app/render/staging.h"

#include <algorithm>
#include <cmath>

namespace tyglab {

float drawn_radius(const Body& sphere, double L) {
  const double r = sphere.r;
  return float(std::max(0.99 * r - L * L / (3 * r), 0.8 * r));
}

float grid_spacing(float radius) {
  const float wish = radius / 5, decade = std::pow(10.0f, std::floor(std::log10(wish)));
  const float part = wish / decade;
  return decade * (part < 2 ? 1.0f : part < 5 ? 2.0f : 5.0f);
}

}  // namespace tyglab
