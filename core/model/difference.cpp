#include "core/model/difference.h"

#include <algorithm>
#include <cmath>

#include "core/model/fields.h"
#include "core/model/notation.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

std::string key_of(const PresetField::Member& member) {
  const auto fields = preset_fields();
  return std::string(
      std::find_if(fields.begin(), fields.end(), [&](const auto& f) { return f.member == member; })->key);
}
std::string key_of(const FieldOf<Body>& member) {
  const auto rows = body_notation();
  return std::string(std::find_if(rows.begin(), rows.end(), [&](const auto& r) { return r.field == member; })->key);
}

std::string text_of(double value, int digits) {
  return short_number(value, digits);
}
std::string text_of(const glm::dvec3& v, int digits) {
  return "[" + text_of(v.x, digits) + ", " + text_of(v.y, digits) + ", " + text_of(v.z, digits) + "]";
}
std::string text_of(const std::string& value, int) {
  return value;
}
std::string text_of(EngineKind value, int) {
  return std::string(name_of(value));
}
std::string text_of(Precision value, int) {
  return std::string(name_of(value));
}

}  // namespace

Difference::Constant Difference::constant_of(const PresetRow& row, double value) {
  if (const auto* whole = std::get_if<int Preset::*>(&row.field)) return OfPreset<int>{*whole, int(std::lround(value))};
  return OfPreset<double>{std::get<double Preset::*>(row.field), value};
}

Difference::Difference(const PresetRow& row, double value) : constant_(constant_of(row, value)) {}

Difference::Difference(std::size_t body, const BodyRow& row, double value)
    : constant_(OfBody<double>{body, std::get<double Body::*>(row.field), value}) {}

bool Difference::apply(Preset& preset) const {
  return std::visit(
      [&](const auto& constant) {
        if constexpr (requires { constant.body; }) {
          if (constant.body >= preset.bodies.size()) return false;
          preset.bodies[constant.body].*constant.field = constant.value;
        } else {
          preset.*constant.field = constant.value;
        }
        return true;
      },
      constant_);
}

std::optional<Difference> Difference::in(const Preset& preset) const {
  return std::visit(
      [&](const auto& constant) -> std::optional<Difference> {
        if constexpr (requires { constant.body; }) {
          if (constant.body >= preset.bodies.size()) return std::nullopt;
          return Difference(constant.body, constant.field, preset.bodies[constant.body].*constant.field);
        } else {
          return Difference(constant.field, preset.*constant.field);
        }
      },
      constant_);
}

std::string Difference::key() const {
  return std::visit(
      [](const auto& constant) -> std::string {
        if constexpr (requires { constant.body; })
          return "bodies[" + std::to_string(constant.body) + "]." + key_of(FieldOf<Body>(constant.field));
        else
          return key_of(PresetField::Member(constant.field));
      },
      constant_);
}

std::string Difference::value_text(int digits) const {
  const auto* number = std::get_if<OfPreset<double>>(&constant_);
  if (const PresetRow* row = number == nullptr ? nullptr : find_row(key()); row && is_absent(*row, number->value))
    return std::string(row->otherwise);
  return std::visit([&](const auto& constant) { return text_of(constant.value, digits); }, constant_);
}

}  // namespace tyglab
