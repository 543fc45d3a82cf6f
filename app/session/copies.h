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

  /// A copy that comes when the programs of its OpenCL device have been built, beside the frames.
  struct Awaited {
    std::vector<Difference> differences;
    bool as_reference = false;
    Preset built_for;
  };
  std::optional<Awaited> awaited;
  Job<std::monostate> programs;

  bool side_by_side() const { return !overlaid && !lockstep.empty(); }
  /// How many pictures the viewport shows.
  int tiles() const { return side_by_side() ? 1 + int(lockstep.size()) : 1; }
  void forget() { distance.clear(), energy.clear(); }
};

/// The n-th cloth: the original (n = Copies::original) or a copy.
Simulation& cloth_of(const Session& session, int n);
/// The seat that decides how it is drawn where a cloth before it has the same method; none: it is drawn as its method.
std::optional<std::size_t> seat_of_style(const Session& session, int n);
/// What tells it from the original, "k_s = 80, rk4"; or of the original what the copies change.
std::string settings_of_cloth(const Session& session, int n);
/// How it is called: by those settings, but "accurate solution" where they are those of that choice.
std::string name_of_cloth(const Session& session, int n);

/// What a copy may be made with: a row of the card's menu, and of the palette.
struct CopyChoice {
  std::string label;
  std::vector<Difference> differences;
  std::string_view group = {};  ///< the heading over the rows of one group, which stand together; none over the first
  bool reference = false;       ///< it becomes the one from which distances are measured
};
/// The short groups come first, so that all headings are seen before a list is scrolled.
std::vector<CopyChoice> copy_choices(const Preset& preset);

/// Adds a copy that differs in these constants, at once or when its programs are there, or says why not.
void add_copy(Session& session, const std::vector<Difference>& differences, bool as_reference);
/// Called in every frame: adds the copy whose programs have been built, if one is awaited.
void poll_copies(Session& session);
void remove_copy(Session& session, std::size_t n);
/// Removes all of them; returns whether there were any.
bool put_away_copies(Session& session);
/// What the original has been given or become, the copies are given or become.
void copies_apply(Session& session, const Edit& edit);
void copies_resume(Session& session);
/// The original has come to time `t`, s, in `computing_s` seconds of computing.
void copies_note(Session& session, double t, double computing_s);
/// The same, and the copies make the steps that the original has made.
void copies_follow(Session& session, double computing_s);
/// The original has diverged: the copies go on by themselves, for that many of its steps. Returns them.
int copies_go_on(Session& session, int steps);
void sample_copies(Session& session);

}  // namespace tyglab
