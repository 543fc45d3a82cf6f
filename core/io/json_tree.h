// JSON text as a tree in which every value knows its line. Duplicate keys are rejected, and errors are in plain words.
// (The tree of nlohmann-json stores neither lines nor duplicate keys, and its errors are about tokens; here it only
// reads strings and numbers.)
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tyglab {

struct JsonNode {
  struct Member;
  enum class Type { null, boolean, integer, number, text, list, object };
  Type type = Type::null;
  int line = 0;       ///< of the value; 0 if lines are not told
  double number = 0;  ///< integer, number; boolean: 0 or 1
  std::string text;
  std::vector<JsonNode> items;
  std::vector<Member> members;

  const JsonNode* find(std::string_view key) const;
  bool is_number() const { return type == Type::number || type == Type::integer; }
};

/// A key of an object and its value.
struct JsonNode::Member {
  std::string key;
  JsonNode value;
};

/// "a number", "a string", … for error messages.
std::string_view type_name(JsonNode::Type type);

/// The text as JSON writes it, in quotation marks.
std::string json_text(std::string_view text);

/// The text with control characters replaced by spaces, so a key in a file can neither cut an error message short nor
/// reach a terminal as a control sequence.
std::string printable(std::string text);
/// At most that many bytes of the text, with a mark if it continues: a link or a key may have megabytes.
std::string excerpt(std::string_view text, std::size_t most = 60);

/// Whether errors report lines; the text of a --set is a single line.
enum class Lines { told, one };

constexpr std::size_t max_json_values = 200000;  // a list of every pin of a large cloth's border fits well

/// Throws PresetError naming `source`, line and column, and the key where it is about a value.
JsonNode parse_json(std::string_view text, std::string_view source, Lines lines,
                    std::size_t max_values = max_json_values);

}  // namespace tyglab
