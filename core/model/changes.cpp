#include "core/model/effect.h"

#include "core/model/fields.h"

namespace tyglab {

EffectSet changes(const Preset& from, const Preset& to) {
  EffectSet all;
  for (const PresetField& field : preset_fields())
    if (!std::visit([&](auto member) { return from.*member == to.*member; }, field.member))
      all |= effects_of(field, to);
  return all;
}

Preset merge(const Preset& before, const Preset& after, Preset present) {
  for (const PresetField& field : preset_fields())
    std::visit(
        [&](auto member) {
          if (!(before.*member == after.*member)) present.*member = after.*member;
        },
        field.member);
  return present;
}

Preset cleared(Preset preset, EffectSet effects) {
  static const Preset defaults;
  for (const PresetField& field : preset_fields()) {
    if (!effects.touches(field.effect)) continue;
    if (const auto* words = std::get_if<std::string Preset::*>(&field.member))
      (preset.**words).clear();
    else
      std::visit([&](auto member) { preset.*member = defaults.*member; }, field.member);
  }
  return preset;
}

}  // namespace tyglab
