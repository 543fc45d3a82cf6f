// A student's prediction: its input, and whether it was right.
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <string>

#include "app/base/text.h"
#include "app/session/lab_check.h"
#include "app/session/lab_state.h"
#include "app/session/session.h"

namespace tyglab {
namespace {

struct Quantity {
  std::string_view unit, name;
};
/// What cannot be negative is told by its unit.
constexpr std::array<Quantity, 4> never_negative{
    {{"s", "A time"}, {"kg", "A mass"}, {"N/m", "A stiffness"}, {"N s/m", "A damping constant"}}};

}  // namespace

std::string refusal_of(const Prediction& asked, std::string_view typed) {
  const std::string in_unit = asked.unit.empty() ? "" : " in " + asked.unit;
  const auto number = typed_number(typed, asked.unit);
  if (!number)
    return "“" + std::string(typed) + "” is not a number" + in_unit + ". Type one such as 0.31 or 1e-4" +
           (asked.unit.empty() ? "." : ", without a unit or" + in_unit + ".");
  const auto* quantity = std::find_if(never_negative.begin(), never_negative.end(),
                                      [&](const Quantity& q) { return q.unit == asked.unit; });
  const bool asked_below = asked.answer.name.empty() && asked.answer.factor < 0;  // a difference of two
  if (*number < 0 && quantity != never_negative.end() && !asked_below)
    return std::string(quantity->name) + " cannot be negative. Type 0 " + asked.unit + " or more.";
  return {};
}

bool predict(Session& session) {
  assert(session.labs.run);
  LabRun& run = *session.labs.run;
  StepRecord& record = run.record();
  if (!run.now().prediction || record.predicted) return false;
  const Prediction& asked = *run.now().prediction;
  assert(record.chosen < int(asked.choices.size()));
  if (asked.choices.empty() ? !refusal_of(asked, record.typed).empty() : record.chosen < 0) return false;
  record.predicted = true;
  if (run.runs_on) session.pacing.playing = true;
  return true;
}

void judge_prediction(Session& session, LabRun& run) {
  assert(run.record().done);
  if (!run.now().prediction) return;
  const Prediction& asked = *run.now().prediction;
  StepRecord& record = run.record();
  if (!asked.choices.empty()) {
    assert(asked.right < asked.choices.size());
    record.right = record.chosen == int(asked.right);
    return;
  }
  assert(asked.within > 0);
  std::optional<double> answer = value_of(session, asked.answer);
  // Of a constant that was narrowed down the middle, wherever it stands at this moment.
  for (std::size_t k = 0; k < record.seen.size(); ++k)
    if (const Condition& check = run.now().checks[k];
        check.name == asked.answer.name && narrowed(check, record.seen[k]))
      answer = (*record.seen[k].with + *record.seen[k].without) / 2;
  const auto said = typed_number(record.typed, asked.unit);
  if (!answer || !said) return;
  record.answer = *answer;
  record.right = std::abs(*said - *answer) <= asked.within * (asked.relative ? std::abs(*answer) : 1);
}

}  // namespace tyglab
