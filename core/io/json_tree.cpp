#include "core/io/json_tree.h"

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>

#include "core/io/preset_io.h"

namespace tyglab {
namespace {

constexpr int max_depth = 16;           // a preset needs 4; a bound keeps recursion safe
constexpr std::size_t max_keys = 1000;  // in one object; each is compared with all before it

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

/// Reads the text by JSON's grammar (RFC 8259). What breaks it is thrown as a PresetError, in words for the person who
/// wrote it: what was expected, and the fix.
class JsonReader {
 public:
  JsonReader(std::string_view text, std::string_view source, Lines lines, std::size_t max_values)
      : text_(text), source_(source), lines_(lines), max_values_(max_values) {}

  JsonNode read() {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
    skip_space();
    if (ended()) fail_end("it is empty; it must be at least {}");
    JsonNode root = value();
    skip_space();
    if (!ended()) fail("the preset ends before this; remove what follows its closing }");
    return root;
  }

 private:
  enum class Columns { told, none };

  bool ended() const { return at_ >= text_.size(); }
  char now() const { return ended() ? '\0' : text_[at_]; }
  bool sees(char c) const { return !ended() && text_[at_] == c; }
  void skip_space() {
    for (; sees(' ') || sees('\t') || sees('\n') || sees('\r'); ++at_) line_ += sees('\n') ? 1 : 0;
  }
  int line_of(std::size_t at) const {
    return 1 + int(std::count(text_.begin(), text_.begin() + std::ptrdiff_t(at), '\n'));
  }
  /// The first is 1; a character may take several bytes.
  int column_of(std::size_t at) const {
    std::string_view before = text_.substr(0, at);
    before.remove_prefix(before.rfind('\n') + 1);  // npos + 1 is 0
    return 1 + int(std::count_if(before.begin(), before.end(), [](char c) { return (c & 0xC0) != 0x80; }));
  }
  [[noreturn]] void fail_at(std::size_t at, const std::string& why, Columns columns = Columns::told) const {
    std::string where = excerpt(source_, 300);
    if (lines_ == Lines::told) where += ":" + std::to_string(line_of(at));
    if (columns == Columns::told) where += ": column " + std::to_string(column_of(at));
    throw PresetError(printable(where + ": " + why));
  }
  [[noreturn]] void fail(const std::string& why) const { fail_at(at_, why); }
  /// With the key that it is about.
  std::string named(const std::string& why) const { return path_.empty() ? why : excerpt(path_, 200) + ": " + why; }
  /// It is JSON, but not what is wanted.
  [[noreturn]] void refuse(const std::string& why) const { fail_at(at_, named(why), Columns::none); }
  /// The text ends where more must come.
  [[noreturn]] void fail_end(const std::string& why) const {
    const std::size_t last = text_.find_last_not_of(" \t\r\n");
    fail_at(last == std::string_view::npos ? 0 : last, why, Columns::none);
  }
  std::string word() const {
    std::size_t end = at_;
    while (end < text_.size() && end < at_ + 40 && (is_letter(text_[end]) || is_digit(text_[end]))) ++end;
    return std::string(text_.substr(at_, end - at_));
  }

  JsonNode value() {
    if (++values_ > max_values_) refuse("too many values (" + std::to_string(max_values_) + " at most)");
    JsonNode node;
    node.line = lines_ == Lines::told ? line_ : 0;
    const char c = now();
    if (c == '{') {
      node.type = JsonNode::Type::object;
      items('}', [&] { member(node); });
    } else if (c == '[') {
      node.type = JsonNode::Type::list;
      items(']', [&] { node.items.push_back(value_of("[" + std::to_string(node.items.size()) + "]")); });
    } else if (c == '"') {
      node.type = JsonNode::Type::text;
      node.text = string();
    } else if (c == '-' || is_digit(c)) {
      number(node);
    } else {
      literal(node);
    }
    return node;
  }
  /// The value that belongs to a part of the present one: "[2]" or ".k_s".
  JsonNode value_of(const std::string& part) {
    const std::size_t length = path_.size();
    path_ += path_.empty() && part[0] == '.' ? part.substr(1) : part;
    JsonNode node = value();
    path_.resize(length);
    return node;
  }
  void literal(JsonNode& node) {
    const std::string name = word();
    if (name == "true" || name == "false")
      node.type = JsonNode::Type::boolean, node.number = name == "true" ? 1 : 0;
    else if (name != "null")
      no_value(name);
    at_ += name.size();
  }
  /// What to say where a value should begin and does not.
  [[noreturn]] void no_value(const std::string& name) const {
    const char c = now();
    if (ended()) fail_end("it ends where a value is expected");
    refuse_comment(), refuse_bytes();
    if (depth_ == 0) fail("this is not JSON: an object begins with {");
    if (c == '\'') fail("strings are written in double quotes: \"…\", not '…'");
    if (c == '+') fail("a number has no + sign; remove it");
    if (c == '.') fail("a number begins with a digit: 0.5, not .5");
    if (c == ',') fail("a value is missing before this comma");
    if (name == "NaN" || name == "nan" || name == "Infinity" || name == "inf")
      fail("a number must be finite, such as 1.5 or 2e-3");
    if (name == "True" || name == "False") fail("write true or false in lowercase");
    if (name == "None") fail("write null instead of None");
    if (!name.empty()) fail("strings are written in double quotes: \"" + name + "\"");
    fail("a value was expected here: a number, a \"string\", a [list] or an object {…}");
  }
  void refuse_bytes() const {
    if (text_.starts_with("\x89PNG") || text_.starts_with("\xFF\xD8\xFF"))
      refuse("this is an image, not a preset; the cloth takes it as its texture");
    if (utf8_length(text_.substr(at_)) == 0) fail("these bytes are not UTF-8 text; save the file as UTF-8");
  }
  void refuse_comment() const {
    if (sees('/') || sees('#')) fail("JSON has no comments; remove it, or move it into the preset's \"description\"");
  }

  /// Items between commas up to `close`.
  template <class Item>
  void items(char close, const Item& item) {
    if (++depth_ > max_depth) refuse("nested too deeply (" + std::to_string(max_depth) + " levels at most)");
    const std::size_t open = at_++;
    skip_space();
    for (std::size_t comma = open; !sees(close) || comma != open; skip_space()) {
      if (sees(close))
        fail_at(comma,
                std::string("nothing follows this comma; remove it, or add what is missing before the ") + close);
      if (!ended()) item(), skip_space();
      if (ended())
        fail_end(std::string("the ") + text_[open] + " of line " + std::to_string(line_of(open)) +
                 " is never closed; add its " + close);
      if (sees(close)) break;
      if (!sees(',')) no_comma(open, close);
      comma = at_++;
    }
    ++at_, --depth_;
  }
  [[noreturn]] void no_comma(std::size_t open, char close) const {
    refuse_comment();
    const char c = now();
    if (c == '}' || c == ']')
      fail(std::string("the ") + text_[open] + " before it is closed by " + close + ", not by " + c);
    if (c == '"' || c == '{' || c == '[' || c == '-' || is_digit(c) || is_letter(c))
      fail("a comma is missing before this");
    refuse_bytes();
    fail(std::string("a comma or ") + close + " was expected here");
  }
  void member(JsonNode& object) {
    if (!sees('"')) no_key();
    const std::size_t begin = at_;
    const std::string key = string();
    if (object.members.size() >= max_keys)
      refuse("too many keys in one object (" + std::to_string(max_keys) + " at most)");
    if (object.find(key)) refuse("the key \"" + key + "\" appears twice; keep one of them");
    const std::string quoted(text_.substr(begin, std::min<std::size_t>(at_ - begin, 60)));
    skip_space();
    if (ended()) fail_end("it ends after the key " + quoted + "; a colon and its value are missing");
    if (sees('=')) fail("write a colon between a key and its value, not =");
    if (!sees(':')) fail("a colon is missing after the key " + quoted);
    ++at_;
    skip_space();
    object.members.push_back({key, value_of("." + key)});
  }
  [[noreturn]] void no_key() const {
    refuse_comment();
    if (sees('\'')) fail("keys are written in double quotes: \"…\", not '…'");
    if (is_letter(now())) fail("keys are written in double quotes: \"" + word() + "\"");
    if (sees(',')) fail("one comma is enough; remove this one");
    refuse_bytes();
    fail("a key in double quotes was expected here, such as \"k_s\"");
  }

  std::string string() {
    const std::size_t open = at_++;
    while (!sees('"')) {
      if (ended() || sees('\n') || sees('\r')) fail_at(open, "the string that begins here lacks its closing \"");
      if (static_cast<unsigned char>(now()) < ' ')
        fail("a string cannot contain a control character; write \\t for a tab, \\n for a new line");
      refuse_bytes();
      sees('\\') ? escape() : void(at_ += utf8_length(text_.substr(at_)));
    }
    ++at_;
    return nlohmann::json::parse(text_.substr(open, at_ - open)).get<std::string>();
  }
  void escape() {
    const char c = at_ + 1 < text_.size() ? text_[at_ + 1] : '\0';
    if (c == 'u') return unicode_escape();
    if (c == '\0' || std::string_view("\"\\/bfnrt").find(c) == std::string_view::npos)
      fail("JSON has no such escape; write \\\\ for a backslash");
    at_ += 2;
  }
  /// The code of \uXXXX here; -1 if it is none.
  int unicode() const {
    if (text_.substr(at_, 2) != "\\u" || text_.size() < at_ + 6) return -1;
    const std::string digits(text_.substr(at_ + 2, 4));
    const auto is_hex = [](unsigned char c) { return std::isxdigit(c) != 0; };
    return std::all_of(digits.begin(), digits.end(), is_hex) ? std::stoi(digits, nullptr, 16) : -1;
  }
  void unicode_escape() {
    const std::size_t begin = at_;
    const int code = unicode();
    if (code < 0) fail("four hexadecimal digits must follow \\u, as in \\u00e5");
    at_ += 6;
    if (code < 0xD800 || code > 0xDFFF) return;
    const int second = unicode();
    if (code > 0xDBFF || second < 0xDC00 || second > 0xDFFF)
      fail_at(begin, "half a surrogate pair; write the character itself");
    at_ += 6;
  }

  bool digits() {
    if (!is_digit(now())) return false;
    while (is_digit(now())) ++at_;
    return true;
  }
  void number(JsonNode& node) {
    const std::size_t begin = at_;
    if (sees('-')) ++at_;
    const bool zero = sees('0');
    if (!digits()) fail_at(begin, "digits are missing after the minus");
    if (zero && at_ - begin > (text_[begin] == '-' ? 2u : 1u)) fail_at(begin, "a number has no leading 0; remove it");
    if (sees('.') && (++at_, !digits())) fail_at(begin, "digits are missing after the point: 1.0 or 1");
    if (sees('e') || sees('E')) {
      ++at_;
      if (sees('+') || sees('-')) ++at_;
      if (!digits()) fail_at(begin, "digits are missing after the e, as in 1e-3");
    }
    if (is_letter(now()) || sees('.')) fail_at(begin, "this is not a JSON number; write one such as 1000, 1.5 or 2e-3");
    const auto value = nlohmann::json::parse(text_.substr(begin, at_ - begin), nullptr, false);
    if (!value.is_number())
      fail_at(begin, named(std::string(text_.substr(begin, std::min<std::size_t>(at_ - begin, 40))) +
                           " is too large for a number; write a smaller one"));
    node.type = value.is_number_integer() ? JsonNode::Type::integer : JsonNode::Type::number;
    node.number = value.get<double>();
  }

  std::string_view text_;
  std::string source_;
  Lines lines_;
  std::size_t max_values_;
  std::size_t at_ = 0, values_ = 0;
  std::string path_;  ///< of the value that is read, like "bodies[0].c[1]"
  int line_ = 1;
  int depth_ = 0;
};

}  // namespace

const JsonNode* JsonNode::find(std::string_view key) const {
  const auto it = std::find_if(members.begin(), members.end(), [&](const auto& member) { return member.key == key; });
  return it == members.end() ? nullptr : &it->value;
}

std::string_view type_name(JsonNode::Type type) {
  switch (type) {
    case JsonNode::Type::null:
      return "null";
    case JsonNode::Type::boolean:
      return "true or false";
    case JsonNode::Type::integer:
      return "a whole number";
    case JsonNode::Type::number:
      return "a number";
    case JsonNode::Type::text:
      return "a string";
    case JsonNode::Type::list:
      return "a list";
    case JsonNode::Type::object:
      return "an object {…}";
  }
  return "";
}

std::string printable(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; }, ' ');
  return text;
}

std::string excerpt(std::string_view text, std::size_t most) {
  if (text.size() <= most) return std::string(text);
  while (most > 0 && (text[most] & 0xC0) == 0x80) --most;
  return std::string(text.substr(0, most)) + "…";
}

JsonNode parse_json(std::string_view text, std::string_view source, Lines lines, std::size_t max_values) {
  return JsonReader(text, source, lines, max_values).read();
}

}  // namespace tyglab
