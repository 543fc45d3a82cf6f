#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>

#include "app/base/files.h"
#include "app/session/lab.h"
#include "core/fields/particle_field.h"
#include "core/io/preset_io.h"
#include "core/model/notation.h"

namespace tyglab {
namespace {

constexpr std::uintmax_t most_bytes = 1 << 20;

/// The last stands on the line of another, and the one before it in the head's block.
constexpr std::array<std::string_view, 17> lab_keys{"open",  "set",  "predict", "answer",  "choice", "right",
                                                    "do",    "stop", "check",   "find",    "needs",  "show",
                                                    "speed", "view", "color",   "minutes", "within"};

static_assert(lab_keys.back() == "within");
class LabReader {
 public:
  LabReader(std::string_view text, std::string_view source, const std::filesystem::path& folder)
      : text_(text), source_(source), folder_(folder) {}
  Lab read();

 private:
  [[noreturn]] void fail(const std::string& why) const { fail_at(line_, why); }
  [[noreturn]] void fail_at(int line, const std::string& why) const {
    assert(line >= 1 && line <= line_);
    throw LabError(source_ + ":" + std::to_string(line) + ": " + why);
  }
  /// What `read` returns; what it finds wrong is wrong in this line.
  template <class Read>
  auto placed(const Read& read) const {
    try {
      return read();
    } catch (const LabError& error) {
      fail(error.what());
    }
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
  LabStep& step() {
    assert(!lab_.steps.empty());
    return lab_.steps.back();
  }
  bool first_step() const { return lab_.steps.size() == 1; }
  Prediction& prediction(std::string_view key);

  void take_answer(std::string_view value);
  void take_seconds(std::string_view value);
  void take_needs(std::string_view value);
  void take_minutes(std::string_view key, std::string_view value);
  void take_show(std::string_view value);
  void take_speed(std::string_view value);
  void take_view(std::string_view value);
  void take_color(std::string_view value);

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
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";  // which some editors put first
  if (text_.starts_with(byte_order_mark)) text_.remove_prefix(byte_order_mark.size());
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

/// What is wrong in one line of a block says nothing of later lines, so all such lines are reported at once; where
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
    if (line != "```lab") fail("the only block that a lab may have is ```lab; remove this one, or rename it");
    return begin_block();
  }
  if (line.starts_with("## ")) return begin_step(trimmed(line.substr(3)));
  if (line.starts_with("# ")) {
    if (!lab_.title.empty()) fail("a lab has one title; begin a step with ##");
    lab_.title = card_text(trimmed(line.substr(2)));
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
  lab_.steps.emplace_back().title = card_text(title);
  step_line_ = line_;
  had_block_ = false;
}

void LabReader::begin_block() {
  if (had_block_)
    fail(lab_.steps.empty() ? "the lab has a ```lab block under its title already; put both in one"
                            : "this step has a ```lab block already; put both in one, or begin another step with ##");
  assert(!in_block_);
  if (!lab_.steps.empty()) step().text = prose_.take();
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
  if (step().text.empty()) fail_at(step_line_, "this step has no text; write some under its title");
}

/// A prediction has its sentences, of which one is right, or its number.
void LabReader::end_prediction() {
  assert(step().prediction && rights_ >= 0 && std::size_t(rights_) <= step().prediction->choices.size());
  const Prediction& given = *step().prediction;
  if (given.choices.empty() && !answered_)
    fail_at(predict_line_, "this prediction has no answer; add a line such as answer: 0.098 m within 10 %, or choices");
  if (!given.choices.empty() && answered_)
    fail_at(predict_line_, "this prediction has an answer and choices; keep one of them");
  if (!given.choices.empty() && (rights_ != 1 || given.choices.size() < 2))
    fail_at(predict_line_, "exactly one of the choices begins with right:, the others with choice:");
}

void LabReader::end_block() {
  assert(in_block_ && block_line_ >= 1);
  in_block_ = false;
  if (lab_.steps.empty()) return;
  if (step().prediction) noted([&] { end_prediction(); });
  if (step().open) noted([&] { end_opening(); });
}

/// The preset must be there, and its settings such as it takes.
void LabReader::end_opening() {
  assert(step().open && open_line_ >= 1);
  const SceneSetup& opening = *step().open;
  try {
    const Preset preset = load_preset(find_preset(opening.preset).file);
    try {
      const std::string texture = with_settings(preset, opening.settings).texture;
      if (texture != preset.texture && !is_shipped_texture(texture))
        throw LabError("set: texture=" + texture + " is not a shipped texture, and a lab opens no other images");
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
  assert(settings.size() == set_lines_.size());
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
  if (std::find(lab_keys.begin(), lab_keys.end(), key) == lab_keys.end())
    fail("\"" + std::string(key) + "\" is not a key of a lab" +
         did_you_mean(key, lab_keys, "; known: " + joined(std::span(lab_keys).first<16>())));
  if (value.empty()) fail(std::string(key) + ": has no value; write it after the colon, or remove the line");
  if (lab_.steps.empty()) return take_minutes(key, value);
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
    step().open = SceneSetup{own ? beside.string() : std::string(value), {}};
    open_line_ = line_;
  } else if (key == "set") {
    if (!step().open) fail("set: changes the preset that the step opens; write a line open: before it");
    step().open->settings.emplace_back(value);
    set_lines_.push_back(line_);
  } else if (key == "predict") {
    if (step().prediction) fail("a step asks for one prediction; remove this line, or begin another step with ##");
    step().prediction.emplace().question = card_text(value);
    predict_line_ = line_;
  } else if (key == "choice" || key == "right") {
    Prediction& given = prediction(key);
    if (key == "right") given.right = given.choices.size(), ++rights_;
    given.choices.push_back(card_text(value));
  } else if (key == "answer") {
    take_answer(value);
  } else if (key == "do") {
    step().todo.push_back(card_text(value));
  } else if (key == "stop") {
    take_seconds(value);
  } else if (key == "check" || key == "find") {
    step().checks.push_back(placed([&] { return parse_condition(value, first_step()); }));
    step().checks.back().to_find = key == "find";
  } else if (key == "needs") {
    take_needs(value);
  } else if (key == "show") {
    take_show(value);
  } else if (key == "speed") {
    take_speed(value);
  } else if (key == "view") {
    take_view(value);
  } else if (key == "color") {
    take_color(value);
  } else if (key == "minutes") {
    fail("minutes: applies to the whole lab; put it in a ```lab block under the title, before the first ##");
  } else {
    fail("within belongs on the line of the answer: answer: 0.098 m within 10 %");
  }
}

/// The block under the title, which says of the lab as a whole how long it takes.
void LabReader::take_minutes(std::string_view key, std::string_view value) {
  if (key != "minutes")
    fail(std::string(key) +
         ": belongs to a step; the block under the title contains only minutes:. Begin a step with a " +
         "line such as ## Look first");
  const auto minutes = plain_number(value);
  if (!minutes || *minutes < 1 || *minutes > 600 || *minutes != std::floor(*minutes))
    fail("minutes: is a whole number from 1 to 600, such as minutes: 15");
  lab_.minutes = int(*minutes);
}

void LabReader::take_show(std::string_view value) {
  if (std::find(lab_cards.begin(), lab_cards.end(), value) == lab_cards.end())
    fail("show: there is no card \"" + std::string(value) + "\"" +
         did_you_mean(value, lab_cards, "; known: " + joined(lab_cards)));
  step().show = value;
}

void LabReader::take_speed(std::string_view value) {
  const auto speed = plain_number(value);
  if (!speed || *speed < 0.001 || *speed > 10)
    fail("speed: is simulated time over real time, from 0.001 to 10, such as speed: 0.1");
  step().speed = speed;
}

void LabReader::take_view(std::string_view value) {
  const auto view = plain_number(value);
  if (!view || *view < 1 || *view > 5 || *view != std::floor(*view))
    fail("view: is 1 (triangles), 2 (connections), 3 (both), 4 (outlines) or 5 (points)");
  step().view = int(*view);
}

void LabReader::take_color(std::string_view value) {
  std::vector<std::string_view> names;
  for (const FieldInfo& field : particle_fields()) names.push_back(field.name);
  if (std::find(names.begin(), names.end(), value) == names.end())
    fail("color: no field is called \"" + std::string(value) + "\"" +
         did_you_mean(value, names, "; known: " + joined(names)));
  step().color = value;
}

void LabReader::take_needs(std::string_view value) {
  if (value != "opencl") fail("a step can need only opencl, not \"" + std::string(value) + "\"");
  step().needs_opencl = true;
}

void LabReader::take_seconds(std::string_view value) {
  const std::vector<std::string> words = words_in(value);
  assert(!words.empty());
  const auto seconds = plain_number(words[0]);
  if (!seconds || *seconds <= 0 || words.size() > 2 || (words.size() == 2 && words[1] != "s"))
    fail("stop: is a simulated time above 0, such as stop: 2 s");
  step().stop = seconds;
}

void LabReader::take_answer(std::string_view value) {
  Prediction& given = prediction("answer");
  answered_ = true;  // if perhaps not well: that is reported separately
  placed([&] { parse_answer(value, first_step(), given); });
}

}  // namespace

Lab parse_lab(std::string_view text, std::string_view source, const std::filesystem::path& folder) {
  return LabReader(text, source, folder).read();
}

Lab load_lab(const std::filesystem::path& file) {
  std::string text;
  try {
    text = read_input(file, "lab", most_bytes);
  } catch (const InputError& problem) {
    throw LabError(problem.what());
  }
  Lab lab = parse_lab(text, file.string(), file.parent_path());
  lab.label = file.stem().string();
  return lab;
}

}  // namespace tyglab
