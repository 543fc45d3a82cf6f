// A lab consists of steps in which a student predicts and experiments, and the app checks the result. It is read from
// Markdown (docs/labs/README.md describes the format).
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace tyglab {

/// An error in a lab file. `what()` names file, line and fix.
class LabError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The right side of a check, or an answer: a number, an observable times a factor, or a word.
struct Operand {
  double factor = 1;    ///< the number itself where there is no name
  std::string name;     ///< of an observable
  bool before = false;  ///< its value when the step before was completed
  std::string word;     ///< "euler", "yes"
};

enum class Relation { less, at_most, equal, unlike, at_least, greater };

/// The part of the motion to which a condition applies; the motion begins with the last restart, or with the step.
enum class Span {
  now,         ///< at the moment at which the step is completed
  throughout,  ///< at every moment of the motion
  once,        ///< at some moment of it
  lasting,     ///< for the last `seconds` of it
  when,        ///< at the first moment at which another condition holds
  narrowed     ///< of a constant: found between a value at which another condition comes true, and one at which not
};

/// A condition: a relation between the observable `name` and the operand.
struct Condition {
  std::string name;
  Relation relation = Relation::equal;
  Operand right;
  Span span = Span::now;
  double seconds = 0;           ///< simulated, of Span::lasting; of Span::narrowed: after which it has not come true
  double from = 0;              ///< s, of Span::narrowed: what happens before that simulated time does not count
  std::vector<Condition> when;  ///< of Span::when and Span::narrowed: the one that decides the moment
  bool to_find = false;         ///< the student is to find out what it asks for, which is shown once the step is done
};

/// The student's prediction: a number, or one of several sentences.
struct Prediction {
  std::string question;
  std::vector<std::string> choices;  ///< empty: a number is typed
  std::size_t right = 0;             ///< which of them is
  Operand answer;
  double within = 0;      ///< how far a number may be off: in its unit, or as a part of it
  bool relative = false;  ///< as a part
  std::string unit;
};

/// A preset, and settings ("k_s=500") for it.
struct SceneSetup {
  std::string preset;  ///< shipped name or path
  std::vector<std::string> settings;
};

/// Paragraphs of plain text.
using Paragraphs = std::vector<std::string>;

struct LabStep {
  std::string title;
  Paragraphs text;
  std::optional<SceneSetup> open;
  std::optional<Prediction> prediction;
  Paragraphs todo;             ///< shown once the prediction is made
  std::optional<double> stop;  ///< s: simulated time at which the motion pauses by itself
  std::vector<Condition> checks;
  bool needs_opencl = false;
  std::string show;             ///< a card or plot that comes into sight, by its name in lab_cards; empty: none
  std::optional<double> speed;  ///< simulated seconds per second; none: as the student has set it
  std::optional<int> view;      ///< 1 to 5
  std::string color;            ///< name of the field that colors the cloth; empty: its own look
  Paragraphs explanation;       ///< shown afterwards
};

/// The names that `show` accepts.
inline constexpr std::array<std::string_view, 9> lab_cards{"forces",      "height", "stability", "accuracy", "energy",
                                                           "performance", "copies", "map",       "step"};

struct Lab {
  std::string label;  ///< the file's name without .md
  std::string title;
  Paragraphs summary;  ///< the first of them says what it is for
  int minutes = 0;     ///< that it takes, about; 0: the file does not say
  std::vector<LabStep> steps;
};

/// Reads a lab's text; `source` names it in errors, and presets that are not shipped are looked for in `folder`. Throws
/// LabError; never returns a partial lab.
Lab parse_lab(std::string_view text, std::string_view source, const std::filesystem::path& folder = {});
/// Reads a file. Throws LabError.
Lab load_lab(const std::filesystem::path& file);

/// The check in words: "k_s ≥ 180 N/m throughout", "Integrator: Verlet".
std::string words_of(const Condition& condition);
/// The same without the answer: "The value of k_s when the cloth diverges", "Diverged?".
std::string subject_of(const Condition& condition);

// The conditions of checks and answers, as a lab writes them. words_of() (lab.h) puts them into words.

/// Reads "k_s >= 180 N/m throughout", "integrator = euler", "error < 0.3 * before.error", "F_max < 0.1 N when torn >
/// 0". In the first step nothing can be asked of the one before. Throws LabError, which does not name the place.
Condition parse_condition(std::string_view value, bool first_step);

/// Reads "0.098 m within 10 %", "dt_crit within 0.0001" into a prediction: the answer, its unit and how far a number
/// may be off. Throws as parse_condition does.
void parse_answer(std::string_view value, bool first_step, Prediction& given);

/// "diverged = yes": a moment that has a verb of its own.
bool asks_divergence(const Condition& condition);

/// The name of a quantity on the card: "k_s", "Integrator".
std::string label_of(std::string_view name);

/// A word of an observable as people read it: "Verlet" for "verlet", "CPU" for "cpu".
std::string shown_word(std::string_view name, std::string_view word);

// Words, numbers and paragraphs of a lab's text.

/// Without the spaces before and behind it.
std::string_view trimmed(std::string_view text);

/// The text as the card shows it: in one piece, without the line breaks of the file and without Markdown's `code` and
/// **strong**.
std::string card_text(std::string_view text);

std::vector<std::string> words_in(std::string_view text);

/// None where it is no number, or none that is finite ("nan").
std::optional<double> plain_number(std::string_view text);

/// Lines are gathered into paragraphs: an empty line or a "- " begins a new one.
class Gathered {
 public:
  void add(std::string_view line);
  /// The gathered paragraphs as the card shows them; starts anew.
  Paragraphs take();

 private:
  Paragraphs paragraphs_;
  bool open_ = false;
};

}  // namespace tyglab
