// Names are UTF-8 everywhere in the program. The standard library converts them to paths by mbrtowc() of the C library,
// which on Windows supports only regional code pages. The linker replaces that function by this one (--wrap), which
// reads UTF-8.
#include <cerrno>
#include <cstdint>
#include <cwchar>

extern "C" std::size_t __wrap_mbrtowc(wchar_t* to, const char* from, std::size_t most, std::mbstate_t* state) {
  constexpr auto invalid = std::size_t(-1), incomplete = std::size_t(-2);
  static std::mbstate_t own_state{};
  std::mbstate_t& low_half = state != nullptr ? *state : own_state;
  if (from == nullptr) return low_half = 0, 0;
  if (most == 0) return incomplete;
  if (low_half != 0) {  // of a character of two units, whose last byte this is
    if (to != nullptr) *to = wchar_t(low_half);
    return low_half = 0, 1;
  }
  const auto byte = [from](std::size_t k) { return static_cast<unsigned char>(from[k]); };
  if (byte(0) < 0x80) {
    if (to != nullptr) *to = wchar_t(byte(0));
    return byte(0) != 0 ? 1 : 0;
  }
  const std::size_t bytes = byte(0) >= 0xF0 ? 4 : byte(0) >= 0xE0 ? 3 : 2;
  if (byte(0) < 0xC2 || byte(0) > 0xF4) return errno = EILSEQ, invalid;
  std::uint32_t code = byte(0) & (0x7Fu >> bytes);
  for (std::size_t k = 1; k < bytes; ++k) {
    if (k == most) return incomplete;
    if ((byte(k) & 0xC0) != 0x80) return errno = EILSEQ, invalid;
    code = code << 6 | (byte(k) & 0x3Fu);
  }
  if (code < 0x10000) {
    if (to != nullptr) *to = wchar_t(code);
    return bytes;
  }
  code -= 0x10000;
  if (to != nullptr) *to = wchar_t(0xD800 + (code >> 10));
  low_half = std::mbstate_t(0xDC00 + (code & 0x3FF));
  return bytes - 1;
}
