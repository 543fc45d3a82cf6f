#include "core/engines/opencl/program_features.h"

namespace tyglab::opencl {

std::string program_features(const Preset& preset, bool contacts) {
  std::string text;
  if (preset.k_d > 0) text += " -D DAMPING";
  if (preset.kind == Kind::one_weight) return text + " -D ONE_WEIGHT";
  if (preset.k_b > 0) text += " -D BENDING";
  if (preset.W != glm::dvec3(0)) text += " -D WIND";
  if (meets_bodies(preset)) text += contacts ? " -D BODIES -D CONTACTS" : " -D BODIES";
  return text;
}

}  // namespace tyglab::opencl
