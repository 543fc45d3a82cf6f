#include "app/session/lab_state.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "app/base/files.h"
#include "app/base/settings.h"
#include "app/session/background_steps.h"
#include "app/session/document.h"
#include "app/session/observables.h"
#include "app/session/session.h"
#include "core/engines/opencl/opencl_devices.h"
#include "core/io/preset_io.h"
#include "core/model/effect.h"
#include "core/model/notation.h"

namespace tyglab {
namespace {

namespace fs = std::filesystem;

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
  const auto asks = [](const Condition& c) { return c.right.before || c.name == "apart"; };
  const auto back = [&](const Condition& c) { return asks(c) || std::any_of(c.when.begin(), c.when.end(), asks); };
  return std::any_of(step.checks.begin(), step.checks.end(), back) ||
         (step.prediction && step.prediction->answer.before);
}

/// The last step up to `done` at which one can begin again.
std::size_t resumed_at(const Lab& lab, int done) {
  assert(done >= 0 && !lab.steps.empty());
  std::size_t at = std::size_t(done) < lab.steps.size() ? std::size_t(done) : 0;
  while (at > 0 && (!lab.steps[at].open || looks_back(lab.steps[at]))) --at;
  return at;
}

/// The label of the preset that is open in a step.
std::string opened_in(const Lab& lab, std::size_t step) {
  while (step > 0 && !lab.steps[step].open) --step;
  return lab.steps[step].open ? fs::path(lab.steps[step].open->preset).stem().string() : std::string();
}

/// The step that is asked for, or the last before it at which one can begin, where `open` is the present preset: a step
/// that opens none goes on with that of the one before.
std::size_t nearest_beginning(const Lab& lab, std::size_t step, const std::string& open) {
  std::size_t at = std::min(step, lab.steps.size() - 1);
  while (at > 0 && (looks_back(lab.steps[at]) || (!lab.steps[at].open && opened_in(lab, at) != open))) --at;
  return at;
}

/// What the step that follows wants to know of this moment, and what this one has compared with the one before.
void keep_outcome(Session& session, LabRun& run) {
  assert(run.record().done);
  LabStepOutcome& outcome = run.record().outcome;
  outcome = {};
  for (const Condition& check : run.now().checks)
    if (const auto value = check.right.before ? observe(session, check.name) : std::nullopt)
      outcome.values[check.name] = *value;
  if (run.step + 1 >= run.lab.steps.size()) return;
  const LabStep& next = run.lab.steps[run.step + 1];
  const auto keep = [&](const Operand& operand) {
    if (!operand.before) return;
    if (const auto value = observe(session, operand.name)) outcome.values[operand.name] = *value;
  };
  if (next.prediction) keep(next.prediction->answer);
  const auto keep_for = [&](const Condition& check) {
    keep(check.right);
    if (check.name == "apart") outcome.state = session.simulation->read();
  };
  for (const Condition& check : next.checks) {
    keep_for(check);
    std::for_each(check.when.begin(), check.when.end(), keep_for);
  }
}

/// What must be known at the moment at which the step is done: the answer, and what the next step compares with.
std::vector<Operand> wanted_values(const LabRun& run) {
  std::vector<Operand> wanted;
  const auto& asked = run.now().prediction;
  if (asked && asked->choices.empty() && !asked->answer.before) wanted.push_back(asked->answer);
  if (run.step + 1 >= run.lab.steps.size()) return wanted;
  const LabStep& next = run.lab.steps[run.step + 1];
  const auto keep = [&](Operand operand) {
    if (operand.before) operand.before = false, wanted.push_back(std::move(operand));
  };
  if (next.prediction) keep(next.prediction->answer);
  for (const Condition& check : next.checks) {
    keep(check.right);
    for (const Condition& moment : check.when) keep(moment.right);
  }
  return wanted;
}

/// The constants that a step opens with; none where they cannot be read.
std::optional<Preset> opening_preset(const LabStep& step) {
  assert(step.open);
  try {
    return with_settings(load_preset(find_preset(step.open->preset).file), step.open->settings);
  } catch (const std::exception&) {
    return std::nullopt;  // who opens it says why
  }
}

/// The present step is watched from here on, and nothing is remembered of what was before.
void begin_watching(Session& session, LabRun& run) {
  StepRecord& record = run.record();
  record.checks.assign(run.now().checks.size(), CheckState::open);
  record.seen.assign(run.now().checks.size(), {});
  run.watch = {session.simulation->steps(), session.counts.touches};
  run.begun = session.requested_preset();
  if (run.now().open) run.begun = opening_preset(run.now()).value_or(run.begun);
  for (std::size_t k = 0; k < record.seen.size(); ++k) record.seen[k] = begun_late(session, run.now().checks[k]);
}

/// The first of those values that is not known yet but can become known; empty where none is missing.
std::string awaited_value(Session& session, const LabRun& run) {
  for (const Operand& operand : wanted_values(run))
    if (is_measured(operand.name) && !value_of(session, operand)) return operand.name;
  return {};
}

void complete(Session& session, LabRun& run) {
  assert(!run.record().done);
  run.record().done = run.show_explanation = true;
  judge_prediction(session, run);
  keep_outcome(session, run);
  // What has been skipped is still to be done.
  int& done = session.labs.progress[run.lab.label];
  while (std::size_t(done) < run.records.size() && run.records[std::size_t(done)].done) ++done;
}

/// What a step that is to be done again keeps: what was predicted, until it is done.
StepRecord begun_again(const StepRecord& before) {
  StepRecord record;
  std::copy(std::begin(before.typed), std::end(before.typed), record.typed);
  record.chosen = before.chosen, record.predicted = before.predicted, record.looked = before.looked;
  return record;
}

bool all_done(const std::vector<StepRecord>& records) {
  return std::all_of(records.begin(), records.end(), [](const StepRecord& record) { return record.done; });
}

/// The lab as it was left, up to the step at which it goes on; nothing of one that was done.
std::vector<StepRecord> records_of(const LabState& labs, const Lab& lab, std::size_t at) {
  assert(at < lab.steps.size());
  const auto left = labs.left.find(lab.label);
  if (left == labs.left.end() || left->second.size() != lab.steps.size())
    return std::vector<StepRecord>(lab.steps.size());
  std::vector<StepRecord> records = left->second;
  for (std::size_t k = at; k < records.size(); ++k) records[k] = begun_again(records[k]);
  return records;
}

/// Says what came of the lab, and remembers what was predicted and found in it.
void put_aside(Session& session, const LabRun& run) {
  LabState& labs = session.labs;
  session.messages.note(lab_result(run, steps_done(session, run.lab)));
  if (all_done(run.records)) {
    labs.left.erase(run.lab.label);
    return;
  }
  std::vector<StepRecord>& left = labs.left[run.lab.label] = run.records;
  // No step is gone on with that compares with a state of before (resumed_at).
  for (StepRecord& record : left) record.outcome.state.reset();
}

/// Sets the present experiment aside, with its copies.
void keep_experiment(Session& session) {
  constexpr std::size_t most = 4;
  settle(session);
  if (session.simulation->held()) session.simulation->apply(edit::Release{});
  session.copies.awaited.reset();
  if (!session.copies.lockstep.empty()) ++session.counts.copies, ++session.counts.cloths;
  std::vector<KeptExperiment>& list = session.labs.kept;
  list.push_back({session.document, session.requested_preset(), unsaved(session), session.simulation,
                  std::exchange(session.copies, {}), session.history, session.picked, session.auto_dt,
                  session.step_limit});
  if (list.size() > most) list.erase(list.begin() + 1);
  assert(list.size() <= most);
}

void end_lab(Session& session) {
  session.labs.run.reset();
  session.pacing.speed = session.labs.own_speed;
  session.pacing.restart_measure();
}

/// What the step wants to be seen, and at which speed.
void set_out(Session& session) {
  const LabStep& step = session.labs.run->now();
  session.pacing.speed = step.speed.value_or(session.labs.own_speed);
  session.pacing.restart_measure();
  if (step.view && !step.open) {
    Preset next = session.requested_preset();
    next.mode = *step.view;
    session.propose(std::move(next));
  }
  ++session.counts.lab_steps;
}

}  // namespace

std::string_view LabRun::shown() const {
  std::size_t at = step;
  while (at > 0 && lab.steps[at].show.empty()) --at;
  return lab.steps[at].show;
}

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
                 (meant ? " Did you mean '" + std::string(*meant) + "'?" : " The labs are " + joined(names) + "."));
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

void begin_lab(Session& session, std::string_view label, std::optional<std::size_t> step) {
  const std::vector<Lab>& list = find_labs(session);
  const auto lab = std::find_if(list.begin(), list.end(), [&](const Lab& l) { return l.label == label; });
  if (lab == list.end()) return session.messages.error("There is no lab " + std::string(label) + ".");
  if (!session.labs.run) {
    session.labs.own_speed = session.pacing.speed;
    keep_experiment(session);
    if (!session.labs.kept.back().copies.lockstep.empty())
      session.messages.note("A lab begins with one cloth. Your copies come back when you leave it.");
  } else if (lab_is_away(session) && unsaved(session)) {
    keep_experiment(session);
  }
  put_away_copies(session);
  session.step_limit = 0;  // no result may depend on the machine
  ++session.counts.labs_begun;
  LabRun& run = session.labs.run.emplace();
  run.lab = *lab;
  const std::size_t at =
      step ? nearest_beginning(*lab, *step, session.document.label) : resumed_at(*lab, steps_done(session, *lab));
  run.records = records_of(session.labs, *lab, at);
  session.labs.opened = at > 0 && !lab->steps[at].open ? session.document.label : std::string();
  enter_step(session, at);
}

void enter_step(Session& session, std::size_t step) {
  assert(session.labs.run && session.labs.run->records.size() == session.labs.run->lab.steps.size());
  LabRun& run = *session.labs.run;
  run.step = std::min(step, run.lab.steps.size() - 1);
  run.show_explanation = false;
  if (!run.record().done) run.record() = begun_again(run.record());
  begin_watching(session, run);
  run.runs_on = !run.now().open && session.pacing.playing;
  if (run.now().needs_opencl && !session.labs.opencl) session.labs.opencl = !opencl_devices().devices.empty();
  // What can only be read opens nothing that cannot run.
  if (run.record().done || cannot_be_done(session)) return;
  set_up_step(session);
  set_out(session);
}

void back_step(Session& session) {
  assert(session.labs.run);
  const std::size_t step = session.labs.run->step;
  if (step > 0) enter_step(session, step - 1);
}

void set_up_step(Session& session) {
  assert(session.labs.run);
  const LabStep& step = session.labs.run->now();
  if (!step.open) return;
  session.pacing.playing = false;
  try {
    const PresetSource source = find_preset(step.open->preset);
    const bool shipped = source.file.parent_path() == data_folder() / "presets";
    std::vector<std::string> settings = step.open->settings;
    if (step.view) settings.push_back("mode=" + std::to_string(*step.view));
    // What a step before left behind is no work that could be lost.
    if (lab_is_away(session) && unsaved(session)) keep_experiment(session);
    session.request(request::Open{source.file, shipped, true, std::move(settings)});
    session.labs.opened = source.file.stem().string();
  } catch (const std::exception& error) {
    session.messages.error(error.what());
  }
}

void leave_lab(Session& session) {
  LabState& labs = session.labs;
  if (!labs.run) return;
  put_aside(session, *labs.run);
  if (!lab_is_away(session)) return back_to_experiment(session);
  end_lab(session);
  std::erase_if(labs.kept, [](const KeptExperiment& kept) { return !kept.unsaved; });
  if (!labs.kept.empty())
    session.messages.note("“" + labs.kept.back().constants.name +
                          "” is kept in its state before the lab: “Back to your experiment”, in Ctrl+P, opens it.");
}

bool next_lab(Session& session) {
  if (!session.labs.run) return false;
  const std::vector<Lab>& list = find_labs(session);
  const LabRun& run = *session.labs.run;
  auto lab = std::find_if(list.begin(), list.end(), [&](const Lab& l) { return l.label == run.lab.label; });
  if (lab == list.end() || ++lab == list.end()) return false;
  put_aside(session, run);
  begin_lab(session, lab->label);
  return true;
}

bool no_work(const Session& session) {
  return session.labs.run && !session.labs.opened.empty() && !lab_is_away(session);
}

void back_to_experiment(Session& session) {
  LabState& labs = session.labs;
  const bool in_lab = labs.run.has_value();
  if (labs.kept.empty()) return in_lab ? end_lab(session) : void();
  KeptExperiment kept = std::move(labs.kept.back());
  labs.kept.pop_back();
  assert(kept.simulation != nullptr);
  if (unsaved(session)) keep_experiment(session);  // what was opened since
  if (in_lab) end_lab(session);
  session.pacing.playing = false;
  session.rebuild.drop();
  put_away_copies(session);
  settle(session);
  swap_in(session, std::move(kept.simulation));
  session.copies = std::move(kept.copies);
  if (!session.copies.lockstep.empty()) ++session.counts.copies;
  begin_document(session, std::move(kept.document));
  if (kept.constants != session.preset()) apply_edit(session, edit::Change{std::move(kept.constants)});
  session.history = std::move(kept.history);
  session.picked = kept.picked, session.auto_dt = std::move(kept.auto_dt), session.step_limit = kept.step_limit;
  ++session.counts.hands, ++session.counts.experiments_back;
}

bool cannot_be_done(Session& session) {
  return session.labs.run->now().needs_opencl && session.labs.opencl == false;
}

bool lab_is_away(const Session& session) {
  const LabState& labs = session.labs;
  return labs.run && !labs.opened.empty() && labs.opened != session.document.label;
}

bool lab_waits(const Session& session) {
  return lab_is_away(session) && !session.labs.run->record().done;
}

bool awaits_prediction(const Session& session) {
  return session.labs.run && session.labs.run->to_be_predicted() && !lab_waits(session);
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
  // Cards and gauges show what follows from constants without any motion.
  const bool opening = !session.requests.empty() || session.rebuild.opens();
  if (run.to_be_predicted() && !opening)
    record.looked |= !changed_constant(run.begun, session.requested_preset()).empty();
  const LabStep& step = run.now();
  const bool predicted = !step.prediction || record.predicted;
  if (cannot_be_done(session)) return predicted ? complete(session, run) : void();
  record.checks.resize(step.checks.size()), record.seen.resize(step.checks.size());
  const MotionChange change = follow_motion(session, run.watch);
  bool all = predicted;
  for (std::size_t k = 0; k < step.checks.size(); ++k) {
    record.checks[k] = judge(session, step.checks[k], change, record.seen[k]);
    all &= record.checks[k] == CheckState::holds;
  }
  run.awaited = all ? awaited_value(session, run) : std::string();
  if (all && run.awaited.empty()) complete(session, run);
}

namespace {

/// What the card that a step shows wants, whether or not a small window has room for it; null: nothing.
bool Wants::*wanted_by_card(const Session& session, std::string_view card) {
  static constexpr std::array<bool Wants::*, lab_cards.size()> wants{
      &Wants::forces, &Wants::height, &Wants::stability, &Wants::accuracy, &Wants::ledger,
      nullptr,        &Wants::copies, &Wants::map,       &Wants::step};
  const auto found = std::find(lab_cards.begin(), lab_cards.end(), card);
  bool Wants::*const wanted = found == lab_cards.end() ? nullptr : wants[std::size_t(found - lab_cards.begin())];
  const bool large = session.simulation->lattice().size() > AccuracyWatch::largest;
  return wanted == &Wants::accuracy && large ? nullptr : wanted;
}

}  // namespace

Wants lab_wants(const Session& session) {
  Wants wants;
  if (!session.labs.run || session.labs.run->record().done) return wants;
  const LabStep& step = session.labs.run->now();
  if (bool Wants::*const wanted = wanted_by_card(session, step.show)) wants.*wanted = true;
  const auto need = [&](std::string_view name) {
    const Observable* row = find_observable(name);
    if (row != nullptr && row->needs != nullptr) wants.*row->needs = true;
  };
  for (const Operand& operand : wanted_values(*session.labs.run)) need(operand.name);
  for (const Condition& check : step.checks) {
    need(check.name), need(check.right.name);
    for (const Condition& moment : check.when) need(moment.name), need(moment.right.name);
  }
  return wants;
}

int up_to_stop(const Session& session, int due) {
  assert(due >= 0);
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
