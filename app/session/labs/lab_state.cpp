#include "app/session/labs/lab_state.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/base/data_files.h"
#include "app/base/numbers.h"
#include "app/base/preset_files.h"
#include "app/session/labs/observables.h"
#include "app/ui/app.h"
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

/// The last step up to `done` at which one can begin anew.
std::size_t resumed_at(const Lab& lab, int done) {
  std::size_t at = std::size_t(done) < lab.steps.size() ? std::size_t(done) : 0;
  while (at > 0 && (!lab.steps[at].open || looks_back(lab.steps[at]))) --at;
  return at;
}

/// The value of an operand; none while it is not known.
std::optional<double> value_of(App& app, const Operand& operand) {
  if (operand.name.empty()) return operand.factor;
  if (!operand.before) {
    const auto value = observe(app, operand.name);
    return value ? std::optional(operand.factor * *value) : std::nullopt;
  }
  const LabRun& run = *app.labs.run;
  if (run.step == 0) return std::nullopt;
  const auto& values = run.records[run.step - 1].moment.values;
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

CheckState check_now(App& app, const Condition& condition) {
  if (is_word(condition.name)) {
    const bool same = observe_word(app, condition.name) == condition.right.word;
    return same == (condition.relation == Relation::equal) ? CheckState::holds : CheckState::open;
  }
  const auto left = observe(app, condition.name), right = value_of(app, condition.right);
  if (!left || !right) return CheckState::unknown;
  return related(*left, condition.relation, *right) ? CheckState::holds : CheckState::open;
}

/// What the step that follows wants to know of this moment.
void keep_moment(App& app, LabRun& run) {
  Moment& moment = run.record().moment;
  moment = {};
  if (run.step + 1 >= run.lab.steps.size()) return;
  const LabStep& next = run.lab.steps[run.step + 1];
  const auto keep = [&](const Operand& operand) {
    if (!operand.before) return;
    if (const auto value = observe(app, operand.name)) moment.values[operand.name] = *value;
  };
  if (next.prediction) keep(next.prediction->answer);
  for (const Condition& check : next.checks) {
    keep(check.right);
    if (check.name == "apart") moment.state = app.simulation->read();
  }
}

/// Whether what was predicted is right; asked at the moment at which the step is done.
void judge_prediction(App& app, LabRun& run) {
  if (!run.now().prediction) return;
  const Prediction& asked = *run.now().prediction;
  StepRecord& record = run.record();
  if (!asked.choices.empty()) {
    record.right = record.chosen == int(asked.right);
    return;
  }
  const auto answer = value_of(app, asked.answer);
  const auto said = typed_number(record.typed, asked.unit);
  if (!answer || !said) return;
  record.answer = *answer;
  record.right = std::abs(*said - *answer) <= asked.within * (asked.relative ? std::abs(*answer) : 1);
}

void complete(App& app, LabRun& run) {
  run.record().done = run.show_explanation = true;
  judge_prediction(app, run);
  keep_moment(app, run);
  int& done = app.settings.labs[run.lab.label];
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

const std::vector<Lab>& find_labs(App& app) {
  LabState& labs = app.labs;
  if (std::exchange(labs.looked, true)) return labs.list;
  labs.list = read_labs(labs.problems);
  for (const std::string& problem : labs.problems) app.messages.warning(problem);
  return labs.list;
}

int steps_done(const App& app, const Lab& lab) {
  const auto done = app.settings.labs.find(lab.label);
  return done == app.settings.labs.end() ? 0 : std::clamp(done->second, 0, int(lab.steps.size()));
}

void begin_lab(App& app, std::string_view label) {
  const std::vector<Lab>& list = find_labs(app);
  const auto lab = std::find_if(list.begin(), list.end(), [&](const Lab& l) { return l.label == label; });
  if (lab == list.end()) return app.messages.error("There is no lab " + std::string(label) + ".");
  if (put_away_copies(app)) app.messages.note("The copies have been put away: a lab begins with one cloth.");
  app.colors.choose(std::nullopt);  // of this session alone: the next one has the user's choice again
  LabRun& run = app.labs.run.emplace();
  run.lab = *lab;
  run.records.resize(lab->steps.size());
  app.labs.opened.clear();
  enter_step(app, resumed_at(*lab, steps_done(app, *lab)));
}

void enter_step(App& app, std::size_t step) {
  LabRun& run = *app.labs.run;
  run.step = std::min(step, run.lab.steps.size() - 1);
  run.show_explanation = false;
  if (!run.record().done) run.record() = {};
  run.record().checks.assign(run.now().checks.size(), CheckState::open);
  if (run.now().needs_opencl && !app.labs.opencl) app.labs.opencl = !opencl_devices().devices.empty();
  // What can only be read opens nothing that cannot run.
  if (!run.record().done && !cannot_be_done(app)) set_up_step(app);
}

void back_step(App& app) {
  LabRun& run = *app.labs.run;
  if (run.step > 0) --run.step;
  run.show_explanation = false;
}

void set_up_step(App& app) {
  const auto& opening = app.labs.run->now().open;
  if (!opening) return;
  app.pacing.playing = false;
  try {
    const PresetSource source = find_preset(opening->preset);
    // What a step before left behind is no work that could be lost.
    const bool own = !app.labs.opened.empty() && app.labs.opened == app.document.label;
    const bool shipped = source.file.parent_path() == data_folder() / "presets";
    app.request(request::Open{source.file, shipped, own, opening->settings});
    app.labs.opened = source.file.stem().string();
  } catch (const std::exception& error) {
    app.messages.error(error.what());
  }
}

void leave_lab(App& app) {
  app.labs.run.reset();
}

bool predict(App& app) {
  LabRun& run = *app.labs.run;
  StepRecord& record = run.record();
  if (!run.now().prediction || record.predicted) return false;
  const Prediction& asked = *run.now().prediction;
  if (asked.choices.empty() ? !typed_number(record.typed, asked.unit) : record.chosen < 0) return false;
  return record.predicted = true;
}

bool cannot_be_done(App& app) {
  return app.labs.run->now().needs_opencl && app.labs.opencl == false;
}

bool lab_waits(const App& app) {
  const LabState& labs = app.labs;
  return labs.run && !labs.run->record().done && !labs.opened.empty() && labs.opened != app.document.label;
}

void resume_lab(App& app) {
  LabRun& run = *app.labs.run;
  while (run.step > 0 && !run.now().open) --run.step;
  set_up_step(app);
}

void watch_lab(App& app) {
  if (!app.labs.run || lab_waits(app)) return;
  LabRun& run = *app.labs.run;
  StepRecord& record = run.record();
  if (record.done) return;
  const LabStep& step = run.now();
  const bool predicted = !step.prediction || record.predicted;
  if (cannot_be_done(app)) return predicted ? complete(app, run) : void();
  record.checks.resize(step.checks.size());
  bool all = predicted;
  for (std::size_t k = 0; k < step.checks.size(); ++k) {
    record.checks[k] = check_now(app, step.checks[k]);
    all &= record.checks[k] == CheckState::holds;
  }
  if (all) complete(app, run);
}

int up_to_stop(const App& app, int due) {
  if (!app.labs.run || !app.labs.run->now().stop || app.labs.run->record().done || lab_waits(app)) return due;
  const double left = *app.labs.run->now().stop - app.simulation->time(), dt = app.preset().dt;
  if (left < dt / 2) return due;
  return std::min(due, int(std::min(std::ceil(left / dt - 0.5), 1e9)));
}

void pause_at_stop(App& app) {
  if (!app.labs.run || !app.labs.run->now().stop || app.labs.run->record().done || app.steps_made == 0) return;
  if (lab_waits(app)) return;
  const double past = app.simulation->time() - *app.labs.run->now().stop, dt = app.preset().dt;
  if (past >= -dt / 2 && past < dt / 2) app.pacing.playing = false;
}

}  // namespace tyglab
