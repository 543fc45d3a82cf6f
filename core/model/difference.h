// One constant with a separate value: the difference between a copy and its original.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

#include "core/model/notation.h"
#include "core/model/preset.h"

namespace tyglab {

class Difference {
 public:
  /// {&Preset::dt, 0.001}
  template <class T>
  Difference(T Preset::*field, std::type_identity_t<T> value) : constant_(OfPreset<T>{field, std::move(value)}) {}
  /// {0, &Body::r, 0.1}: of the first body.
  template <class T>
  Difference(std::size_t body, T Body::*field, std::type_identity_t<T> value)
      : constant_(OfBody<T>{body, field, std::move(value)}) {}
  /// Of a row that holds one number (a whole one is rounded to); throws std::bad_variant_access for others.
  Difference(const PresetRow& row, double value);
  Difference(std::size_t body, const BodyRow& row, double value);

  /// Sets that value in the preset. Returns false, without a change, if the preset has no such body.
  bool apply(Preset& preset) const;
  /// The same constant with its value in the preset; none if the preset has no such body.
  std::optional<Difference> in(const Preset& preset) const;
  /// The value, if the constant is that one.
  template <class T>
  const T* value_of(T Preset::*field) const {
    const auto* constant = std::get_if<OfPreset<T>>(&constant_);
    return constant != nullptr && constant->field == field ? &constant->value : nullptr;
  }

  /// As --set names it: "dt", "bodies[0].r".
  std::string key() const;
  /// The value for people; numbers have up to that many significant digits.
  std::string value_text(int digits = 6) const;
  /// "dt=0.001"
  std::string text() const { return key() + "=" + value_text(); }

  bool operator==(const Difference&) const = default;

 private:
  template <class T>
  struct OfPreset {
    T Preset::*field;
    T value;
    bool operator==(const OfPreset&) const = default;
  };
  template <class T>
  struct OfBody {
    std::size_t body;
    T Body::*field;
    T value;
    bool operator==(const OfBody&) const = default;
  };
  using Constant = std::variant<OfPreset<double>, OfPreset<int>, OfPreset<glm::dvec3>, OfPreset<std::string>,
                                OfPreset<EngineKind>, OfPreset<Precision>, OfBody<double>, OfBody<glm::dvec3>>;
  static Constant constant_of(const PresetRow& row, double value);

  Constant constant_;
};

}  // namespace tyglab
