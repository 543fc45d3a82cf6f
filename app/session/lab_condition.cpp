#include "app/session/lab.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <span>

#include "app/session/observables.h"
#include "core/integrators/scheme.h"
#include "core/model/notation.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

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

static_assert(relation_signs.size() == std::size_t(Relation::greater) + 1);
std::string known_name(const std::string& name) {
  if (is_observable(name)) return name;
  throw LabError("\"" + name + "\" is not a quantity or state that a check can use" +
                 did_you_mean(name, observable_names(), "; docs/labs/README.md lists them"));
}

Operand word_operand(const std::string& name, const std::vector<std::string>& words) {
  if (words.size() != 3) throw LabError(name + " is compared with a single word, as in check: integrator = euler");
  assert(is_word(name) && find_observable(name)->words != nullptr);
  const auto known = find_observable(name)->words();
  if (std::find(known.begin(), known.end(), words[2]) == known.end())
    throw LabError(name + " is never \"" + words[2] + "\"" + did_you_mean(words[2], known, ".") +
                   " Known: " + joined(known));
  Operand given;
  given.word = words[2];
  return given;
}

/// From the word of that number on: "180 N/m", "0.5 * F_g", "before.error". `unit`: what may stand behind a number.
Operand operand(const std::vector<std::string>& words, std::size_t from, std::string_view unit, bool first_step) {
  if (from >= words.size()) throw LabError("a value is missing, as in check: k_s >= 180");
  Operand given;
  const auto number = plain_number(words[from]);
  if (number) {
    given.factor = *number, ++from;
    const std::string after = joined(std::span(words).subspan(from), " ");
    if (after.empty() || after == unit) return given;
    if (words[from] != "*")
      throw LabError("the unit is " + (unit.empty() ? "none" : std::string(unit)) + ", not " + after +
                     "; a number times a quantity is written 0.5 * F_g");
    ++from;
  }
  if (from + 1 != words.size())
    throw LabError(
        "a value is a number with its unit, a quantity such as F_g, or a number times one, such as 0.5 * F_g");
  given.before = words[from].starts_with("before.");
  given.name = known_name(given.before ? words[from].substr(7) : words[from]);
  if (is_word(given.name)) throw LabError(given.name + " is a word, which a number cannot be compared with");
  if (given.before && first_step)
    throw LabError("there is no step before the first, so it can have no before." + given.name);
  if (given.before && given.name == "apart")
    throw LabError("apart is already measured from the step before; compare another quantity");
  return given;
}

constexpr std::array<std::string_view, 2> span_words{"throughout", "once"};

bool is_span_word(const std::string& word) {
  return word == "throughout" || word == "once" || word == "for" || word == "when";
}

/// Takes "throughout", "once", "for 0.5 s" or "when torn > 0" from the end of a check's words.
void take_span(std::vector<std::string>& words, bool first_step, Condition& given) {
  const auto first = std::find_if(words.begin(), words.end(), is_span_word);
  if (first == words.end()) return;
  const std::vector<std::string> suffix(first, words.end());
  words.erase(first, words.end());
  if (suffix[0] == "when") {
    given.span = Span::when;
    if (std::any_of(suffix.begin() + 1, suffix.end(), is_span_word))
      throw LabError("a plain check follows when, without throughout, once, for or another when");
    if (suffix.size() == 1) throw LabError("when needs a check after it, such as: F_max < 0.1 N when torn > 0");
    given.when.push_back(parse_condition(joined(std::span(suffix).subspan(1), " "), first_step));
    return;
  }
  if (std::any_of(suffix.begin() + 1, suffix.end(), is_span_word))
    throw LabError("a check has one of throughout, once, for and when; write another check: line for the other");
  if (suffix[0] == "for") {
    const auto seconds = suffix.size() > 1 ? plain_number(suffix[1]) : std::nullopt;
    if (!seconds || *seconds <= 0 || suffix.size() > 3 || (suffix.size() == 3 && suffix[2] != "s"))
      throw LabError("for is followed by a simulated time above 0, such as: fastest < 0.1 m/s for 0.5 s");
    given.span = Span::lasting, given.seconds = *seconds;
    return;
  }
  if (suffix.size() > 1) throw LabError(suffix[0] + " ends a check; remove the text after it");
  given.span = suffix[0] == "once" ? Span::once : Span::throughout;
}

/// Whether that quantity can be judged so.
void check_span(const Condition& given, const std::vector<std::string>& words) {
  if (words.size() > 3 && given.span == Span::now)
    for (const std::string_view known : span_words)
      if (words.back().size() > 2 && nearest(words.back(), std::span(&known, 1)))
        throw LabError("\"" + words.back() + "\" ends no check; did you mean " + std::string(known) + "?");
  if (given.span == Span::now) return;
  const bool measured = is_measured(given.name) || (!given.when.empty() && is_measured(given.when[0].name));
  if (measured)
    throw LabError(given.name +
                   " or what it depends on is measured beside the motion, not in every step; write the "
                   "check without throughout, once, for and when");
  if (given.span != Span::when && (given.name == "t" || given.name == "steps"))
    throw LabError(given.name + " only grows: write the check without throughout, once and for");
}

/// "to 5 % in 0.5 s", or also "from 2 s", of a check that has its moment.
void parse_narrowing(const std::vector<std::string>& words, Condition& given) {
  const auto number = [&](std::size_t k) { return k < words.size() ? plain_number(words[k]).value_or(0) : 0; };
  const auto seconds = [&](std::size_t k, std::string_view word) {
    return words[k] == word && number(k + 1) > 0 && words[k + 2] == "s";
  };
  const bool percent = words.size() >= 8 && words[2] == "to" && words[4] == "%" && number(3) > 0 && number(3) <= 50;
  const bool whole = percent && seconds(5, "in") && (words.size() == 8 || (words.size() == 11 && seconds(8, "from")));
  if (given.span != Span::when || !whole || find_row(given.name) == nullptr)
    throw LabError("a constant is narrowed down as in check: k_s narrowed to 5 % in 0.5 s when diverged = yes");
  given.span = Span::narrowed, given.relation = Relation::at_most;
  given.right.factor = number(3) / 100, given.seconds = number(6), given.from = number(9);
}

std::string_view sign_of(Relation relation) {
  return std::find_if(relation_signs.begin(), relation_signs.end(),
                      [&](const RelationSign& s) { return s.relation == relation; })
      ->shown;
}

std::string words_of_span(const Condition& condition) {
  switch (condition.span) {
    case Span::now:
      return "";
    case Span::throughout:
      return " throughout";
    case Span::once:
      return " once";
    case Span::lasting:
      return " for " + shortest_number(condition.seconds) + " s";
    case Span::when:
      assert(condition.when.size() == 1);
      return " when " + (asks_divergence(condition.when[0]) ? "the cloth diverges" : words_of(condition.when[0]));
    case Span::narrowed:
      break;
  }
  return "";
}

/// "Nothing else changed", "The simulation diverges", "Integrator: Verlet", "Precision: not float".
std::string words_of_word(const Condition& condition) {
  assert(is_word(condition.name));
  const Observable& row = *find_observable(condition.name);
  const bool same = condition.relation == Relation::equal;
  if (!row.asked[1].empty()) return std::string(row.asked[same == (condition.right.word == "yes") ? 1 : 0]);
  return std::string(row.label) + (same ? ": " : ": not ") + shown_word(condition.name, condition.right.word);
}

/// "t as in the previous lab step", "dt half as large as in the previous lab step", "energy > 2 × its value in the
/// previous lab step".
std::string words_of_before(const Condition& condition) {
  const Operand& right = condition.right;
  const std::string before = " in the previous lab step";
  if (condition.relation == Relation::equal && right.name == condition.name) {
    if (right.factor == 1) return condition.name + " as" + before;
    if (right.factor == 0.5) return condition.name + " half as large as" + before;
    if (right.factor == 2) return condition.name + " twice as large as" + before;
  }
  std::string text = condition.name + " " + std::string(sign_of(condition.relation)) + " ";
  if (right.factor != 1) text += shortest_number(right.factor) + " × ";
  return text + (right.name == condition.name ? "its value" : right.name) + before;
}

std::string words_of_number(const Condition& condition) {
  const Operand& right = condition.right;
  if (right.before) return words_of_before(condition);
  if (condition.name == "apart" && condition.relation == Relation::equal && right.name.empty() && right.factor == 0)
    return "Each particle where it was in the previous lab step";
  std::string text = label_of(condition.name) + " " + std::string(sign_of(condition.relation)) + " ";
  if (right.name.empty()) {
    const std::string_view unit = unit_of(condition.name);
    return text + shortest_number(right.factor) + (unit.empty() ? "" : " " + std::string(unit));
  }
  if (right.factor != 1) text += shortest_number(right.factor) + " × ";
  return text + right.name;
}

}  // namespace

bool asks_divergence(const Condition& condition) {
  return condition.name == "diverged" && condition.relation == Relation::equal && condition.right.word == "yes";
}

std::string label_of(std::string_view name) {
  const Observable* row = find_observable(name);
  return std::string(row != nullptr && !row->label.empty() ? row->label : name);
}

std::string shown_word(std::string_view name, std::string_view word) {
  if (name == "integrator") return std::string(scheme(word).title);
  const auto title = [word](const auto& names, const auto& titles) -> std::string {
    const auto k = std::find(names.begin(), names.end(), word);
    return std::string(k != names.end() ? titles[std::size_t(k - names.begin())] : word);
  };
  if (name == "contact") return title(contact_names, contact_titles);
  if (name == "self") return title(self_names, self_titles);
  if (name == "tearing.mode") return title(tearing_names, tearing_titles);
  if (word == engine_names[0]) return "CPU";
  return word == engine_names[1] ? "OpenCL" : std::string(word);
}

Condition parse_condition(std::string_view value, bool first_step) {
  std::vector<std::string> words = words_in(value);
  Condition given;
  take_span(words, first_step, given);
  if (words.empty()) throw LabError("a check begins with a quantity, as in check: k_s >= 180 N/m throughout");
  given.name = known_name(words[0]);
  check_span(given, words);
  if (given.name == "apart" && first_step)
    throw LabError("apart is measured from the step before, and there is none before the first");
  if (words.size() > 1 && words[1] == "narrowed") return parse_narrowing(words, given), given;
  const auto sign = std::find_if(relation_signs.begin(), relation_signs.end(),
                                 [&](const RelationSign& s) { return words.size() > 1 && s.sign == words[1]; });
  if (sign == relation_signs.end())
    throw LabError("write one of <, <=, =, !=, >= and > between " + words[0] + " and its value, with spaces around it");
  given.relation = sign->relation;
  if (!is_word(given.name)) {
    given.right = operand(words, 2, unit_of(given.name), first_step);
    return given;
  }
  if (given.relation != Relation::equal && given.relation != Relation::unlike)
    throw LabError(given.name + " is a word: compare it with = or !=");
  given.right = word_operand(given.name, words);
  return given;
}

void parse_answer(std::string_view value, bool first_step, Prediction& given) {
  std::vector<std::string> words = words_in(value);
  const auto within = std::find(words.begin(), words.end(), "within");
  const auto after = std::size_t(words.end() - within);
  const auto off = after > 1 ? plain_number(*(within + 1)) : std::nullopt;
  if (!off || *off <= 0 || within == words.begin())
    throw LabError("an answer needs a tolerance for the prediction: answer: 0.098 m within 10 %");
  given.relative = after == 3 && *(within + 2) == "%";
  given.within = given.relative ? *off / 100 : *off;
  words.erase(within, words.end());
  assert(!words.empty());
  // A number's unit is for people: any words.
  if (plain_number(words[0]) && (words.size() == 1 || words[1] != "*")) {
    given.unit = joined(std::span(words).subspan(1), " ");
    words.resize(1);
  }
  given.answer = operand(words, 0, "", first_step);
  if (!given.answer.name.empty()) given.unit = unit_of(given.answer.name);
  if (given.relative && given.answer.name.empty() && given.answer.factor == 0)
    throw LabError(
        "a percentage of 0 is 0, so no other number would be right; give the tolerance in its unit: answer: 0 " +
        (given.unit.empty() ? "" : given.unit + " ") + "within 0.01");
}

std::string subject_of(const Condition& condition) {
  const std::string label = label_of(condition.name), span = words_of_span(condition);
  if (!is_word(condition.name)) {
    if (label != condition.name) return label + span;
    // A quantity's word takes an article, a symbol none.
    return (condition.name == "energy" ? "The value of the " : "The value of ") + label + span;
  }
  const bool sentence = !find_observable(condition.name)->asked[1].empty();
  return label + span + (sentence ? "?" : "");
}

std::string words_of(const Condition& condition) {
  if (condition.span == Span::narrowed)
    return label_of(condition.name) + " to within " + shortest_number(100 * condition.right.factor) +
           " %: find a value at which " +
           (asks_divergence(condition.when[0]) ? "the cloth diverges" : words_of(condition.when[0])) +
           ", and one at which it does not in " + shortest_number(condition.seconds) + " s";
  return (is_word(condition.name) ? words_of_word(condition) : words_of_number(condition)) + words_of_span(condition);
}

}  // namespace tyglab
