#include "core/io/json_tree.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "core/io/json_fault.h"
#include "core/io/preset_io.h"

namespace tyglab {
namespace {

constexpr int max_tree_depth = 16;      // a preset needs 4; a bound keeps recursion over the tree safe
constexpr std::size_t max_keys = 1000;  // in one block; each is compared with all before it

/// Input iterator that tells how far the parser has read.
class Cursor {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;
  Cursor(const char* at, const char** seen) : at_(at), seen_(seen) {}
  reference operator*() const { return *at_; }
  Cursor& operator++() {
    *seen_ = ++at_;
    return *this;
  }
  Cursor operator++(int) {
    Cursor old = *this;
    ++*this;
    return old;
  }
  bool operator==(const Cursor& other) const { return at_ == other.at_; }
  bool operator!=(const Cursor& other) const { return at_ != other.at_; }

 private:
  const char* at_;
  const char** seen_;
};

class TreeBuilder : public nlohmann::json_sax<nlohmann::json> {
 public:
  TreeBuilder(std::string_view text, const char** seen, JsonNode& root, std::size_t max_values)
      : text_(text), seen_(seen), max_values_(max_values) {
    stack_.push_back(&root);
  }

  bool null() override { return put(JsonNode::Type::null); }
  bool boolean(bool v) override { return put(JsonNode::Type::boolean, v ? 1 : 0); }
  bool number_integer(number_integer_t v) override { return put(JsonNode::Type::integer, double(v)); }
  bool number_unsigned(number_unsigned_t v) override { return put(JsonNode::Type::integer, double(v)); }
  bool number_float(number_float_t v, const string_t&) override { return put(JsonNode::Type::number, v); }
  bool string(string_t& v) override {
    JsonNode* node = place(JsonNode::Type::text);
    if (node) node->text = std::move(v);
    return node != nullptr;
  }
  bool binary(binary_t&) override { return fail("binary data does not belong in a preset"); }
  bool start_object(std::size_t) override { return open(JsonNode::Type::object); }
  bool start_array(std::size_t) override { return open(JsonNode::Type::list); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& v) override {
    if (stack_.back()->members.size() >= max_keys)
      return fail_at_key("too many keys in one object (" + std::to_string(max_keys) + " at most)");
    if (stack_.back()->find(v)) return fail("the key \"" + v + "\" appears twice; keep one of them");
    key_ = std::move(v);
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override {
    const auto fault = find_json_fault(text_);
    if (!fault) return fail("cannot be read as JSON");
    const std::string_view before = text_.substr(0, fault->at);
    error_line_ = 1 + int(std::count(before.begin(), before.end(), '\n'));
    error_ = (fault->end ? "" : "column " + std::to_string(column_after(before)) + ": ") +
             (fault->of_value ? named(fault->why) : fault->why);
    return false;
  }
  const std::string& error() const { return error_; }
  int error_line() const { return error_line_; }

 private:
  /// Line of the token that was just read. The parser reads one character past a number, so step back over that and
  /// over white space first.
  int line() {
    std::size_t end = std::size_t(*seen_ - text_.data());
    end = end > 0 ? end - 1 : 0;
    while (end > counted_to_ && (text_[end] == '\n' || text_[end] == '\r' || text_[end] == ' ' || text_[end] == '\t'))
      --end;
    if (end > counted_to_) {
      lines_ += int(std::count(text_.begin() + std::ptrdiff_t(counted_to_), text_.begin() + std::ptrdiff_t(end), '\n'));
      counted_to_ = end;
    }
    return lines_;
  }
  /// Column of the character that follows, the first is 1; a character may take several bytes.
  static int column_after(std::string_view before) {
    before.remove_prefix(before.rfind('\n') + 1);  // npos + 1 is 0
    return 1 + int(std::count_if(before.begin(), before.end(), [](char c) { return (c & 0xC0) != 0x80; }));
  }
  /// Where the next value belongs, like "bodies[0].c[1]"; empty at the top.
  std::string key_path() const {
    std::string path;
    for (std::size_t level = 0; started_ && level < stack_.size(); ++level) {
      const bool innermost = level + 1 == stack_.size();
      const JsonNode& node = *stack_[level];
      if (node.type == JsonNode::Type::list) {
        path += "[" + std::to_string(node.items.size() - (innermost ? 0 : 1)) + "]";
      } else if (node.type == JsonNode::Type::object) {
        const std::string& key = innermost ? key_ : node.members.back().key;
        if (!path.empty() && !key.empty()) path += '.';
        path += key;
      }
    }
    return path;
  }
  std::string named(const std::string& why) const {
    const std::string path = key_path();
    return path.empty() ? why : path + ": " + why;
  }
  bool fail_at_key(const std::string& why) { return fail(named(why)); }
  bool fail(std::string why) {
    error_ = std::move(why);
    error_line_ = line();
    return false;
  }
  JsonNode* place(JsonNode::Type type) {
    if (++values_ > max_values_)
      return fail_at_key("too many values (" + std::to_string(max_values_) + " at most)"), nullptr;
    JsonNode* parent = stack_.back();
    JsonNode* node = parent;
    if (started_) {
      if (parent->type == JsonNode::Type::object) {
        parent->members.push_back({std::move(key_), {}});
        node = &parent->members.back().value;
      } else {
        node = &parent->items.emplace_back();
      }
    }
    started_ = true;
    node->type = type;
    node->line = line();
    return node;
  }
  bool put(JsonNode::Type type, double number = 0) {
    JsonNode* node = place(type);
    if (node) node->number = number;
    return node != nullptr;
  }
  bool open(JsonNode::Type type) {
    const bool root = !started_;
    if (int(stack_.size()) > max_tree_depth)
      return fail_at_key("nested too deeply (" + std::to_string(max_tree_depth) + " levels at most)");
    JsonNode* node = place(type);
    if (!node) return false;
    if (!root) stack_.push_back(node);
    return true;
  }
  bool close() {
    if (stack_.size() > 1) stack_.pop_back();
    return true;
  }

  std::string_view text_;
  const char** seen_;
  std::vector<JsonNode*> stack_;
  std::string key_;
  std::string error_;
  int error_line_ = 0;
  bool started_ = false;
  std::size_t max_values_, values_ = 0;
  std::size_t counted_to_ = 0;
  int lines_ = 1;
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

JsonNode parse_json(std::string_view text, std::string_view source, Lines lines, std::size_t max_values) {
  JsonNode root;
  const char* seen = text.data();
  TreeBuilder builder(text, &seen, root, max_values);
  const Cursor first(text.data(), &seen), last(text.data() + text.size(), &seen);
  if (!nlohmann::json::sax_parse(first, last, &builder)) {
    std::string where(source);
    if (builder.error_line() > 0 && lines == Lines::told) where += ":" + std::to_string(builder.error_line());
    throw PresetError(printable(where + ": " + builder.error()));
  }
  return root;
}

}  // namespace tyglab
