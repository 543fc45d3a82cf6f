// Why a text is not JSON, in words for the person who wrote it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace tyglab {

struct JsonFault {
  std::size_t at = 0;     ///< byte at which it is seen
  bool end = false;       ///< the text ends too early; `at` is its last character
  std::string why;        ///< what was expected, and the fix
  bool of_value = false;  ///< it is about a value that the parser has come to, not about the text's form
};

/// The first place at which the text breaks JSON's grammar; none where it does not. Asked only when a parser has
/// refused the text: it finds words, not values.
std::optional<JsonFault> find_json_fault(std::string_view text);

}  // namespace tyglab
