#include "app/base/file_names.h"

#include <cstdint>

namespace tyglab {
namespace {

/// The letters from U+00C0 to U+017F without their marks; '_' for what is no letter.
constexpr std::string_view plain_letters =
    "aaaaaaaceeeeiiiidnooooo_ouuuuytsaaaaaaaceeeeiiiidnooooo_ouuuuyty"
    "aaaaaaccccccccddddeeeeeeeeeegggggggghhhhiiiiiiiiiiiijjkkklllllll"
    "lllnnnnnnnnnoooooooorrrrrrssssssssttttttuuuuuuuuuuuuwwyyyzzzzzzs";
constexpr std::uint32_t first_marked = 0xC0, end_marked = 0x180;
static_assert(plain_letters.size() == end_marked - first_marked);

/// The code point that begins there, of which `at` is moved to the end; 0 where the text is not UTF-8.
std::uint32_t next_code_point(std::string_view text, std::size_t& at) {
  const auto byte = [&](std::size_t n) { return n < text.size() ? std::uint32_t(std::uint8_t(text[n])) : 0; };
  const std::uint32_t first = byte(at++);
  if (first < 0x80) return first;
  if ((first & 0xE0) == 0xC0 && (byte(at) & 0xC0) == 0x80) return (first & 0x1F) << 6 | (byte(at++) & 0x3F);
  while ((byte(at) & 0xC0) == 0x80) ++at;
  return 0;
}

char plain_letter(std::uint32_t letter) {
  if ((letter >= 'a' && letter <= 'z') || (letter >= '0' && letter <= '9')) return char(letter);
  if (letter >= 'A' && letter <= 'Z') return char(letter - 'A' + 'a');
  return letter >= first_marked && letter < end_marked ? plain_letters[letter - first_marked] : '_';
}

}  // namespace

std::string plain_file_name(std::string_view name) {
  std::string file;
  for (std::size_t at = 0; at < name.size();) {
    const std::uint32_t letter = next_code_point(name, at);
    // Marks that follow their letter (U+0300 to U+036F) are left out too.
    if (letter >= 0x300 && letter < 0x370) continue;
    const char plain = plain_letter(letter);
    if (plain != '_' || (!file.empty() && file.back() != '_')) file += plain;
  }
  while (!file.empty() && file.back() == '_') file.pop_back();
  return file;
}

}  // namespace tyglab
