#include "core/io/json_fault.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>

namespace tyglab {
namespace {

constexpr int max_depth = 64;  // a bound keeps recursion safe

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

/// Bytes of the UTF-8 character that begins the text; 0 if none does (RFC 3629).
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0u; };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xC2 && first <= 0xDF ? 2 : first <= 0xEF ? 3 : first <= 0xF4 ? 4 : 0;
  if (first < 0xC2 || length == 0) return 0;
  for (std::size_t k = 1; k < length; ++k)
    if ((byte(k) & 0xC0) != 0x80) return 0;
  const bool overlong = (first == 0xE0 && byte(1) < 0xA0) || (first == 0xF0 && byte(1) < 0x90);
  const bool no_character = (first == 0xED && byte(1) > 0x9F) || (first == 0xF4 && byte(1) > 0x8F);
  return overlong || no_character ? 0 : length;
}

/// Walks over the text by JSON's grammar (RFC 8259). Its functions return false once the fault is found.
class Walker {
 public:
  explicit Walker(std::string_view text) : text_(text) {}

  std::optional<JsonFault> fault() {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
    skip_space();
    if (ended()) return JsonFault{0, true, "it is empty; it must be at least {}", false};
    if (value()) {
      skip_space();
      if (!ended()) fail("the preset ends before this; remove what follows its closing }");
    }
    return fault_;
  }

 private:
  bool ended() const { return at_ >= text_.size(); }
  char now() const { return ended() ? '\0' : text_[at_]; }
  bool sees(char c) const { return !ended() && text_[at_] == c; }
  void skip_space() {
    while (sees(' ') || sees('\t') || sees('\n') || sees('\r')) ++at_;
  }
  bool fail_at(std::size_t at, std::string why) {
    fault_ = JsonFault{at, false, std::move(why), false};
    return false;
  }
  bool fail(std::string why) { return fail_at(at_, std::move(why)); }
  /// The text ends where more must come.
  bool fail_end(std::string why) {
    const std::size_t last = text_.find_last_not_of(" \t\r\n");
    fault_ = JsonFault{last == std::string_view::npos ? 0 : last, true, std::move(why), false};
    return false;
  }
  std::string word() const {
    std::size_t end = at_;
    while (end < text_.size() && end < at_ + 40 && (is_letter(text_[end]) || is_digit(text_[end]))) ++end;
    return std::string(text_.substr(at_, end - at_));
  }
  std::string quoted_word() const { return "\"" + word() + "\""; }

  bool value() {
    const char c = now();
    if (c == '{') return block();
    if (c == '[') return list();
    if (c == '"') return string();
    if (c == '-' || is_digit(c)) return number();
    for (const std::string_view literal : {"true", "false", "null"})
      if (word() == literal) return at_ += literal.size(), true;
    return no_value();
  }
  /// What to say where a value should begin and does not.
  bool no_value() {
    const char c = now();
    if (ended()) return fail_end("it ends where a value is expected");
    if (comment() || not_text()) return false;
    if (depth_ == 0) return fail("a preset is a JSON object, so it begins with {");
    if (c == '\'') return fail("strings are written in double quotes: \"…\", not '…'");
    if (c == '+') return fail("a number has no + sign; remove it");
    if (c == '.') return fail("a number begins with a digit: 0.5, not .5");
    if (c == ',') return fail("a value is missing before this comma");
    const std::string name = word();
    if (name == "NaN" || name == "nan" || name == "Infinity" || name == "inf")
      return fail("a number must be finite, such as 1.5 or 2e-3");
    if (name == "True" || name == "False") return fail("write true or false in lowercase");
    if (name == "None") return fail("write null instead of None");
    if (!name.empty()) return fail("strings are written in double quotes: \"" + name + "\"");
    return fail("a value was expected here: a number, a \"string\", a [list] or an object {…}");
  }
  /// Says so, and returns true, if bytes stand here that are no text at all.
  bool not_text() {
    if (utf8_length(text_.substr(at_)) == 0) fail("these bytes are not UTF-8 text; save the file as UTF-8");
    return fault_.has_value();
  }
  bool comment() {
    if (!sees('/') && !sees('#')) return false;
    fail("JSON has no comments; remove it, or move it into the preset's \"description\"");
    return true;
  }

  bool block() {
    const std::size_t open = at_++;
    return items(open, '}', [this] { return member(); });
  }
  bool list() {
    const std::size_t open = at_++;
    return items(open, ']', [this] { return value(); });
  }
  /// Items between commas up to `close`.
  template <class Item>
  bool items(std::size_t open, char close, const Item& item) {
    if (++depth_ > max_depth) return fail("nested too deeply for a preset");
    skip_space();
    bool first = true;
    while (!sees(close) || !first) {
      if (ended()) return never_closed(open, close);
      if (sees(close))
        return fail_at(
            comma_, std::string("nothing follows this comma; remove it, or add what is missing before the ") + close);
      if (!item()) return false;
      skip_space();
      if (sees(close)) break;
      if (!sees(',')) return no_comma(open, close);
      comma_ = at_++;
      first = false;
      skip_space();
    }
    ++at_, --depth_;
    return true;
  }
  bool never_closed(std::size_t open, char close) {
    std::size_t line = 1;
    for (std::size_t k = 0; k < open; ++k) line += text_[k] == '\n';
    return fail_end(std::string("the ") + text_[open] + " of line " + std::to_string(line) +
                    " is never closed; add its " + close);
  }
  bool no_comma(std::size_t open, char close) {
    if (ended()) return never_closed(open, close);
    if (comment()) return false;
    const char c = now();
    if (c == '}' || c == ']')
      return fail(std::string("the ") + text_[open] + " before it is closed by " + close + ", not by " + c);
    if (c == '"' || c == '{' || c == '[' || c == '-' || is_digit(c) || is_letter(c))
      return fail("a comma is missing before this");
    return not_text() ? false : fail(std::string("a comma or ") + close + " was expected here");
  }
  bool member() {
    if (!sees('"')) return no_key();
    const std::size_t begin = at_;
    if (!string()) return false;
    const std::string key(text_.substr(begin, std::min<std::size_t>(at_ - begin, 60)));
    skip_space();
    if (ended()) return fail_end("it ends after the key " + key + "; a colon and its value are missing");
    if (sees('=')) return fail("write a colon between a key and its value, not =");
    if (!sees(':')) return fail("a colon is missing after the key " + key);
    ++at_;
    skip_space();
    return value();
  }
  bool no_key() {
    if (comment()) return false;
    if (sees('\'')) return fail("keys are written in double quotes: \"…\", not '…'");
    if (is_letter(now())) return fail("keys are written in double quotes: " + quoted_word());
    if (sees(',')) return fail("one comma is enough; remove this one");
    return not_text() ? false : fail("a key in double quotes was expected here, such as \"k_s\"");
  }

  bool string() {
    const std::size_t open = at_++;
    while (!sees('"')) {
      if (ended() || sees('\n') || sees('\r')) return fail_at(open, "the string that begins here lacks its closing \"");
      if (static_cast<unsigned char>(now()) < ' ')
        return fail("a string cannot contain this character; write \\t for a tab");
      if (sees('\\')) {
        if (!escape()) return false;
        continue;
      }
      const std::size_t length = utf8_length(text_.substr(at_));
      if (length == 0) return fail("these bytes are not UTF-8 text; save the file as UTF-8");
      at_ += length;
    }
    ++at_;
    return true;
  }
  bool escape() {
    const char c = at_ + 1 < text_.size() ? text_[at_ + 1] : '\0';
    if (c == 'u') return unicode_escape();
    if (c == '\0' || std::string_view("\"\\/bfnrt").find(c) == std::string_view::npos)
      return fail("JSON has no such escape; write \\\\ for a backslash");
    at_ += 2;
    return true;
  }
  /// The code of \uXXXX here; -1 if it is none.
  int unicode() const {
    if (text_.substr(at_, 2) != "\\u" || text_.size() < at_ + 6) return -1;
    for (std::size_t k = at_ + 2; k < at_ + 6; ++k)
      if (std::isxdigit(static_cast<unsigned char>(text_[k])) == 0) return -1;
    return int(std::strtol(std::string(text_.substr(at_ + 2, 4)).c_str(), nullptr, 16));
  }
  bool unicode_escape() {
    const std::size_t begin = at_;
    const int code = unicode();
    if (code < 0) return fail("four hexadecimal digits must follow \\u, as in \\u00e5");
    at_ += 6;
    if (code < 0xD800 || code > 0xDFFF) return true;
    const int second = unicode();
    if (code > 0xDBFF || second < 0xDC00 || second > 0xDFFF)
      return fail_at(begin, "half a surrogate pair; write the character itself");
    at_ += 6;
    return true;
  }

  bool digits() {
    if (!is_digit(now())) return false;
    while (is_digit(now())) ++at_;
    return true;
  }
  bool number() {
    const std::size_t begin = at_;
    if (sees('-')) ++at_;
    const bool zero = sees('0');
    if (!digits()) return fail_at(begin, "digits are missing after the minus");
    if (zero && at_ - begin > (text_[begin] == '-' ? 2u : 1u))
      return fail_at(begin, "a number has no leading 0; remove it");
    if (sees('.') && (++at_, !digits())) return fail_at(begin, "digits are missing after the point: 1.0 or 1");
    if (sees('e') || sees('E')) {
      ++at_;
      if (sees('+') || sees('-')) ++at_;
      if (!digits()) return fail_at(begin, "digits are missing after the e, as in 1e-3");
    }
    if (is_letter(now()) || sees('.'))
      return fail_at(begin, "this is not a JSON number; write one such as 1000, 1.5 or 2e-3");
    if (std::isinf(std::strtod(std::string(text_.substr(begin, at_ - begin)).c_str(), nullptr)))
      return fail_at(begin, std::string(text_.substr(begin, std::min<std::size_t>(at_ - begin, 40))) +
                                " is too large for a number; write a smaller one"),
             fault_->of_value = true, false;
    return true;
  }

  std::string_view text_;
  std::size_t at_ = 0, comma_ = 0;
  int depth_ = 0;
  std::optional<JsonFault> fault_;
};

}  // namespace

std::optional<JsonFault> find_json_fault(std::string_view text) {
  return Walker(text).fault();
}

}  // namespace tyglab
