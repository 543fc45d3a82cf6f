#include "core/io/text.h"

#include <array>
#include <charconv>

namespace tyglab {

void append_number(std::string& text, double value, int digits) {
  std::array<char, 32> buffer;
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, digits);
  text.append(buffer.data(), end.ptr);
}

}  // namespace tyglab
