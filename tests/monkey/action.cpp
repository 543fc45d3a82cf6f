#include "tests/monkey/action.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>
#include <stdexcept>

#include "app/base/glfw_keys.h"

namespace tyglab::monkey {
namespace {

struct VerbRow {
  Verb verb;
  std::string_view name;
  std::size_t words;  ///< at least; the last one holds what is left of the line
  bool text = false;  ///< the last word may hold spaces
};

constexpr std::array verbs{VerbRow{Verb::click, "click", 1},
                           VerbRow{Verb::drag, "drag", 3},
                           VerbRow{Verb::wheel, "wheel", 2},
                           VerbRow{Verb::value, "value", 2, true},
                           VerbRow{Verb::fill, "fill", 2, true},
                           VerbRow{Verb::key, "key", 1},
                           VerbRow{Verb::type, "type", 1, true},
                           VerbRow{Verb::find, "find", 1, true},
                           VerbRow{Verb::grab, "grab", 4},
                           VerbRow{Verb::cut, "cut", 4},
                           VerbRow{Verb::pin, "pin", 2},
                           VerbRow{Verb::pick, "pick", 2},
                           VerbRow{Verb::stroke, "stroke", 4},
                           VerbRow{Verb::zoom, "zoom", 1},
                           VerbRow{Verb::resize, "resize", 2},
                           VerbRow{Verb::drop, "drop", 1},
                           VerbRow{Verb::open, "open", 1},
                           VerbRow{Verb::save, "save", 1},
                           VerbRow{Verb::undo_redo, "undo_redo", 0},
                           VerbRow{Verb::wait, "wait", 1},
                           VerbRow{Verb::quit_restart, "quit_restart", 0}};

struct KeyRow {
  std::string_view name;
  int key;
};

constexpr std::array named_keys{KeyRow{"space", GLFW_KEY_SPACE},
                                KeyRow{"Return", GLFW_KEY_ENTER},
                                KeyRow{"Escape", GLFW_KEY_ESCAPE},
                                KeyRow{"Tab", GLFW_KEY_TAB},
                                KeyRow{"BackSpace", GLFW_KEY_BACKSPACE},
                                KeyRow{"Delete", GLFW_KEY_DELETE},
                                KeyRow{"Left", GLFW_KEY_LEFT},
                                KeyRow{"Right", GLFW_KEY_RIGHT},
                                KeyRow{"Up", GLFW_KEY_UP},
                                KeyRow{"Down", GLFW_KEY_DOWN},
                                KeyRow{"Home", GLFW_KEY_HOME},
                                KeyRow{"End", GLFW_KEY_END},
                                KeyRow{"Prior", GLFW_KEY_PAGE_UP},
                                KeyRow{"Next", GLFW_KEY_PAGE_DOWN},
                                KeyRow{"F1", GLFW_KEY_F1},
                                KeyRow{"F11", GLFW_KEY_F11},
                                KeyRow{"equal", GLFW_KEY_EQUAL},
                                KeyRow{"minus", GLFW_KEY_MINUS},
                                KeyRow{"slash", GLFW_KEY_SLASH},
                                KeyRow{"bracketright", GLFW_KEY_RIGHT_BRACKET},
                                KeyRow{"KP_Add", GLFW_KEY_KP_ADD},
                                KeyRow{"KP_Subtract", GLFW_KEY_KP_SUBTRACT},
                                KeyRow{"KP_0", GLFW_KEY_KP_0},
                                KeyRow{"KP_Enter", GLFW_KEY_KP_ENTER}};

struct Modifier {
  std::string_view prefix;
  int bit;
};
constexpr std::array modifiers{Modifier{"ctrl+", GLFW_MOD_CONTROL}, Modifier{"shift+", GLFW_MOD_SHIFT},
                               Modifier{"alt+", GLFW_MOD_ALT}};

const VerbRow& row_of(Verb verb) {
  return *std::find_if(verbs.begin(), verbs.end(), [&](const VerbRow& row) { return row.verb == verb; });
}

std::string next_word(std::istringstream& in) {
  std::string word;
  in >> word;
  return word;
}

/// What is left of the line, without the space before it.
std::string rest(std::istringstream& in) {
  std::string text;
  in.get();
  std::getline(in, text);
  return text;
}

}  // namespace

std::string_view name_of(Verb verb) {
  return row_of(verb).name;
}

const std::string& Action::word(std::size_t n) const {
  if (n >= words.size()) throw std::runtime_error("\"" + line() + "\" says too little");
  return words[n];
}

double Action::number(std::size_t n) const {
  const std::string& text = word(n);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    throw std::runtime_error("\"" + line() + "\": " + text + " is not a number");
  return value;
}

std::string Action::line() const {
  std::string text(name_of(verb));
  for (const std::string& one : words) text += " " + one;
  return text;
}

Action parse_action(std::string_view line) {
  std::istringstream in{std::string(line)};
  const std::string name = next_word(in);
  const auto row = std::find_if(verbs.begin(), verbs.end(), [&](const VerbRow& r) { return r.name == name; });
  if (row == verbs.end()) throw std::runtime_error("\"" + std::string(line) + "\": there is no action " + name);
  Action action{row->verb, {}};
  const std::size_t single = row->text ? row->words - 1 : row->words;
  for (std::size_t n = 0; n < single; ++n) action.words.push_back(next_word(in));
  if (row->text) action.words.push_back(rest(in));
  for (std::string more; !row->text && in >> more;) action.words.push_back(more);
  if (!action.words.empty() && action.words.front().empty() && !row->text)
    throw std::runtime_error("\"" + std::string(line) + "\" says too little");
  return action;
}

std::vector<Action> read_recording(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file.string() + " cannot be read");
  std::vector<Action> actions;
  for (std::string line; std::getline(in, line);)
    if (!line.empty() && line.front() != '#') actions.push_back(parse_action(line));
  return actions;
}

void write_recording(const std::filesystem::path& file, const std::vector<Action>& actions, const std::string& why) {
  std::ofstream out(file);
  out << "# " << why << '\n';
  for (const Action& action : actions) out << action.line() << '\n';
  if (!out.flush()) throw std::runtime_error(file.string() + " cannot be written");
}

std::optional<Key> key_called(std::string_view chord) {
  Key key;
  for (const Modifier& modifier : modifiers)
    if (chord.starts_with(modifier.prefix)) {
      key.mods |= modifier.bit;
      chord.remove_prefix(modifier.prefix.size());
    }
  const bool letter = chord.size() == 1 && chord[0] >= 'a' && chord[0] <= 'z';
  const bool digit = chord.size() == 1 && chord[0] >= '0' && chord[0] <= '9';
  if (letter) key.key = chord[0] - 'a' + GLFW_KEY_A;
  if (digit) key.key = chord[0] - '0' + GLFW_KEY_0;
  for (const KeyRow& row : named_keys)
    if (row.name == chord) key.key = row.key;
  return key.key == 0 ? std::nullopt : std::optional(key);
}

std::string name_of(Key key) {
  std::string name;
  for (const Modifier& modifier : modifiers)
    if ((key.mods & modifier.bit) != 0) name += modifier.prefix;
  if (key.key >= GLFW_KEY_A && key.key <= GLFW_KEY_Z) return name + char('a' + key.key - GLFW_KEY_A);
  if (key.key >= GLFW_KEY_0 && key.key <= GLFW_KEY_9) return name + char('0' + key.key - GLFW_KEY_0);
  for (const KeyRow& row : named_keys)
    if (row.key == key.key) return name + std::string(row.name);
  return {};
}

std::vector<std::string> key_names() {
  std::vector<std::string> names;
  for (char c = 'a'; c <= 'z'; ++c) names.emplace_back(1, c);
  for (char c = '0'; c <= '9'; ++c) names.emplace_back(1, c);
  for (const KeyRow& row : named_keys) names.emplace_back(row.name);
  return names;
}

}  // namespace tyglab::monkey
