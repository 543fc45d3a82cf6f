#include "app/session/lab_condition.h"

#include <algorithm>
#include <array>
#include <span>

#include "app/session/lab_text.h"
#include "app/session/observables.h"
#include "core/model/notation.h"
#include "core/model/readable.h"
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

std::string known_name(const std::string& name) {
  if (is_observable(name)) return name;
  throw LabError("\"" + name + "\" is not a quantity or state that a check can use" +
                 did_you_mean(name, observable_names(), "; docs/labs/README.md lists them"));
}

Operand word_operand(const std::string& name, const std::vector<std::string>& words) {
  if (words.size() != 3) throw LabError(name + " is compared with one word, such as check: integrator = euler");
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
  if (from >= words.size()) throw LabError("a value is missing, such as check: k_s >= 180");
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

}  // namespace

Condition parse_condition(std::string_view value, bool first_step) {
  const std::vector<std::string> words = words_in(value);
  Condition given;
  given.name = known_name(words[0]);
  if (given.name == "apart" && first_step)
    throw LabError("apart is measured from the step before, and there is none before the first");
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
