// All fields of a preset: the rows of the notation table, and the few other keys.
#pragma once

#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "core/model/effect.h"
#include "core/model/notation.h"
#include "core/model/preset.h"

namespace tyglab {

struct PresetField {
  using Member =
      std::variant<double Preset::*, int Preset::*, glm::dvec3 Preset::*, std::string Preset::*, Kind Preset::*,
                   EngineKind Preset::*, Precision Preset::*, Pins Preset::*, std::vector<Body> Preset::*>;
  std::string_view key;  ///< as files name it
  Member member;
  Effect effect;
  const PresetRow* row = nullptr;  ///< of the notation table, where it has one
};

/// Comparisons ignore a field that is missing here, so a test counts the fields.
std::span<const PresetField> preset_fields();
/// The effects of a change of the field in a scene that has become `preset`.
EffectSet effects_of(const PresetField& field, const Preset& preset);

}  // namespace tyglab
