// Sends the results of studies as bytes from a copy of the program to the program itself (app/platform/platform.h).
//
// A type that is not plain memory lists its parts in visit_parts(visit, object), which calls visit(part, …) once with
// all of them; structured bindings turn a forgotten part into a compiler error.
#pragma once

#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/io/preset_io.h"

namespace tyglab {

/// Appends objects to bytes.
class BytesWriter {
 public:
  std::string bytes;

  template <class T>
  void operator()(T& object) {
    if constexpr (std::is_trivially_copyable_v<T>)
      bytes.append(reinterpret_cast<const char*>(&object), sizeof object);
    else
      visit_parts([this](auto&... parts) { ((*this)(parts), ...); }, object);
  }
  void operator()(std::string& text) {
    std::size_t size = text.size();
    (*this)(size);
    bytes += text;
  }
  void operator()(Preset& preset) {
    std::string text = preset_to_json(preset);
    (*this)(text), (*this)(preset.device);
  }
  template <class T>
  void operator()(std::vector<T>& list) {
    std::size_t size = list.size();
    (*this)(size);
    for (T& object : list) (*this)(object);
  }
  template <class T>
  void operator()(std::optional<T>& object) {
    bool there = object.has_value();
    (*this)(there);
    if (there) (*this)(*object);
  }
};

/// Takes objects from bytes that a BytesWriter of the same program has written.
class BytesReader {
 public:
  explicit BytesReader(std::string_view bytes) : bytes_(bytes) {}

  template <class T>
  void operator()(T& object) {
    if constexpr (std::is_trivially_copyable_v<T>)
      std::memcpy(static_cast<void*>(&object), take(sizeof object).data(), sizeof object);
    else
      visit_parts([this](auto&... parts) { ((*this)(parts), ...); }, object);
  }
  void operator()(std::string& text) {
    std::size_t size = 0;
    (*this)(size);
    text = take(size);
  }
  void operator()(Preset& preset) {
    std::string text;
    (*this)(text);
    preset = parse_preset(text, "a study");
    (*this)(preset.device);
  }
  template <class T>
  void operator()(std::vector<T>& list) {
    std::size_t size = 0;
    (*this)(size);
    list.resize(size);
    for (T& object : list) (*this)(object);
  }
  template <class T>
  void operator()(std::optional<T>& object) {
    bool there = false;
    (*this)(there);
    object.reset();
    if (there) (*this)(object.emplace());
  }

 private:
  std::string_view take(std::size_t count) {
    const std::string_view taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }
  std::string_view bytes_;
};

/// Whether there is a way to make bytes of such an object.
template <class T>
concept Transferable = std::is_trivially_copyable_v<T> || requires(T& object, void (*visit)(...)) {
  visit_parts(visit, object);
};

template <class T>
std::string bytes_of(T object) {
  BytesWriter writer;
  writer(object);
  return std::move(writer.bytes);
}
template <class T>
T from_bytes(std::string_view bytes) {
  T object{};
  BytesReader reader(bytes);
  reader(object);
  return object;
}

}  // namespace tyglab
