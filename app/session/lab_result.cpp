// The result of a lab, reported when the student leaves it.
#include <algorithm>
#include <cassert>
#include <string>
#include <vector>

#include "app/session/lab_state.h"

namespace tyglab {
namespace {

/// "; 2 of 3 predictions were right", of those that count and that a step has answered; nothing where there is none.
std::string predictions_in_words(const LabRun& run) {
  int asked = 0, right = 0;
  for (std::size_t k = 0; k < run.records.size(); ++k) {
    const StepRecord& record = run.records[k];
    if (run.lab.steps[k].prediction && record.predicted && record.done && !record.looked)
      ++asked, right += record.right;
  }
  if (asked == 0) return {};
  if (asked == 1) return right == 1 ? "; the prediction was right" : "; the prediction was wrong";
  return "; " + std::to_string(right) + " of " + std::to_string(asked) + " predictions " +
         (right == 1 ? "was" : "were") + " right";
}

/// "step 2", "steps 1 and 2", "steps 1, 2 and 4".
std::string steps_in_words(const std::vector<int>& steps) {
  assert(!steps.empty());
  std::string text = steps.size() == 1 ? "step " : "steps ";
  for (std::size_t n = 0; n < steps.size(); ++n)
    text += (n == 0 ? "" : n + 1 == steps.size() ? " and " : ", ") + std::to_string(steps[n]);
  return text;
}

/// Those before the last one that was done here, from `done` on.
std::vector<int> skipped_steps(const LabRun& run, int done) {
  std::vector<int> skipped, since;
  for (int k = done; k < int(run.records.size()); ++k) {
    since.push_back(k + 1);
    if (!run.records[std::size_t(k)].done) continue;
    since.pop_back();
    skipped.insert(skipped.end(), since.begin(), since.end()), since.clear();
  }
  return skipped;
}

/// " with 1 of 3 steps done", " before its first step was done".
std::string steps_done_in_words(int done, int steps) {
  assert(done >= 0 && done < steps);
  if (done == 0) return " before its first step was done";
  return " with " + std::to_string(done) + " of " + std::to_string(steps) + " steps done";
}

}  // namespace

std::string lab_result(const LabRun& run, int done) {
  const int steps = int(run.lab.steps.size());
  assert(run.records.size() == run.lab.steps.size() && done >= 0 && done <= steps);
  const std::vector<int> skipped = skipped_steps(run, done);
  const int here = int(std::count_if(run.records.begin(), run.records.end(), [](auto& record) { return record.done; }));
  const bool before = done == steps && here < steps;
  const std::string title = "“" + run.lab.title + "”";
  std::string text;
  if (done == steps && !before)
    text = title + " is done";
  else if (!before && !skipped.empty())
    text = "You left " + title + "; " + steps_in_words(skipped) +
           (skipped.size() == 1 ? " was skipped and is still to be done" : " were skipped and are still to be done");
  else
    text = "You left " + title + steps_done_in_words(before ? here : done, steps) +
           (before ? ", which you had finished before" : "");
  return text + predictions_in_words(run) + ". Ctrl+L lists all labs.";
}

}  // namespace tyglab
