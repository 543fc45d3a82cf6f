#include "app/session/lab_state.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/base/data_files.h"
#include "app/base/numbers.h"
#include "app/base/preset_files.h"
#include "app/base/settings.h"
#include "app/session/observables.h"
#include "app/session/session.h"
#include "core/engines/opencl/opencl_devices.h"
#include "core/model/notation.h"

namespace tyglab {
namespace {

namespace fs = std::filesystem;

constexpr double equal_within = 1e-4;  // of a value: what "=" counts as equal; sliders give three digits

std::vector<fs::path> lab_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (entry.path().extension() == ".md" && entry.path().stem() != "README") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// Those that come with the program, then the user's own.
std::vector<fs::path> all_lab_files() {
  std::vector<fs::path> files = lab_files(data_folder() / "labs");
  if (const fs::path own = config_folder(); !own.empty())
    for (const fs::path& file : lab_files(own / "labs")) files.push_back(file);
  return files;
}

/// Whether a step asks for something of the one before.
bool looks_back(const LabStep& step) {
  const auto back = [](const Condition& c) { return c.right.before || c.name == "apart"; };
  return std::any_of(step.checks.begin(), step.checks.end(), back) ||
         (step.prediction && step.prediction->answer.before);
}

/// The last step up to `done` at which one can begin again.
std::size_t resumed_at(const Lab& lab, int done) {
  std::size_t at = std::size_t(done) < lab.steps.size() ? std::size_t(done) : 0;
  while (at > 0 && (!lab.steps[at].open || looks_back(lab.steps[at]))) --at;
  return at;
}

/// The value of an operand; none while it is not known.
std::optional<double> value_of(Session& session, const Operand& operand) {
  if (operand.name.empty()) return operand.factor;
  if (!operand.before) {
    const auto value = observe(session, operand.name);
    return value ? std::optional(operand.factor * *value) : std::nullopt;
  }
  const LabRun& run = *session.labs.run;
  if (run.step == 0) return std::nullopt;
  const auto& values = run.records[run.step - 1].outcome.values;
  const auto then = values.find(operand.name);
  return then != values.end() ? std::optional(operand.factor * then->second) : std::nullopt;
}

bool related(double left, Relation relation, double right) {
  const bool equal = std::abs(left - right) <= equal_within * std::max(std::abs(left), std::abs(right));
  switch (relation) {
    case Relation::less:
      return left < right;
    case Relation::at_most:
      return left <= right || equal;
    case Relation::equal:
      return equal;
    case Relation::unlike:
      return !equal;
    case Relation::at_least:
      return left >= right || equal;
    case Relation::greater:
      return left > right;
  }
  return false;
}

CheckState check_now(Session& session, const Condition& condition) {
  if (is_word(condition.name)) {
    const bool same = observe_word(session, condition.name) == condition.right.word;
    return same == (condition.relation == Relation::equal) ? CheckState::holds : CheckState::open;
  }
  const auto left = observe(session, condition.name), right = value_of(session, condition.right);
  if (!left || !right) return CheckState::unknown;
  return related(*left, condition.relation, *right) ? CheckState::holds : CheckState::open;
}

/// What the step that follows wants to know of this moment.
void keep_outcome(Session& session, LabRun& run) {
  StepOutcome& outcome = run.record().outcome;
  outcome = {};
  if (run.step + 1 >= run.lab.steps.size()) return;
  const LabStep& next = run.lab.steps[run.step + 1];
  const auto keep = [&](const Operand& operand) {
    if (!operand.before) return;
    if (const auto value = observe(session, operand.name)) outcome.values[operand.name] = *value;
  };
  if (next.prediction) keep(next.prediction->answer);
  for (const Condition& check : next.checks) {
    keep(check.right);
    if (check.name == "apart") outcome.state = session.simulation->read();
  }
}

/// Whether what was predicted is right; asked at the moment at which the step is done.
void judge_prediction(Session& session, LabRun& run) {
  if (!run.now().prediction) return;
  const Prediction& asked = *run.now().prediction;
  StepRecord& record = run.record();
  if (!asked.choices.empty()) {
    record.right = record.chosen == int(asked.right);
    return;
  }
  const auto answer = value_of(session, asked.answer);
  const auto said = typed_number(record.typed, asked.unit);
  if (!answer || !said) return;
  record.answer = *answer;
  record.right = std::abs(*said - *answer) <= asked.within * (asked.relative ? std::abs(*answer) : 1);
}

void complete(Session& session, LabRun& run) {
  run.record().done = run.show_explanation = true;
  judge_prediction(session, run);
  keep_outcome(session, run);
  int& done = session.labs.progress[run.lab.label];
  done = std::max(done, int(run.step) + 1);
}

}  // namespace

fs::path find_lab_file(const std::string& name_or_file) {
  std::error_code ignored;
  if (fs::exists(name_or_file, ignored)) return name_or_file;
  const std::vector<fs::path> files = all_lab_files();
  std::vector<std::string> names;
  for (const fs::path& file : files) {
    names.push_back(file.stem().string());
    if (names.back() == name_or_file) return file;
  }
  const auto meant = nearest(name_or_file, std::vector<std::string_view>(names.begin(), names.end()));
  throw LabError("'" + name_or_file + "' is neither a lab's name nor a file." +
                 (meant ? " Did you mean '" + std::string(*meant) + "'?" : "") + " `tyglab labs` lists the labs.");
}

std::vector<Lab> read_labs(std::vector<std::string>& problems) {
  std::vector<Lab> labs;
  for (const fs::path& file : all_lab_files()) {
    try {
      labs.push_back(load_lab(file));
    } catch (const LabError& error) {
      problems.emplace_back(error.what());
    }
  }
  return labs;
}

const std::vector<Lab>& find_labs(Session& session) {
  LabState& labs = session.labs;
  if (std::exchange(labs.looked, true)) return labs.list;
  labs.list = read_labs(labs.problems);
  for (const std::string& problem : labs.problems) session.messages.warning(problem);
  return labs.list;
}

int steps_done(const Session& session, const Lab& lab) {
  const auto done = session.labs.progress.find(lab.label);
  return done == session.labs.progress.end() ? 0 : std::clamp(done->second, 0, int(lab.steps.size()));
}

void begin_lab(Session& session, std::string_view label) {
  const std::vector<Lab>& list = find_labs(session);
  const auto lab = std::find_if(list.begin(), list.end(), [&](const Lab& l) { return l.label == label; });
  if (lab == list.end()) return session.messages.error("There is no lab " + std::string(label) + ".");
  if (put_away_copies(session)) session.messages.note("The copies were removed: a lab begins with one cloth.");
  ++session.counts.labs_begun;
  LabRun& run = session.labs.run.emplace();
  run.lab = *lab;
  run.records.resize(lab->steps.size());
  session.labs.opened.clear();
  enter_step(session, resumed_at(*lab, steps_done(session, *lab)));
}

void enter_step(Session& session, std::size_t step) {
  LabRun& run = *session.labs.run;
  run.step = std::min(step, run.lab.steps.size() - 1);
  run.show_explanation = false;
  if (!run.record().done) run.record() = {};
  run.record().checks.assign(run.now().checks.size(), CheckState::open);
  if (run.now().needs_opencl && !session.labs.opencl) session.labs.opencl = !opencl_devices().devices.empty();
  // What can only be read opens nothing that cannot run.
  if (!run.record().done && !cannot_be_done(session)) set_up_step(session);
}

void back_step(Session& session) {
  LabRun& run = *session.labs.run;
  if (run.step > 0) --run.step;
  run.show_explanation = false;
}

void set_up_step(Session& session) {
  const auto& opening = session.labs.run->now().open;
  if (!opening) return;
  session.pacing.playing = false;
  try {
    const PresetSource source = find_preset(opening->preset);
    // What a step before left behind is no work that could be lost.
    const bool own = !session.labs.opened.empty() && session.labs.opened == session.document.label;
    const bool shipped = source.file.parent_path() == data_folder() / "presets";
    session.request(request::Open{source.file, shipped, own, opening->settings});
    session.labs.opened = source.file.stem().string();
  } catch (const std::exception& error) {
    session.messages.error(error.what());
  }
}

void leave_lab(Session& session) {
  session.labs.run.reset();
}

bool predict(Session& session) {
  LabRun& run = *session.labs.run;
  StepRecord& record = run.record();
  if (!run.now().prediction || record.predicted) return false;
  const Prediction& asked = *run.now().prediction;
  if (asked.choices.empty() ? !typed_number(record.typed, asked.unit) : record.chosen < 0) return false;
  return record.predicted = true;
}

bool cannot_be_done(Session& session) {
  return session.labs.run->now().needs_opencl && session.labs.opencl == false;
}

bool lab_waits(const Session& session) {
  const LabState& labs = session.labs;
  return labs.run && !labs.run->record().done && !labs.opened.empty() && labs.opened != session.document.label;
}

void resume_lab(Session& session) {
  LabRun& run = *session.labs.run;
  while (run.step > 0 && !run.now().open) --run.step;
  set_up_step(session);
}

void watch_lab(Session& session) {
  if (!session.labs.run || lab_waits(session)) return;
  LabRun& run = *session.labs.run;
  StepRecord& record = run.record();
  if (record.done) return;
  const LabStep& step = run.now();
  const bool predicted = !step.prediction || record.predicted;
  if (cannot_be_done(session)) return predicted ? complete(session, run) : void();
  record.checks.resize(step.checks.size());
  bool all = predicted;
  for (std::size_t k = 0; k < step.checks.size(); ++k) {
    record.checks[k] = check_now(session, step.checks[k]);
    all &= record.checks[k] == CheckState::holds;
  }
  if (all) complete(session, run);
}

Wants lab_wants(const Session& session) {
  Wants wants;
  if (!session.labs.run || session.labs.run->record().done) return wants;
  const LabStep& step = session.labs.run->now();
  const auto need = [&](std::string_view name) {
    const Observable* row = find_observable(name);
    if (row != nullptr && row->needs != nullptr) wants.*row->needs = true;
  };
  if (step.prediction) need(step.prediction->answer.name);
  for (const Condition& check : step.checks) need(check.name), need(check.right.name);
  return wants;
}

int up_to_stop(const Session& session, int due) {
  if (!session.labs.run || !session.labs.run->now().stop || session.labs.run->record().done || lab_waits(session))
    return due;
  const double left = *session.labs.run->now().stop - session.simulation->time(), dt = session.preset().dt;
  if (left < dt / 2) return due;
  return std::min(due, int(std::min(std::ceil(left / dt - 0.5), 1e9)));
}

void pause_at_stop(Session& session) {
  if (!session.labs.run || !session.labs.run->now().stop || session.labs.run->record().done || session.steps_made == 0)
    return;
  if (lab_waits(session)) return;
  const double past = session.simulation->time() - *session.labs.run->now().stop, dt = session.preset().dt;
  if (past >= -dt / 2 && past < dt / 2) session.pacing.playing = false;
}

}  // namespace tyglab
