// The visible copies that move with the cloth: side by side or overlaid, and measured against one of them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/session/recorded.h"
#include "app/studies/job.h"
#include "core/lockstep.h"

namespace tyglab {

struct Session;
struct CopyChange;

struct Copies {
  enum class Quantity { distance, energy };
  static constexpr int original = -1;  ///< as the index of a cloth

  Lockstep lockstep;
  Lockstep::Cost cost;                    ///< the original's
  bool overlaid = false;                  ///< drawn as lines over the original; otherwise side by side
  int reference = original;               ///< what distances are measured from
  Quantity plotted = Quantity::distance;  ///< by the card
  Series distance{1 + Lockstep::most};    ///< m, of the original and the copies
  Series energy{1 + Lockstep::most};      ///< J, of all the cloth
  double t = 0;                           ///< s, of all; the copies go on when the original has diverged

  /// A copy that is waiting for the programs of its OpenCL device, which are built in the background.
  struct Awaited {
    std::vector<Difference> differences;
    bool as_reference = false;
    Preset built_for;
  };
  std::optional<Awaited> awaited;
  Job<std::monostate> programs;

  bool side_by_side() const { return !overlaid && !lockstep.empty(); }
  /// The number of pictures in the viewport.
  int tiles() const { return side_by_side() ? 1 + int(lockstep.size()) : 1; }
  void forget() { distance.clear(), energy.clear(); }
};

/// The n-th cloth: the original (n = Copies::original) or a copy.
Simulation& cloth_of(const Session& session, int n);
/// The seat that determines its look if an earlier cloth has the same method; none: it has the look of its method.
std::optional<std::size_t> seat_of_style(const Session& session, int n);
/// Its differences from the original, "k_s = 80, rk4"; for the original, its values of the constants that copies
/// change.
std::string settings_of_cloth(const Session& session, int n);
/// Its name: those differences, or "accurate solution" if they are the settings of that choice.
std::string name_of_cloth(const Session& session, int n);

/// A choice for a new copy: a row of the card's menu, and of the palette.
struct CopyChoice {
  std::string label;
  std::vector<Difference> differences;
  std::string_view group = {};  ///< the heading over the rows of one group, which stand together; none over the first
  bool reference = false;       ///< it becomes the one from which distances are measured
};
/// All choices; short groups come first, so that all headings are visible before a list is scrolled.
std::vector<CopyChoice> copy_choices(const Preset& preset);

/// Adds a copy that differs in these constants, at once or when its programs are built; a message reports an obstacle.
void add_copy(Session& session, const std::vector<Difference>& differences, bool as_reference);
/// Called in every frame: adds the copy whose programs have been built, if one is awaited.
void poll_copies(Session& session);
void remove_copy(Session& session, std::size_t n);
/// Undoes what an action has done with a copy: takes away what it added, puts back what it removed. Returns what would
/// undo that in turn, and adds to `said` what is not as before. Throws PresetError and EngineError.
CopyChange undo_copy_change(Session& session, const CopyChange& change, std::string& said);
/// Removes all of them; returns whether there were any.
bool put_away_copies(Session& session);
/// Applies the edits and events of the original to the copies.
void copies_apply(Session& session, const Edit& edit);
void copies_resume(Session& session);
/// The original has come to time `t`, s, in `computing_s` seconds of computing.
void copies_note(Session& session, double t, double computing_s);
/// The same; the copies then make the steps that the original has made.
void copies_follow(Session& session, double computing_s);
/// After a divergence of the original, the copies continue for that many of its steps. Returns the number of steps.
int copies_go_on(Session& session, int steps);
void sample_copies(Session& session);

}  // namespace tyglab
