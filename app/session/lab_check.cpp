#include "app/session/lab_check.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "app/base/text.h"
#include "app/session/lab.h"
#include "app/session/observables.h"
#include "app/session/session.h"
#include "core/model/effect.h"
#include "core/model/fields.h"
#include "core/model/notation.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

constexpr double equal_within = 1e-4;  // of a value: what "=" counts as equal; sliders give three digits

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

/// At this moment, whatever the check's span.
CheckState judge_now(Session& session, const Condition& check) {
  if (is_word(check.name)) {
    const bool same = observe_word(session, check.name) == check.right.word;
    return same == (check.relation == Relation::equal) ? CheckState::holds : CheckState::open;
  }
  const auto left = observe(session, check.name), right = value_of(session, check.right);
  if (!left || !right) return CheckState::unknown;
  return related(*left, check.relation, *right) ? CheckState::holds : CheckState::open;
}

std::string with_unit(double value, std::string_view unit) {
  return short_number(value) + (unit.empty() ? "" : " " + std::string(unit));
}

/// "50 N/m", "off", "Euler"; empty where it is not known.
std::string value_in_words(Session& session, const std::string& name) {
  if (name == "untouched") return touched_by(session);
  if (is_word(name)) return shown_word(name, observe_word(session, name));
  const auto value = observe(session, name);
  if (!value) return {};
  const PresetRow* const row = find_row(name);
  if (row == nullptr) return quantity(*value, unit_of(name));  // it was measured
  return row->zero_is_off && *value == 0 ? "off" : with_unit(*value, unit_of(name));
}

void remember(Session& session, const Condition& check, bool holds, CheckMemory& memory) {
  assert(!memory.set);
  memory = {true, holds, session.simulation->time(), value_in_words(session, check.name)};
}

CheckState judge_throughout(Session& session, const Condition& check, CheckState now, CheckMemory& memory) {
  if (memory.set) return CheckState::broken;
  if (session.simulation->steps() == 0 || now == CheckState::holds) return now;
  remember(session, check, false, memory);
  return CheckState::broken;
}

CheckState judge_once(Session& session, const Condition& check, CheckState now, CheckMemory& memory) {
  if (!memory.set && now == CheckState::holds) remember(session, check, true, memory);
  return memory.set ? CheckState::holds : now;
}

/// While the cloth sleeps simulated time stands still, and so does all that is asked of it.
CheckState judge_lasting(Session& session, const Condition& check, CheckState now, CheckMemory& memory) {
  if (now != CheckState::holds) {
    memory = {};
    return now;
  }
  if (!memory.set) remember(session, check, true, memory);
  assert(check.seconds > 0);
  const double lasted = session.simulation->time() - memory.t;
  return lasted >= check.seconds - 1e-9 || session.asleep() ? CheckState::holds : CheckState::open;
}

CheckState judge_when(Session& session, const Condition& check, CheckState now, CheckMemory& memory) {
  if (!memory.set && judge_now(session, check.when[0]) == CheckState::holds)
    remember(session, check, now == CheckState::holds, memory);
  if (!memory.set) return CheckState::open;
  return memory.holds ? CheckState::holds : CheckState::broken;
}

/// A value counts once the moment has come with it, or has not in a time that is long enough. What is off says nothing.
CheckState judge_narrowed(Session& session, const Condition& check, CheckMemory& memory) {
  const double t = session.simulation->time(), value = observe(session, check.name).value_or(0);
  const bool off = value == 0 && find_row(check.name)->zero_is_off, early = t < check.from;
  const bool come = judge_now(session, check.when[0]) == CheckState::holds;
  if (come && !std::exchange(memory.set, true) && !early) memory.with = value;
  if (std::exchange(memory.watched, value) != value || early) memory.t = t;
  const bool lasted = t - memory.t >= check.seconds - 1e-9 || session.asleep();
  if (!memory.set && !off && !early && lasted) memory.without = value;
  return narrowed(check, memory) ? CheckState::holds : CheckState::open;
}

/// "180 N/m or more", "below 215 N/m", "Verlet": what is asked for.
std::string goal_in_words(Session& session, const Condition& check) {
  if (is_word(check.name)) {
    const std::string word = shown_word(check.name, check.right.word);
    return check.relation == Relation::equal ? word : "anything but " + word;
  }
  const auto value = value_of(session, check.right);
  const std::string number = value ? with_unit(*value, unit_of(check.name)) : check.right.name;
  switch (check.relation) {
    case Relation::less:
      return "below " + number;
    case Relation::at_most:
      return number + " or less";
    case Relation::equal:
      return number;
    case Relation::unlike:
      return "anything but " + number;
    case Relation::at_least:
      return number + " or more";
    case Relation::greater:
      return "above " + number;
  }
  return number;
}

bool is_upper(Relation relation) {
  return relation == Relation::less || relation == Relation::at_most;
}
bool is_lower(Relation relation) {
  return relation == Relation::greater || relation == Relation::at_least;
}

/// Whether its words are "no" and "yes", which are said in sentences.
bool has_sentences(std::string_view name) {
  const Observable* row = find_observable(name);
  return row != nullptr && !row->present[0].empty();
}

/// "with a higher k_s", "with k_s at 180 N/m or more": how the moment is to be reached. The value that the student is
/// to find is not given away.
std::string with_goal(Session& session, const Condition& check) {
  const std::string label = label_of(check.name);
  if (!check.to_find) return "with " + label + " at " + goal_in_words(session, check);
  return std::string("with ") +
         (is_upper(check.relation)   ? "a lower "
          : is_lower(check.relation) ? "a higher "
                                     : "another ") +
         label;
}

/// "lower it, then restart", "set it to 180 N/m or more, then restart": what mends a broken check; the restart alone
/// where the value is right by now, or is a result, which nobody can set.
std::string cure_in_words(Session& session, const Condition& check) {
  const bool result = !is_word(check.name) && find_observable(check.name) != nullptr;
  if (result || judge_now(session, check) == CheckState::holds) return "restart";
  if (is_word(check.name)) return "choose " + goal_in_words(session, check) + ", then restart";
  if (!check.to_find) return "set it to " + goal_in_words(session, check) + ", then restart";
  return std::string(is_upper(check.relation)   ? "lower it"
                     : is_lower(check.relation) ? "raise it"
                                                : "choose another value") +
         ", then restart";
}

/// "was 50 N/m": what it was when the check broke.
std::string past_in_words(const Condition& check, const CheckMemory& memory) {
  return label_of(check.name) + " was " + (memory.was.empty() ? "not known" : memory.was);
}

/// Why the present motion no longer counts, and what to do.
std::string broken_in_words(Session& session, const Condition& check, const CheckMemory& memory) {
  const std::string at = " at t = " + time_number(memory.t, session.preset().dt) + " s";
  if (check.name == "untouched")
    return (memory.was.empty() ? "Something else was changed" : memory.was) + at +
           ": restart, and change only what the task names";
  if (check.span == Span::when) {
    const bool divergence = asks_divergence(check.when[0]);
    const std::string moment = words_of(check.when[0]), again = ": restart, and reach it " + with_goal(session, check);
    if (memory.was.empty())
      return (divergence ? "The cloth had diverged" : moment + " was true") + " before this step began" + again;
    return past_in_words(check, memory) + at + ", when " +
           (divergence ? "the cloth diverged" : moment + " became true") + again;
  }
  if (has_sentences(check.name)) return words_of(check) + ": this did not hold" + at + "; restart";
  return past_in_words(check, memory) + at + ": " + cure_in_words(session, check);
}

/// ", that is 0.001 s": the value that a check compares with, where it is one of the step before; of what the student
/// is to find only what it was there.
std::string before_in_words(Session& session, const Condition& check) {
  if (!check.right.before || (check.to_find && check.right.name != check.name)) return {};
  Operand then = check.right;
  if (check.to_find) then.factor = 1;
  const auto value = value_of(session, then);
  if (!value) return {};
  const std::string number = with_unit(rounded(*value, 3), unit_of(check.name));
  return check.to_find ? ", " + number + " in the previous lab step" : ", that is " + number;
}

/// "now 50 N/m", "it is being measured": what is known at this moment of what a check looks at.
std::string now_in_words(Session& session, const Condition& check, CheckState state) {
  const Observable* row = find_observable(check.name);
  const std::string now = value_in_words(session, check.name);
  if (now.empty()) {
    const bool coming = row != nullptr && row->shown_by != nullptr && session.wants.*row->shown_by;
    if (coming && !session.pacing.playing) return "it is being measured";
    return row != nullptr && !row->hint.empty() ? std::string(row->hint) : "not known yet";
  }
  if (has_sentences(check.name)) return std::string(row->present[now == "yes" ? 1 : 0]);
  std::string text = "now " + now;
  // Before the motion begins nothing has been seen yet that could tell in which direction to go.
  if (check.to_find && check.span == Span::throughout && state == CheckState::open)
    text += is_upper(check.relation) ? ", too high" : is_lower(check.relation) ? ", too low" : "";
  const std::string place = place_of(check.name);
  return place.empty() ? text : text + " (" + place + ")";
}

/// "at 198 N/m, not at 150 N/m: come nearer": the values that a check has narrowed its constant down to so far.
std::string narrowed_in_words(const Condition& check, const CheckMemory& memory) {
  const auto at = [&](double value) { return "at " + with_unit(value, unit_of(check.name)); };
  if (!memory.with && !memory.without) return "neither found yet";
  if (!memory.with) return "not " + at(*memory.without) + "; find a value at which it does";
  if (!memory.without) return at(*memory.with) + "; find a value near it at which it does not";
  return at(*memory.with) + ", not " + at(*memory.without) + (narrowed(check, memory) ? "" : ": find closer values");
}

/// Whether a check of the step names the constant or one of its components, "W.x".
bool named(const LabStep& step, std::string_view key) {
  return std::any_of(step.checks.begin(), step.checks.end(), [&](const Condition& check) {
    return check.name == key ||
           (check.name.size() == key.size() + 2 && check.name.starts_with(key) && check.name[key.size()] == '.');
  });
}

}  // namespace

std::string changed_constant(const Preset& before, const Preset& now, const LabStep* names) {
  constexpr EffectSet ignored = motionless | Effect::engine | Effect::device;
  for (const PresetField& field : preset_fields()) {
    if (std::visit([&](auto member) { return before.*member == now.*member; }, field.member)) continue;
    if (effects_of(field, now).within(ignored) || (names != nullptr && named(*names, field.key))) continue;
    const std::string symbol(field.row != nullptr && !field.row->symbol.empty() ? field.row->symbol : field.key);
    const auto* number = std::get_if<double Preset::*>(&field.member);
    if (number == nullptr) return symbol + " was changed";
    return symbol + " was changed from " + short_number(before.**number) + " to " +
           with_unit(now.**number, field.row != nullptr ? field.row->unit : "");
  }
  return {};
}

std::optional<double> value_of(Session& session, const Operand& operand) {
  if (operand.name.empty()) return operand.factor;
  if (!operand.before) {
    const auto value = observe(session, operand.name);
    return value ? std::optional(operand.factor * *value) : std::nullopt;
  }
  assert(session.labs.run && session.labs.run->step < session.labs.run->records.size());
  const LabRun& run = *session.labs.run;
  if (run.step == 0) return std::nullopt;
  const auto& values = run.records[run.step - 1].outcome.values;
  const auto then = values.find(operand.name);
  return then != values.end() ? std::optional(operand.factor * then->second) : std::nullopt;
}

MotionChange follow_motion(const Session& session, MotionWatch& watch) {
  const std::int64_t steps = session.simulation->steps(), before = std::exchange(watch.steps, steps);
  // Where the cloth has diverged its copies make steps without it.
  const bool stands = steps == before && !session.copies.lockstep.empty();
  if (steps == 0 || (steps <= session.steps_made && !stands)) {
    watch.touches = session.counts.touches;
    return MotionChange::begun;
  }
  if (stands || steps == before + session.steps_made) return MotionChange::none;
  return steps < before + session.steps_made ? MotionChange::back : MotionChange::taken_up;
}

bool narrowed(const Condition& check, const CheckMemory& memory) {
  return memory.with && memory.without &&
         std::abs(*memory.with - *memory.without) <= check.right.factor * std::abs(*memory.with) * (1 + 1e-9);
}

CheckMemory begun_late(Session& session, const Condition& check) {
  if ((check.span != Span::when && check.span != Span::narrowed) ||
      judge_now(session, check.when[0]) != CheckState::holds)
    return {};
  return {true, false, session.simulation->time(), {}};
}

CheckState judge(Session& session, const Condition& check, MotionChange change, CheckMemory& memory) {
  if (check.span == Span::narrowed) {
    if (change == MotionChange::begun || change == MotionChange::back) memory.set = false, memory.watched.reset();
    return judge_narrowed(session, check, memory);
  }
  if (change == MotionChange::begun) memory = {};
  if (change == MotionChange::back && memory.t > session.simulation->time()) memory = {};
  if (change == MotionChange::taken_up && check.span == Span::throughout && !memory.set)
    remember(session, check, false, memory);
  const CheckState now = judge_now(session, check);
  switch (check.span) {
    case Span::now:
      return now;
    case Span::throughout: {
      const CheckState state = judge_throughout(session, check, now, memory);
      // What was touched when the first steps have been made was touched before them.
      if (change == MotionChange::begun && memory.set && check.name == "untouched") memory.t = 0;
      return state;
    }
    case Span::once:
      return judge_once(session, check, now, memory);
    case Span::lasting:
      return judge_lasting(session, check, now, memory);
    case Span::when:
      return judge_when(session, check, now, memory);
    case Span::narrowed:
      break;
  }
  return now;
}

std::string check_in_words(Session& session, const Condition& check, CheckState state, const CheckMemory& memory) {
  if (state == CheckState::broken) return broken_in_words(session, check, memory);
  if (check.span == Span::narrowed) return words_of(check) + " · " + narrowed_in_words(check, memory);
  const bool holds = state == CheckState::holds;
  if (holds && !check.to_find && check.span == Span::throughout) {
    Condition plain = check;
    plain.span = Span::now;
    return words_of(plain) + " so far";
  }
  const std::string asked = (check.to_find ? subject_of(check) : words_of(check)) + before_in_words(session, check);
  if (check.name == "untouched") {
    const std::string other = touched_by(session);
    return other.empty() ? asked : asked + " · " + other + ": set it back, then restart";
  }
  const bool says_all = is_word(check.name) || check.relation == Relation::equal;
  if (holds && !check.to_find && check.span == Span::now && says_all) return asked;
  if (check.to_find && has_sentences(check.name))
    return asked + (observe_word(session, check.name) == "yes" ? " Yes" : " Not yet");
  return asked + " · " + now_in_words(session, check, state);
}

bool found_together(const Condition& one, const Condition& other) {
  return one.to_find && other.to_find && subject_of(one) == subject_of(other);
}

std::string touched_by(const Session& session) {
  if (!session.labs.run) return {};
  const LabRun& run = *session.labs.run;
  if (std::string other = changed_constant(run.begun, session.requested_preset(), &run.now()); !other.empty())
    return other;
  if (session.simulation->held()) return "The cloth was held by hand";
  if (session.counts.touches != run.watch.touches) return "The cloth was pulled or cut by hand";
  return {};
}

}  // namespace tyglab
