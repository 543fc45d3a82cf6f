// Evaluates a lab's checks, each over its part of the motion, and describes them on the card.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/session/lab.h"

namespace tyglab {

struct Preset;
struct Session;

enum class CheckState {
  unknown,  ///< a quantity is not known yet
  open,     ///< it does not hold, or not yet
  holds,
  broken  ///< it can no longer hold in the present motion: only a restart helps
};

/// The memory of a check since the beginning of the motion.
struct CheckMemory {
  bool set = false;      ///< it broke, came true or was decided …
  bool holds = false;    ///< … and this is what came of it,
  double t = 0;          ///< s, at this moment,
  std::string was = {};  ///< at which its quantity was this, in words
  /// Of Span::narrowed, kept in all motions of the step: the constant's value when the moment came last, and the last
  /// one at which it did not; and the one that is watched since t.
  std::optional<double> with = {}, without = {}, watched = {};
};

/// The observed state of the motion, which reveals its beginning.
struct MotionWatch {
  std::int64_t steps = 0;     ///< when it was looked at last
  std::uint64_t touches = 0;  ///< SessionCounts::touches when it began
};

/// The change of the motion since the last look.
enum class MotionChange {
  none,
  begun,     ///< it has begun again: nothing is remembered
  back,      ///< to an earlier moment: what came after it has not happened
  taken_up,  ///< at a later moment: what lies between was not seen
};
MotionChange follow_motion(const Session& session, MotionWatch& watch);

/// The number on the right of a condition; none while it is not known.
std::optional<double> value_of(Session& session, const Operand& operand);

/// What a check remembers of a motion that is already under way when the step begins: a moment that the check is about
/// (`when`) and that has passed was not seen, so the check is broken.
CheckMemory begun_late(Session& session, const Condition& check);

/// Evaluates a check at the present moment, with its memory. To be called in every update.
CheckState judge(Session& session, const Condition& check, MotionChange change, CheckMemory& memory);

/// The check as the card says it: what is asked, which number is looked at now and where it is seen, and of a broken
/// one why it is broken and what to do.
std::string check_in_words(Session& session, const Condition& check, CheckState state, const CheckMemory& memory);

/// Whether the check has narrowed its constant down between two values that are close enough.
bool narrowed(const Condition& check, const CheckMemory& memory);

/// Whether both are bounds of one quantity that is to be found out, which the card lists as one.
bool found_together(const Condition& one, const Condition& other);

/// The first constant of the motion that differs, "k_d was changed from 0 to 0.02 N s/m", but for those that the checks
/// of a step name; empty: none.
std::string changed_constant(const Preset& before, const Preset& now, const LabStep* names = nullptr);

/// What was changed beside what the step's checks name, or touched by hand; empty: nothing.
std::string touched_by(const Session& session);

}  // namespace tyglab
