#include "core/model/fields.h"

#include <array>

namespace tyglab {
namespace {

using enum Effect;

const std::array<PresetField, 8> no_rows{{{"kind", &Preset::kind, rebuild},
                                          {"name", &Preset::name, name},
                                          {"description", &Preset::description, name},
                                          {"pins", &Preset::pins, pins},
                                          {"bodies", &Preset::bodies, bodies},
                                          {"engine", &Preset::engine, engine},
                                          {"device", &Preset::device, device},
                                          {"precision", &Preset::precision, precision}}};

std::vector<PresetField> all_fields() {
  std::vector<PresetField> all(no_rows.begin(), no_rows.end());
  for (const PresetRow& row : notation())
    std::visit([&](auto member) { all.push_back({row.key, member, row.effect, &row}); }, row.field);
  return all;
}

}  // namespace

std::span<const PresetField> preset_fields() {
  static const std::vector<PresetField> all = all_fields();
  return all;
}

EffectSet effects_of(const PresetField& field, const Preset& preset) {
  if (field.row == nullptr)
    return field.effect == device && preset.engine != EngineKind::opencl ? unused : field.effect;
  if (field.row->only_one_kind && field.row->only != preset.kind) return unused;
  return preset.kind == Kind::one_weight ? field.effect | field.row->of_weight : field.effect;
}

}  // namespace tyglab
