// The CPU engine: runs every explicit scheme in place over rows, in SIMD.
//
// A step is, for each sweep of the method, one pass of every band (band.h) over its rows from top to bottom, two rows
// at a time. For rows i and i + 1, block of columns after block:
//
// 1. Forces that the pair owns (pair_sweep-inl.h): springs to the right, below and diagonally below, bending springs
//    two to the right and two below, the wind on the triangles down to row i + 2. What the upper row takes from the
//    lower stays in registers; what both take from rows i + 2 and i + 3 waits in a ring of four rows, to be subtracted
//    there.
// 2. Everything above and to the left is done, so the force on the block is complete and the block is updated in place.
// 3. Pinned and held particles get no force; the force on the hand is measured here.
// 4. Bodies: if a quick test says that the row may touch one, the exact correction runs, in double, particle by
//    particle.
// 5. The largest displacement is kept, and whether something was not finite (fault.h).
//
// So each spring is computed once, a sweep reads and writes the state once, and accelerations never travel through
// memory. Once all bands are done, one thread ends the step (cpu_step.cpp): springs above F_max break, the hand lets
// go.
//
// Where the state does not stay in a core's own cache, and wherever several threads work, steps follow each other in
// waves (step_in_waves): a sweep runs two rows behind the sweep before it, up to eight sweeps a thread, so that rows
// are worked on eight times while they lie in the cache. Threads wait for rows, not for barriers. A wave begins only if
// the divergence budget lasts for it with a margin; if a step in it was faster than that, the engine returns to its
// backup and makes the steps one by one. Bits are the same either way (tests/unit/waves_test.cpp).
#pragma once

#include <limits>
#include <memory>
#include <span>

#include "core/engines/cpu/band.h"
#include "core/engines/cpu/implicit.h"
#include "core/engines/cpu/projection.h"
#include "core/engines/cpu/team.h"
#include "core/engines/engine.h"
#include "core/engines/fault.h"
#include "core/integrators/scheme.h"

namespace tyglab::cpu {

/// `Present`: the parts that are compiled in (parts.h).
template <class R, unsigned Present = part::everything>
class CpuEngine final : public Engine {
 public:
  CpuEngine(const Preset& preset, const Lattice& lattice, int threads);

  using Engine::load;
  void load(const StateRows& rows, const Tears& tears) override;
  void set_preset(const Preset& preset, const Tears& tears) override;
  void set_fixed(std::span<const int> pinned, Held held) override;
  Advance advance(int steps, Tears& tears) override;
  void note_contacts(bool on) override { cloth_.notes_contacts = on; }
  std::vector<Contact> contacts() const override;
  void read(State& state, const Tears& tears) override;
  void read_raw(State& state, const Tears& tears) override;
  PositionView positions() const override;
  StoredParticle stored(int i, int j) const override;
  std::size_t bytes() const override;
  int threads() const override { return team_->size(); }
  SolveCounts solves() const override { return solver_.counts(); }
  InnerSteps inner_steps() const override { return control_.counts(); }
  std::vector<StepFeature> features() const override;
  std::string name() const override;

 private:
  using Field = RowField<R>;
  enum class End { none, fault, released, rolled_back };

  static constexpr bool has(unsigned which) { return (Present & which) != 0; }
  /// More rows than the cloth has: the sweep loads neighbours before it masks those that are not there.
  int array_rows() const { return cloth_.lattice.rows + 3; }
  /// The first row of a thread's band; of the number after the last, where the cloth ends.
  int band_begin(int number) const;
  void resolve();
  void resolve_estimate();
  void make_waves();
  bool keeps_old_rows() const;
  ResolvedSweep resolve(const Sweep& sweep) const;
  ResolvedSweep::ResolvedAssignment resolve(const Assignment& assignment) const;
  /// F/m at two of the vectors. `of_step`: as Band has it.
  void accelerations(int position, int velocity, const Tears& tears, Field& out, bool of_step = false);
  /// The implicit stage of a sweep, on this thread alone.
  void solve(const ResolvedSweep& sweep, const Tears& tears);
  /// Works the coefficients out for steps of that length.
  void set_dt(double dt);
  /// The same for an inner step, which comes often: in place.
  void change_dt(double dt);
  void scale(const Assignment& assignment, ResolvedSweep::ResolvedAssignment& out) const;
  void scale_estimate();
  /// Covers dt with inner steps, all threads together; end_ says how it ended.
  void step_adaptively(int number, Tears& tears, Fault& fault);
  void take_next_dt();
  void begin_interval(const Tears& tears);
  void begin_control(const Tears& tears);
  void try_inner_step(int number, const Tears& tears);
  void judge_inner_step();
  void finish_inner_step(Tears& tears, Fault& fault);
  /// Positions and vector 1 as a velocity.
  void read_stored(State& state) const;

  double tear_overloaded(Tears& tears);
  double tear_row(Tears& tears, int direction, int i);
  bool guarded(int i, int j) const {
    return !guards_.empty() && guards_[std::size_t(i) * cloth_.lattice.columns + j] != 0;
  }
  /// Looks at every particle and spring; if all is well, says how much motion may pass before the next look.
  bool find_fault(const Tears& tears, Fault& fault);
  StateView<R> view() const;
  /// The steps before say nothing any more of how long the next may be.
  void restart_control() { control_.restart(), knows_first_a_ = false; }
  /// Forgets how far particles may still move, and the backup: something else than their motion has changed.
  void invalidate_budgets() {
    divergence_budget_ = tear_budget_ = 0;
    since_backup_ = -1;
    growth_ = std::numeric_limits<double>::infinity();
  }
  End finish_step(std::span<const std::unique_ptr<Band<R, Present>>> bands, Tears& tears, Fault& fault);
  /// Steps until done, the hand lets go, a fault is found, or a step of a wave had to be looked at (end_ says which);
  /// returns the steps without fault. `waves`: several steps at a time where that pays.
  int run(int steps, Tears& tears, Fault& fault, bool waves);
  void step_in_bands(int number, const Tears& tears);
  /// What a sweep that projects does, with its assignments.
  void project(int number, const ResolvedSweep& sweep, const Tears& tears, bool last);
  void read_hand(const Tears& tears);
  /// How many of the `left` steps can follow each other through the rows before one must be looked at: 1 or more.
  int steps_in_wave(int left) const;
  /// That many steps in one pass over the rows: each sweep two rows behind the one before it, so that rows are worked
  /// on while they lie in the cache. Threads share the sweeps out and follow each other, without a barrier.
  void step_in_waves(int number, int steps, const Tears& tears);
  void keep_backup(const Tears& tears);
  void repeat(int steps, Tears& tears);
  bool tears_watched() const {
    return has(part::tearing) && cloth_.preset.F_max > 0 && cloth_.preset.k_s > 0 && cloth_.preset.kind == Kind::cloth;
  }
  int finish_wave(int steps, Tears& tears, Fault& fault);

  Cloth<R> cloth_;
  const Scheme* scheme_ = nullptr;
  std::vector<ResolvedSweep> sweeps_;
  StepControl control_, control_backup_;
  ResolvedEstimate estimate_;
  std::vector<ResolvedSweep::ResolvedAssignment> next_stage_;  ///< of an inner step whose first a is known
  std::vector<ResolvedSweep::ResolvedAssignment> accepting_;   ///< of its last sweep, made once it is accepted
  double left_of_dt_ = 0;                                      ///< s that inner steps have still to cover
  bool knows_first_a_ = false, accepted_ = false;
  std::vector<Field> backup_;
  Tears tears_backup_;
  int since_backup_ = -1;             ///< steps; under 0: there is none
  int torn_ = 0;                      ///< springs, when a step was last made: cuts come from outside
  Field acceleration_;                ///< used between steps alone (readouts, starts)
  std::vector<std::uint8_t> guards_;  ///< particles whose springs tearing leaves alone
  std::vector<int> pinned_;
  std::vector<Contact> inner_contacts_;  ///< of all inner steps of the last dt
  ImplicitSolver<R> solver_;
  Projector<R> projector_;
  int projected_torn_ = 0;
  bool springs_changed_ = true;  ///< or what is fixed, since the projector looked
  std::unique_ptr<Team> team_;
  std::vector<std::unique_ptr<Band<R, Present>>> bands_;
  std::vector<std::unique_ptr<Band<R, Present>>> waves_;  ///< all rows each, a sweep each
  std::vector<Progress> progress_;                        ///< of each thread's last sweep of a wave
  double growth_ = 0;                                     ///< of a spring in the last step, at most, m; ∞: not known
  int left_inside_ = 0;
  End end_ = End::none;
  glm::dvec3 hand_force_{0};
  double tear_budget_ = 0;        ///< m that particles may still move before a spring can be overloaded
  double divergence_budget_ = 0;  ///< m that particles may still move before springs must be measured again
};

std::unique_ptr<Engine> make_cpu_engine(const Preset& preset, const Lattice& lattice, int threads);

}  // namespace tyglab::cpu
