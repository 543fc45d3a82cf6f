#include "core/io/text.h"

#include <array>
#include <charconv>
#include <cmath>

#include "core/io/files.h"

namespace tyglab {

void append_number(std::string& text, double value, int digits) {
  if (!std::isfinite(value)) return;
  std::array<char, 32> buffer;
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, digits);
  text.append(buffer.data(), end.ptr);
}

float float_coordinate(double value) {
  const auto coordinate = static_cast<float>(value);
  if (std::isfinite(coordinate)) return coordinate;
  throw OutputError(
      "A position is too large for files of meshes, which hold floats: up to 3.4e38 m; end the run earlier");
}

}  // namespace tyglab
