// What is printed steers no terminal, in whatever pieces it comes.
#include <doctest/doctest.h>

#include <iostream>
#include <sstream>

#include "core/io/terminal.h"

namespace tyglab::terminal_test {

TEST_CASE("all that a terminal acts on is spelled out, and nothing else is touched") {
  struct Case {
    std::string text, seen;
  };
  const Case cases[] = {
      {"plain\ttext\n", "plain\ttext\n"},
      {"", ""},
      {"Größe 32 × 32, ½ σ – 布 🧵", "Größe 32 × 32, ½ σ – 布 🧵"},
      {"\x1b[31mred\x1b]0;title\x07", "\\x1b[31mred\\x1b]0;title\\x07"},
      {"over\rwritten\b\v\f\x7f", "over\\x0dwritten\\x08\\x0b\\x0c\\x7f"},
      {std::string("a\0b", 3), "a\\x00b"},
      // C1: as UTF-8, and as the single byte that older terminals take.
      {"\xc2\x9b"
       "31m \xc2\x85",
       "\\u009b31m \\u0085"},
      {"\x9b"
       "31m",
       "\\x9b31m"},
      // Directions: a name that shows other than it is.
      {"a\u202Egpj.exe\u202C \u2066b\u2069 \u200E\u200F\u061C",
       "a\\u202egpj.exe\\u202c \\u2066b\\u2069 \\u200e\\u200f\\u061c"},
      {"a\u2028b\u2029\uFEFF", "a\\u2028b\\u2029\\ufeff"},
      // No UTF-8: too long, a surrogate, beyond the last, cut short.
      {"\xc0\x9b \xe0\x80\x9b", "\\xc0\\x9b \\xe0\\x80\\x9b"},
      {"\xed\xa0\x80", "\\xed\\xa0\\x80"},
      {"\xf4\x90\x80\x80", "\\xf4\\x90\\x80\\x80"},
      {"cut \xe5\xb8", "cut \\xe5\\xb8"},
      {"cut \xe5\xb8|", "cut \\xe5\\xb8|"},
  };
  for (const Case& c : cases) {
    CAPTURE(c.seen);
    CHECK(visible(c.text) == c.seen);
    CHECK(visible(c.seen) == c.seen);
  }
}

TEST_CASE("every control character alone, of each kind") {
  for (int code = 0; code < 0x20; ++code) {
    const bool stays = code == '\n' || code == '\t';
    CHECK((visible(std::string(1, char(code))).size() == 1) == stays);
  }
  for (int code = 0x80; code < 0xa0; ++code) {
    CHECK(visible(std::string(1, char(code))).size() == 4);
    CHECK(visible(std::string("\xc2") + char(code)).size() == 6);
  }
}

}  // namespace tyglab::terminal_test
