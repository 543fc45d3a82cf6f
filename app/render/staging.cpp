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

glm::vec4 shadow_area(const Bounds& box, glm::vec3 to_light, float ground) {
  Bounds shadow;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec3 p(corner & 1 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y,
                      corner & 4 ? box.hi.z : box.lo.z);
    shadow.add(p - to_light * ((p.y - ground) / to_light.y));
  }
  const glm::vec3 margin = 0.05f * (box.hi - box.lo);
  return {shadow.lo.x - margin.x, shadow.lo.z - margin.z, shadow.hi.x + margin.x, shadow.hi.z + margin.z};
}

}  // namespace tyglab
