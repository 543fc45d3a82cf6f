
#include "core/io/terminal.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <iostream>
#include <streambuf>

#include "core/io/output_file.h"
#include "core/io/system_files.h"

namespace tyglab {
namespace {

/// A character at the beginning of a text.
struct Character {
  std::size_t bytes = 1;
  std::uint32_t code = 0;
  bool valid = false;    ///< UTF-8
  bool complete = true;  ///< false: the text ends within it
};

Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  if (byte(0) < 0x80) return {1, byte(0), true};
  const std::size_t bytes = byte(0) >= 0xF0 ? 4 : byte(0) >= 0xE0 ? 3 : 2;
  constexpr std::array<std::uint32_t, 5> smallest{0, 0, 0x80, 0x800, 0x10000};
  constexpr std::uint32_t largest = 0x10FFFF, surrogates = 0xD800, beyond_surrogates = 0xE000;
  if (byte(0) < 0xC2 || byte(0) > 0xF4) return {};
  std::uint32_t code = byte(0) & (0x7Fu >> bytes);
  for (std::size_t k = 1; k < bytes; ++k) {
    if (k == text.size()) return {k, 0, false, false};
    if ((byte(k) & 0xC0) != 0x80) return {};
    code = code << 6 | (byte(k) & 0x3F);
  }
  if (code < smallest[bytes] || code > largest || (code >= surrogates && code < beyond_surrogates)) return {};
  return {bytes, code, true};
}

bool is_shown(std::uint32_t code) {
  if (code < 0x20) return code == '\n' || code == '\t';
  if (code >= 0x7F && code < 0xA0) return false;
  // Marks, embeddings, overrides and isolates of direction; separators of lines and paragraphs.
  constexpr std::array<std::pair<std::uint32_t, std::uint32_t>, 5> hidden{
      {{0x061C, 0x061C}, {0x200E, 0x200F}, {0x2028, 0x202E}, {0x2066, 0x2069}, {0xFEFF, 0xFEFF}}};
  return std::none_of(hidden.begin(), hidden.end(),
                      [code](const auto& range) { return code >= range.first && code <= range.second; });
}

void append_code(std::string& text, const char* format, unsigned code) {
  std::array<char, 16> spelled{};
  std::snprintf(spelled.data(), spelled.size(), format, code);
  text += spelled.data();
}

/// Appends what is seen of the text; returns the bytes of a character that has only begun, at its end.
std::size_t append_visible(std::string& seen, std::string_view text) {
  while (!text.empty()) {
    const Character character = first_character(text);
    if (!character.complete) return text.size();
    if (!character.valid)
      append_code(seen, "\\x%02x", static_cast<unsigned char>(text[0]));
    else if (!is_shown(character.code))
      append_code(seen, character.code < 0x80 ? "\\x%02x" : "\\u%04x", character.code);
    else
      seen += text.substr(0, character.bytes);
    text.remove_prefix(character.bytes);
  }
  return 0;
}

/// Passes text on to another buffer as it is seen.
class Filter final : public std::streambuf {
 public:
  explicit Filter(std::streambuf& to) : to_(to) {}

 private:
  int_type overflow(int_type byte) override {
    if (traits_type::eq_int_type(byte, traits_type::eof())) return traits_type::not_eof(byte);
    const char letter = traits_type::to_char_type(byte);
    return xsputn(&letter, 1) == 1 ? byte : traits_type::eof();
  }
  std::streamsize xsputn(const char* text, std::streamsize size) override {
    begun_.append(text, std::size_t(size));
    std::string seen;
    const std::size_t left = append_visible(seen, begun_);
    begun_.erase(0, begun_.size() - left);
    const auto length = std::streamsize(seen.size());
    return to_.sputn(seen.data(), length) == length ? size : 0;
  }
  int sync() override { return to_.pubsync(); }

  std::streambuf& to_;
  std::string begun_;  ///< the first bytes of a character
};

/// The streams around the filters. It lives until the process ends, as std::cout does.
struct Streams {
  std::streambuf& out = *std::cout.rdbuf();
  std::streambuf& err = *std::cerr.rdbuf();
  Filter seen_out{out}, seen_err{err};
  std::ostream files{os::is_terminal(os::standard_output) ? static_cast<std::streambuf*>(&seen_out) : &out};
  std::ostream cursor{&err};
};

Streams* streams = nullptr;

}  // namespace

std::string visible(std::string_view text) {
  std::string seen;
  const std::size_t left = append_visible(seen, text);
  for (const char byte : text.substr(text.size() - left))
    append_code(seen, "\\x%02x", static_cast<unsigned char>(byte));
  return seen;
}

std::string in_one_line(std::string_view text) {
  std::string line;
  for (const char c : visible(text))
    if (c == '\n' || c == '\t')
      append_code(line, "\\x%02x", static_cast<unsigned char>(c));
    else
      line += c;
  return line;
}

void filter_standard_streams() {
  if (streams != nullptr) return;
  streams = new Streams;
  std::cout.rdbuf(&streams->seen_out), std::cerr.rdbuf(&streams->seen_err);
}

std::ostream& file_output() {
  return streams != nullptr ? streams->files : std::cout;
}

std::ostream& cursor_output() {
  return streams != nullptr ? streams->cursor : std::cerr;
}

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
