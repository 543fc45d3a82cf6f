#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <functional>
#include <sstream>
#include <utility>

#include "app/labs/lab.h"
#include "app/labs/observables.h"
#include "app/panels/text_lines.h"
#include "app/preset_files.h"
#include "core/notation/notation.h"
#include "core/notation/preset_io.h"
#include "core/notation/words.h"

namespace tyglab {
namespace {

constexpr std::uintmax_t most_bytes = 1 << 20;

constexpr std::array<std::string_view, 11> lab_keys{"open", "set",  "predict", "answer", "choice", "right",
                                                    "do",   "stop", "check",   "needs",  "within"};
struct RelationSign {
  std::string_view sign;
  Relation relation;
  std::string_view shown;
};
constexpr std::array<RelationSign, 6> relation_signs{{{"<", Relation::less, "<"},
                                                      {"<=", Relation::at_most, "≤"},
                                                      {"=", Relation::equal, "="},
                                                      {"!=", Relation::unlike, "is not"},
                                                      {">=", Relation::at_least, "≥"},
                                                      {">", Relation::greater, ">"}}};

std::string_view trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t\r"), end = text.find_last_not_of(" \t\r");
  return begin == std::string_view::npos ? std::string_view() : text.substr(begin, end - begin + 1);
}

/// Without the signs of Markdown that the card does not set: `code` and **strong**.
std::string without_marks(std::string_view text) {
  std::string plain;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] == '`') continue;
    if (text.substr(k, 2) == "**") {
      ++k;
      continue;
    }
    plain += text[k];
  }
  return plain;
}

/// As the card sets it: in one piece, whatever its lines are in the file.
std::string set_text(std::string_view text) {
  return with_whole_terms(without_marks(text));
}

std::vector<std::string> words_in(std::string_view text) {
  std::istringstream in{std::string(text)};
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

/// None where it is no number, or none that is finite ("nan").
std::optional<double> plain_number(std::string_view text) {
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || stop != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// The words from that one on, as a unit such as "N s/m" is written.
std::string joined(const std::vector<std::string>& words, std::size_t from) {
  std::string text;
  for (std::size_t k = from; k < words.size(); ++k) text += (k > from ? " " : "") + words[k];
  return text;
}

/// Lines are gathered into paragraphs: an empty line or a "- " begins a new one.
class Gathered {
 public:
  void add(std::string_view line) {
    if (line.empty()) {
      open_ = false;
      return;
    }
    const bool item = line.starts_with("- ");
    std::string text = without_marks(item ? line.substr(2) : line);
    if (item || !open_) {
      paragraphs_.push_back(item ? "• " + text : std::move(text));
    } else {
      paragraphs_.back() += " " + text;
    }
    open_ = true;
  }
  Paragraphs take() {
    open_ = false;
    for (std::string& paragraph : paragraphs_) paragraph = with_whole_terms(std::move(paragraph));
    return std::exchange(paragraphs_, {});
  }
  bool empty() const { return paragraphs_.empty(); }

 private:
  Paragraphs paragraphs_;
  bool open_ = false;
};

class LabReader {
 public:
  LabReader(std::string_view text, std::string_view source, const std::filesystem::path& folder)
      : text_(text), source_(source), folder_(folder) {}
  Lab read();

 private:
  [[noreturn]] void fail(const std::string& why) const { fail_at(line_, why); }
  [[noreturn]] void fail_at(int line, const std::string& why) const {
    throw LabError(source_ + ":" + std::to_string(line) + ": " + why);
  }
  void note(const LabError& error);
  void noted(const std::function<void()>& read);
  void take_or_note(std::string_view line);
  void take_line(std::string_view line);
  void end_file();
  void take_key(std::string_view line);
  void take_value(std::string_view key, std::string_view value);
  void begin_step(std::string_view title);
  void begin_block();
  void end_step();
  void end_prediction();
  void end_block();
  void end_opening();
  bool note_wrong_settings(Preset preset, const std::vector<std::string>& settings);
  LabStep& step() { return lab_.steps.back(); }
  Prediction& prediction(std::string_view key);

  void take_answer(std::string_view value);
  void take_seconds(std::string_view value);
  void take_needs(std::string_view value);
  std::string known_name(const std::string& name) const;
  Condition condition(std::string_view value) const;
  Operand operand(const std::vector<std::string>& words, std::size_t from, std::string_view unit) const;
  Operand word_operand(const std::string& name, const std::vector<std::string>& words) const;

  std::string_view text_;
  std::string source_;
  std::filesystem::path folder_;
  Lab lab_;
  Gathered prose_;
  std::string problems_;  ///< a line each
  int line_ = 0, block_line_ = 0, step_line_ = 0, predict_line_ = 0, open_line_ = 0;
  std::vector<int> set_lines_;  ///< of the block's settings
  bool in_block_ = false, had_block_ = false;
  int rights_ = 0;
  bool answered_ = false;
};

Lab LabReader::read() {
  try {
    for (std::size_t at = 0; at <= text_.size();) {
      const std::size_t end = std::min(text_.find('\n', at), text_.size());
      ++line_;
      take_or_note(trimmed(text_.substr(at, end - at)));
      at = end + 1;
    }
    end_file();
  } catch (const LabError& error) {
    note(error);
  }
  if (!problems_.empty()) throw LabError(problems_);
  return std::move(lab_);
}

void LabReader::note(const LabError& error) {
  problems_ += (problems_.empty() ? "" : "\n") + std::string(error.what());
}

/// What is wrong in one line of a block says nothing of the lines after it, so all such lines are told at once; where
/// headings are wrong the reading ends.
void LabReader::take_or_note(std::string_view line) {
  if (!in_block_) return take_line(line);
  noted([&] { take_line(line); });
}

void LabReader::noted(const std::function<void()>& read) {
  try {
    read();
  } catch (const LabError& error) {
    note(error);
  }
}

void LabReader::end_file() {
  if (in_block_) fail_at(block_line_, "this block is never closed; end it with a line ```");
  if (lab_.title.empty()) fail_at(1, "a lab begins with its title; write a first line such as # Hooke's law");
  if (lab_.steps.empty()) fail("a lab has at least one step; begin one with a line such as ## Look first");
  end_step();
}

void LabReader::take_line(std::string_view line) {
  if (in_block_ && line == "```") return end_block();
  if (in_block_) return line.empty() ? void() : take_key(line);
  if (line.starts_with("```")) {
    if (line != "```lab") fail("the only block that a lab may have is ```lab; remove this one, or call it so");
    return begin_block();
  }
  if (line.starts_with("## ")) return begin_step(trimmed(line.substr(3)));
  if (line.starts_with("# ")) {
    if (!lab_.title.empty()) fail("a lab has one title; begin a step with ##");
    lab_.title = set_text(trimmed(line.substr(2)));
    return;
  }
  if (line.starts_with("#")) fail("a heading is # (the title) or ## (a step), with a space after it");
  if (lab_.title.empty() && !line.empty())
    fail("a lab begins with its title; write a line such as # Hooke's law first");
  prose_.add(line);
}

void LabReader::begin_step(std::string_view title) {
  if (lab_.title.empty()) fail("a lab begins with its title; write a line such as # Hooke's law before the steps");
  if (title.empty()) fail("a step needs a title after ##");
  end_step();
  lab_.steps.emplace_back().title = set_text(title);
  step_line_ = line_;
  had_block_ = false;
}

void LabReader::begin_block() {
  if (lab_.steps.empty()) fail("a ```lab block belongs to a step; begin one with a line such as ## Look first");
  if (had_block_) fail("this step has a ```lab block already; put both in one, or begin another step with ##");
  step().text = prose_.take();
  in_block_ = had_block_ = true;
  block_line_ = line_;
  predict_line_ = open_line_ = rights_ = 0;
  set_lines_.clear();
  answered_ = false;
}

void LabReader::end_step() {
  if (lab_.steps.empty()) {
    lab_.summary = prose_.take();
    return;
  }
  if (had_block_) {
    step().explanation = prose_.take();
  } else {
    step().text = prose_.take();
  }
  if (step().text.empty()) fail_at(step_line_, "this step says nothing; write what it is about under its title");
}

/// A prediction has its sentences, of which one is right, or its number.
void LabReader::end_prediction() {
  const Prediction& given = *step().prediction;
  if (given.choices.empty() && !answered_)
    fail_at(predict_line_, "this prediction has no answer; add a line such as answer: 0.098 m within 10 %, or choices");
  if (!given.choices.empty() && answered_)
    fail_at(predict_line_, "this prediction has an answer and choices; keep one of them");
  if (!given.choices.empty() && (rights_ != 1 || given.choices.size() < 2))
    fail_at(predict_line_, "of the sentences to choose from exactly one begins with right:, the others with choice:");
}

void LabReader::end_block() {
  in_block_ = false;
  if (step().prediction) noted([&] { end_prediction(); });
  if (step().open) noted([&] { end_opening(); });
}

/// The preset must be there, and its settings such as it takes.
void LabReader::end_opening() {
  const Opening& opening = *step().open;
  try {
    const Preset preset = load_preset(find_preset(opening.preset).file);
    try {
      with_settings(preset, opening.settings);
    } catch (const PresetError&) {
      if (!note_wrong_settings(preset, opening.settings)) throw;
    }
  } catch (const std::exception& error) {
    fail_at(open_line_, error.what());
  }
}

/// Notes each that cannot be made after those before it, with its own line. False where it is only all together that
/// they are wrong.
bool LabReader::note_wrong_settings(Preset preset, const std::vector<std::string>& settings) {
  bool any = false;
  for (std::size_t k = 0; k < settings.size(); ++k) try {
      Setting setting = parse_setting(settings[k]);
      setting.typed = "set";  // as the file says it, not as a command line would
      preset = with_parsed_settings(preset, {setting});
    } catch (const PresetError& error) {
      any = true;
      note(LabError(source_ + ":" + std::to_string(set_lines_[k]) + ": " + error.what()));
    }
  return any;
}

void LabReader::take_key(std::string_view line) {
  const auto colon = line.find(':');
  if (colon == std::string_view::npos)
    fail("a line of a block is KEY: VALUE, such as check: k_s >= 180; \"" + std::string(line) + "\" has no colon");
  const std::string_view key = trimmed(line.substr(0, colon)), value = trimmed(line.substr(colon + 1));
  if (std::find(lab_keys.begin(), lab_keys.end(), key) == lab_keys.end()) {
    const auto meant = nearest(key, lab_keys);
    fail("\"" + std::string(key) + "\" is no key of a lab" +
         (meant ? "; did you mean " + std::string(*meant) + "?"
                : "; known: open, set, predict, answer, choice, right, do, stop, check, needs"));
  }
  if (value.empty()) fail(std::string(key) + ": says nothing; write its value after the colon, or remove the line");
  take_value(key, value);
}

Prediction& LabReader::prediction(std::string_view key) {
  if (!step().prediction) fail(std::string(key) + ": needs a question; write a line predict: before it");
  return *step().prediction;
}

void LabReader::take_value(std::string_view key, std::string_view value) {
  if (key == "open") {
    if (step().open) fail("a step opens one preset; remove this line, or begin another step with ##");
    const std::filesystem::path beside = folder_ / value;
    std::error_code ignored;
    const bool own = !folder_.empty() && std::filesystem::is_regular_file(beside, ignored);
    step().open = Opening{own ? beside.string() : std::string(value), {}};
    open_line_ = line_;
  } else if (key == "set") {
    if (!step().open) fail("set: changes the preset that the step opens; write a line open: before it");
    step().open->settings.emplace_back(value);
    set_lines_.push_back(line_);
  } else if (key == "predict") {
    if (step().prediction) fail("a step asks for one prediction; remove this line, or begin another step with ##");
    step().prediction.emplace().question = set_text(value);
    predict_line_ = line_;
  } else if (key == "choice" || key == "right") {
    Prediction& given = prediction(key);
    if (key == "right") given.right = given.choices.size(), ++rights_;
    given.choices.push_back(set_text(value));
  } else if (key == "answer") {
    take_answer(value);
  } else if (key == "do") {
    step().todo.push_back(set_text(value));
  } else if (key == "stop") {
    take_seconds(value);
  } else if (key == "check") {
    step().checks.push_back(condition(value));
  } else if (key == "needs") {
    take_needs(value);
  } else {
    fail("within stands in the line of the answer: answer: 0.098 m within 10 %");
  }
}

void LabReader::take_needs(std::string_view value) {
  if (value != "opencl") fail("the one thing that a step can need is opencl, not \"" + std::string(value) + "\"");
  step().needs_opencl = true;
}

void LabReader::take_seconds(std::string_view value) {
  const std::vector<std::string> words = words_in(value);
  const auto seconds = plain_number(words[0]);
  if (!seconds || *seconds <= 0 || words.size() > 2 || (words.size() == 2 && words[1] != "s"))
    fail("stop: is a simulated time above 0, such as stop: 2 s");
  step().stop = seconds;
}

/// "0.098 m within 10 %", "dt_crit within 0.0001".
void LabReader::take_answer(std::string_view value) {
  Prediction& given = prediction("answer");
  answered_ = true;  // if perhaps not well: that is told for itself
  std::vector<std::string> words = words_in(value);
  const auto within = std::find(words.begin(), words.end(), "within");
  const auto after = std::size_t(words.end() - within);
  const auto off = after > 1 ? plain_number(*(within + 1)) : std::nullopt;
  if (!off || *off <= 0 || within == words.begin())
    fail("an answer says how far a prediction may be off: answer: 0.098 m within 10 %");
  given.relative = after == 3 && *(within + 2) == "%";
  given.within = given.relative ? *off / 100 : *off;
  words.erase(within, words.end());
  // A number's unit is for people: any words.
  if (plain_number(words[0]) && (words.size() == 1 || words[1] != "*")) {
    given.unit = joined(words, 1);
    words.resize(1);
  }
  given.answer = operand(words, 0, "");
  if (!given.answer.name.empty()) given.unit = unit_of(given.answer.name);
  if (given.relative && given.answer.name.empty() && given.answer.factor == 0)
    fail("a part of 0 is 0, so nothing near it would be right; say how far off in its unit: answer: 0 " +
         (given.unit.empty() ? "" : given.unit + " ") + "within 0.01");
}

std::string LabReader::known_name(const std::string& name) const {
  if (is_observable(name)) return name;
  const auto known = observable_names();
  const auto meant = nearest(name, known);
  fail("\"" + name + "\" is nothing that a check can ask for" +
       (meant ? "; did you mean " + std::string(*meant) + "?" : "; docs/labs/README.md lists what it can"));
}

Operand LabReader::operand(const std::vector<std::string>& words, std::size_t from, std::string_view unit) const {
  if (from >= words.size()) fail("a value is missing, such as check: k_s >= 180");
  Operand given;
  const auto number = plain_number(words[from]);
  if (number) {
    given.factor = *number, ++from;
    const std::string after = joined(words, from);
    if (after.empty() || after == unit) return given;
    if (words[from] != "*")
      fail("the unit is " + (unit.empty() ? "none" : std::string(unit)) + ", not " + after +
           "; a number times a quantity is written 0.5 * F_g");
    ++from;
  }
  if (from + 1 != words.size())
    fail("a value is a number with its unit, a quantity such as F_g, or a number times one, such as 0.5 * F_g");
  given.before = words[from].starts_with("before.");
  given.name = known_name(given.before ? words[from].substr(7) : words[from]);
  if (is_word(given.name)) fail(given.name + " is a word, which a number cannot be compared with");
  if (given.before && lab_.steps.size() == 1)
    fail("there is no step before the first, so it can have no before." + given.name);
  if (given.before && given.name == "apart")
    fail("apart is itself measured from the step before; compare another quantity");
  return given;
}

Operand LabReader::word_operand(const std::string& name, const std::vector<std::string>& words) const {
  if (words.size() != 3) fail(name + " is one word, such as check: integrator = euler");
  const auto known = find_observable(name)->words();
  if (std::find(known.begin(), known.end(), words[2]) == known.end()) {
    std::string all;
    for (const std::string_view word : known) all += (all.empty() ? "" : ", ") + std::string(word);
    const auto meant = nearest(words[2], known);
    fail(name + " is never \"" + words[2] + "\"" + (meant ? "; did you mean " + std::string(*meant) + "?" : ".") +
         " Known: " + all);
  }
  Operand given;
  given.word = words[2];
  return given;
}

/// "k_s >= 180 N/m", "integrator = euler", "error < 0.3 before.error".
Condition LabReader::condition(std::string_view value) const {
  const std::vector<std::string> words = words_in(value);
  Condition given;
  given.name = known_name(words[0]);
  if (given.name == "apart" && lab_.steps.size() == 1)
    fail("apart is measured from the step before, and there is none before the first");
  const auto sign = std::find_if(relation_signs.begin(), relation_signs.end(),
                                 [&](const RelationSign& s) { return words.size() > 1 && s.sign == words[1]; });
  if (sign == relation_signs.end())
    fail("between " + words[0] + " and its value stands one of <, <=, =, !=, >= and >, with spaces round it");
  given.relation = sign->relation;
  if (!is_word(given.name)) {
    given.right = operand(words, 2, unit_of(given.name));
    return given;
  }
  if (given.relation != Relation::equal && given.relation != Relation::unlike)
    fail(given.name + " is a word: compare it by = or !=");
  given.right = word_operand(given.name, words);
  return given;
}

}  // namespace

Lab parse_lab(std::string_view text, std::string_view source, const std::filesystem::path& folder) {
  return LabReader(text, source, folder).read();
}

Lab load_lab(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::exists(file, error) && !std::filesystem::is_regular_file(file, error))
    throw LabError(file.string() + ": is not a file, so it cannot be read as a lab");
  if (const auto size = std::filesystem::file_size(file, error); !error && size > most_bytes)
    throw LabError(file.string() + ": too large for a lab (1 MiB at most)");
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw LabError(file.string() + ": the file cannot be read; is it there, and may it be read?");
  Lab lab = parse_lab(text.str(), file.string(), file.parent_path());
  lab.label = file.stem().string();
  return lab;
}

std::string words_of(const Condition& condition) {
  const auto sign = std::find_if(relation_signs.begin(), relation_signs.end(),
                                 [&](const RelationSign& s) { return s.relation == condition.relation; });
  const Operand& right = condition.right;
  if (!right.word.empty())
    return condition.name + (condition.relation == Relation::equal ? " is " : " is not ") + right.word;
  std::string text = condition.name + " " + std::string(sign->shown) + " ";
  if (right.name.empty()) {
    const std::string_view unit = unit_of(condition.name);
    return text + shortest_number(right.factor) + (unit.empty() ? "" : " " + std::string(unit));
  }
  if (right.factor != 1) text += shortest_number(right.factor) + " × ";
  return text + right.name + (right.before ? " before" : "");
}

}  // namespace tyglab
