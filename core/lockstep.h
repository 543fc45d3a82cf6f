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

  /// Computing time (computing_seconds) per simulated second, smoothed.
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

  /// Adds a copy that continues from the original's state. Every cloth is loaded again from its own state, so equal
  /// cloths continue with equal bits; the hand releases. Throws PresetError (a wrong value, too many copies, a cloth
  /// that is too large, another lattice) and EngineError.
  void add(Simulation& original, std::vector<Difference> differences, int threads = 1);
  /// Puts a copy back in its former place, seat and motion; `then` must fit. Throws as add() does.
  void put_back(const Simulation& original, std::size_t n, std::vector<Difference> differences, std::size_t seat,
                Cost cost, const Snapshot& then, int threads = 1);
  void remove(std::size_t n) { copies_.erase(copies_.begin() + std::ptrdiff_t(n)); }
  void clear() { copies_.clear(); }
  bool empty() const { return copies_.empty(); }
  std::size_t size() const { return copies_.size(); }
  Copy& operator[](std::size_t n) { return copies_[n]; }
  const Copy& operator[](std::size_t n) const { return copies_[n]; }

  /// Applies an edit of the original to every copy, with the differences of each. Returns a sentence for every copy
  /// that could not follow and was therefore removed.
  std::vector<std::string> apply(const Simulation& original, const Edit& edit);
  /// Restarts every copy from the state of the original, which was replaced or went back in time. As apply().
  std::vector<std::string> resume(Simulation& original, int threads = 1);
  /// Every copy makes the whole steps that end by `t`, s; a diverged copy stands still.
  void follow(double t);
  /// The present moment of the copies, for reading while another thread moves them (Simulation::stand_in).
  Lockstep stand_in() const;
  /// From now on follow() ends as soon as `stop` returns true, after complete steps; a later call continues there.
  void stop_when(const Stop& stop);
  /// Whether a copy could still move.
  bool alive() const;
  std::size_t bytes() const;

 private:
  void check_room(const Simulation& original) const;
  std::size_t free_seat() const;
  std::vector<Copy> copies_;
};

/// Root of the mean squared distance between the particles of two cloths of one lattice, m. If their times differ, by
/// less than a dt, the first is extrapolated to the second's time with its velocities: exact to ½ a Δt². Not a number
/// if a cloth has diverged or the lattices differ.
double rms_distance(Simulation& cloth, Simulation& from);
/// This distance between two states of one lattice, the first extrapolated by `ahead` seconds.
/// `particles`: the first of them alone.
double rms_distance(const State& cloth, const State& from, std::size_t particles, double ahead = 0);

/// The constants of a copy: the original's with the differences. Throws PresetError.
Preset copied_preset(const Preset& original, std::span<const Difference> differences);

}  // namespace tyglab
