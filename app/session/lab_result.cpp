// What a lab came to, told when it is left.
#include <algorithm>

#include "app/session/lab_state.h"

namespace tyglab {
namespace {

/// "; 2 of 3 predictions were right", of those that a step has answered; nothing where there is none.
std::string predictions_in_words(const LabRun& run) {
  int asked = 0, right = 0;
  for (std::size_t k = 0; k < run.records.size(); ++k) {
    const StepRecord& record = run.records[k];
    if (run.lab.steps[k].prediction && record.predicted && record.done) ++asked, right += record.right;
  }
  if (asked == 0) return {};
  if (asked == 1) return right == 1 ? "; the prediction was right" : "; the prediction was wrong";
  return "; " + std::to_string(right) + " of " + std::to_string(asked) + " predictions were right";
}

}  // namespace

std::string lab_result(const LabRun& run, int done) {
  const int steps = int(run.lab.steps.size());
  const auto ahead = [](const StepRecord& record) { return record.done; };
  const bool skipped = done < steps && std::any_of(run.records.begin() + done, run.records.end(), ahead);
  std::string text = "“" + run.lab.title + "” ";
  if (done == steps)
    text += "is done";
  else if (skipped)
    text += "ends here; step " + std::to_string(done + 1) + " was skipped and is still to be done";
  else
    text += "ends here with " + std::to_string(done) + " of " + std::to_string(steps) + " steps done";
  return text + predictions_in_words(run) + ". Ctrl+L lists all labs.";
}

}  // namespace tyglab
