#include "app/base/text.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace tyglab {
namespace {

constexpr std::string_view no_break = "\u00a0";
constexpr std::array<std::string_view, 9> relations{"=", "≈", "≠", "<", ">", "≤", "≥", "∝", "≪"};
constexpr std::array<std::string_view, 6> operators{"−", "+", "·", "/", "×", "±"};

/// Its neighbors and a sign stay together.
void bind(std::string& text, std::string_view sign) {
  const std::string loose = " " + std::string(sign) + " ";
  const std::string bound = std::string(no_break) + std::string(sign) + std::string(no_break);
  for (std::size_t at = 0; (at = text.find(loose, at)) != std::string::npos; ++at)
    text.replace(at, loose.size(), bound);
}

/// A number is not parted from its unit.
std::string with_whole_quantities(std::string text) {
  constexpr std::array<std::string_view, 14> units{"N",  "m",  "s",   "kg",         "J",   "%",    "mm",
                                                   "cm", "ms", "N/m", "N\u00a0s/m", "m/s", "m/s²", "1/s"};
  constexpr std::string_view loose = "N s/m";
  for (std::size_t at = 0; (at = text.find(loose, at)) != std::string::npos; ++at) text.replace(at + 1, 1, no_break);
  for (std::size_t at = 1; (at = text.find(' ', at)) != std::string::npos; ++at) {
    const bool number = text[at - 1] >= '0' && text[at - 1] <= '9';
    std::string word = text.substr(at + 1, std::min(text.find(' ', at + 1), text.size()) - at - 1);
    while (!word.empty() && std::string_view(".,;:?)").find(word.back()) != std::string_view::npos) word.pop_back();
    if (number && std::find(units.begin(), units.end(), word) != units.end()) text.replace(at, 1, no_break);
  }
  return text;
}

/// What mouse and keys do, and what a finger does instead; longer ones before those that they contain.
constexpr std::array<std::pair<std::string_view, std::string_view>, 24> fingers_do{{
    {"Press Space to run", "Tap the triangle (Run) at the top"},
    {"Press Space", "Tap the triangle (Run) at the top"},
    {"press Space", "tap the triangle (Run) at the top"},
    {"Right-click a particle", "Tap a particle"},
    {"right-click a particle", "tap a particle"},
    {"Double-click the number", "Double-tap the number"},
    {", with the arrow keys on its slider or by typing,", ""},
    {"restart with R", "restart"},
    {"Restart with R", "Restart"},
    {"restart (R)", "restart"},
    {"R brings it back there", "Restart brings it back there"},
    {"Hold the left button and drag across the sheet",
     "Choose Cut with one finger in the menu, and draw across the sheet"},
    {"Press W to see the wind's arrow, and drag its tip toward the far side of the sheet: Shift drags in depth, Ctrl "
     "along one axis. Or type W's third number.",
     "Type W's third number, the wind along z."},
    {"Ctrl+L lists all labs", "The cap at the top lists all labs"},
    {", in Ctrl+P, opens it", ", in the menu, opens it"},
    {"Ctrl+Z then R", "Undo, then restart"},
    {"Ctrl+Z undoes it", "Undo reverts it"},
    {"Ctrl+Z undoes that", "Undo reverts it"},
    {" (Ctrl+P)", ", in the menu,"},
    {"Space runs", "Run continues"},
    {"Its height y is shown at the lower left", "Its height y stands at the end of Constants"},
    {"They are shown at the lower left, and as arrows on the particle",
     "They are arrows on the particle, and numbers at the end of Constants"},
    {"A left drag cuts", "A cut breaks"},
    {"a left drag cuts", "a finger cuts"},
}};

std::vector<std::string> split(std::string_view text, std::string_view at) {
  std::vector<std::string> parts;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t end = std::min(text.find(at, from), text.size());
    parts.emplace_back(text.substr(from, end - from));
    from = end + at.size();
  }
  return parts;
}

/// The pieces of a formula, each from one relation sign to the next: what a line too short for all of it may part.
std::vector<std::string> terms_of(std::string_view formula) {
  std::vector<std::string> terms;
  for (const std::string& part : split(formula, no_break)) {
    const bool relation = std::find(relations.begin(), relations.end(), part) != relations.end();
    if (terms.empty() || relation)
      terms.push_back(part);
    else
      terms.back() += std::string(no_break) + part;
  }
  return terms;
}

/// Lines that are filled word by word.
class Filled {
 public:
  Filled(float width, const Measure& measure) : width_(width), measure_(measure) {}
  bool fits(const std::string& words) const { return measure_(words) <= width_; }
  /// After a space, or where the line has no room for it on a new one.
  void add(const std::string& word) {
    const std::string longer = line_.empty() ? word : line_ + " " + word;
    if (!line_.empty() && !fits(longer)) {
      end_line();
      line_ = word;
    } else {
      line_ = longer;
    }
  }
  /// The same of one that may be wider than a line: it is then cut where the line ends.
  void add_any(std::string word) {
    while (!fits(word)) {
      std::size_t end = 1, folder = 0, part = 0;
      for (std::size_t next = 1; next < word.size() && fits(word.substr(0, next)); ++next) {
        if ((word[next] & 0xC0) != 0x80) end = next;
        const char before = word[next - 1];
        if (before == '/' || before == '\\') folder = next;
        if (before == '_' || before == '-') part = next;
      }
      // A path is parted behind a folder, or else within a name.
      if (folder > 0 || part > 0) end = folder > 0 ? folder : part;
      while (end < word.size() && (word[end] & 0xC0) == 0x80) ++end;
      if (end >= word.size()) break;
      add(word.substr(0, end));
      end_line();
      word.erase(0, end);
    }
    add(word);
  }
  std::string all() const { return lines_ + line_; }

 private:
  void end_line() {
    lines_ += line_ + "\n";
    line_.clear();
  }
  float width_;
  const Measure& measure_;
  std::string lines_, line_;
};

}  // namespace

std::string with_whole_terms(std::string text) {
  for (const std::string_view sign : operators) bind(text, sign);
  for (const std::string_view sign : relations) bind(text, sign);
  return with_whole_quantities(std::move(text));
}

std::string broken_into_lines(std::string_view text, float width, const Measure& measure) {
  if (const std::size_t end = text.find('\n'); end != std::string_view::npos)
    return broken_into_lines(text.substr(0, end), width, measure) + "\n" +
           broken_into_lines(text.substr(end + 1), width, measure);
  Filled lines(width, measure);
  for (const std::string& word : split(text, " ")) {
    if (lines.fits(word)) {
      lines.add(word);
      continue;
    }
    for (const std::string& term : terms_of(word)) {
      if (lines.fits(term)) {
        lines.add(term);
      } else {
        for (const std::string& piece : split(term, no_break)) lines.add_any(piece);
      }
    }
  }
  return lines.all();
}

std::string shortened(const std::string& text, float width, const Measure& measure) {
  if (measure(text) <= width) return text;
  std::string part = text;
  while (!part.empty() && measure(part + "…") > width) {
    while (part.size() > 1 && (part.back() & 0xC0) == 0x80) part.pop_back();  // a character is taken away whole
    part.pop_back();
  }
  return part + "…";
}

std::vector<std::string> name_lines(const std::string& name, const std::string& state, float width, std::size_t most,
                                    const Measure& measure) {
  const std::string both = state.empty() ? name : name + " · " + state;
  if (measure(both) <= width) return {both};
  const auto lines = [&](const std::string& text) {
    std::vector<std::string> all = split(broken_into_lines(with_whole_terms(text), width, measure), "\n");
    for (std::string& line : all) line = shortened(line, width, measure);
    return all;
  };
  std::vector<std::string> words = lines(name);
  const std::vector<std::string> more = state.empty() ? std::vector<std::string>() : lines(state);
  if (words.size() + more.size() > most) words = {shortened(name, width, measure)};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

std::string for_fingers(std::string_view text) {
  std::string out(text);
  for (const auto& [mouse, finger] : fingers_do)
    for (std::size_t at = 0; (at = out.find(mouse, at)) != std::string::npos; at += finger.size())
      out.replace(at, mouse.size(), finger);
  return out;
}

std::string capitalised(std::string text) {
  // A symbol or key ("dt", "k_s") keeps its letter.
  const std::size_t space = text.find(' ');
  const bool word = space != std::string::npos && space > 2 && text.find('_') > space && text.find('/') > space;
  if (word && text.front() >= 'a' && text.front() <= 'z') text.front() = char(text.front() - 'a' + 'A');
  return text;
}

}  // namespace tyglab
