// Copies of a simulation that differ from it in some constants and move in lockstep with it: with its start, hand,
// cuts, pins and bodies, and each with its own method, dt, engine or any other constant.
//
// Every edit of the original also goes to its copies; after a change of constants their differences are applied again.
// After each batch of steps the copies make the whole steps of their own dt that end before the original's time. A copy
// is an ordinary Simulation, so a copy with equal settings stays equal to the last bit.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/model/difference.h"
#include "core/simulation.h"

namespace tyglab {

class Lockstep {
 public:
  static constexpr std::size_t most = 5;       ///< copies beside the original
  static constexpr int largest = 256 * 256;    ///< particles of a cloth that is copied
  static constexpr double cost_settles = 0.5;  ///< s of simulated time over which a cost is smoothed

  /// Seconds of computing (computing_seconds) that a simulated second takes, smoothed.
  class Cost {
   public:
    void add(double simulated_s, double computing_s);
    double per_second() const { return simulated_ > 0 ? computing_ / simulated_ : 0; }  ///< 0 until it is known

   private:
    double simulated_ = 0, computing_ = 0;  ///< of the last steps, the older the less they count
  };

  struct Copy {
    std::vector<Difference> differences;  ///< from the original, applied in order
    std::unique_ptr<Simulation> simulation;
    Cost cost;
    std::size_t seat = 0;  ///< below `most`, its own as long as it lives, whichever others go
  };

  /// Adds a copy that goes on from where the original is. Every cloth is loaded again from its own state, so that equal
  /// ones go on with equal bits; the hand lets go. Throws PresetError (a value is wrong, too many, too large, another
  /// lattice), EngineError.
  void add(Simulation& original, std::vector<Difference> differences, int threads = 1);
  void remove(std::size_t n) { copies_.erase(copies_.begin() + std::ptrdiff_t(n)); }
  void clear() { copies_.clear(); }
  bool empty() const { return copies_.empty(); }
  std::size_t size() const { return copies_.size(); }
  Copy& operator[](std::size_t n) { return copies_[n]; }
  const Copy& operator[](std::size_t n) const { return copies_[n]; }

  /// What the original has just been given is given to every copy, each with its own differences. Returns a sentence
  /// for every copy that could not follow and is therefore gone.
  std::vector<std::string> apply(const Simulation& original, const Edit& edit);
  /// The original is another one, or went back in time: every copy goes on from where it is. As apply().
  std::vector<std::string> resume(Simulation& original, int threads = 1);
  /// Every copy makes the whole steps that end by `t`, s; one that has diverged stands still.
  void follow(double t);
  /// What the copies show now, to be looked at while another thread moves them (Simulation::stand_in).
  Lockstep stand_in() const;
  /// From now on follow() ends as soon as this says so, each copy with its last whole step; a later call goes on there.
  void stop_when(const Stop& stop);
  /// Whether a copy could still move.
  bool alive() const;
  std::size_t bytes() const;

 private:
  std::size_t free_seat() const;
  std::vector<Copy> copies_;
};

/// Root of the mean squared distance between the particles of two cloths of one lattice, m. Where their times differ,
/// by less than a dt, the first is carried to the second's time with its velocities: exact to ½ a Δt². Not a number
/// where a cloth has diverged or lattices differ.
double rms_distance(Simulation& cloth, Simulation& from);
/// The same of two states of one lattice, the first carried on by `ahead` seconds.
double rms_distance(const State& cloth, const State& from, double ahead = 0);

/// The constants of a copy: the original's with the differences. Throws PresetError.
Preset copied_preset(const Preset& original, std::span<const Difference> differences);

}  // namespace tyglab
