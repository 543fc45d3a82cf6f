// The CPU engine runs every explicit scheme in place over rows, in SIMD.
//
// In a step, every band (band.h) makes one pass over its rows for each sweep of the method, from top to bottom, two
// rows at a time. For rows i and i + 1, and for each block of columns:
//
// 1. The forces that the pair owns are computed (pair_sweep-inl.h): springs to the right, below and diagonally below,
//    bending springs two to the right and two below, and the wind on the triangles down to row i + 2. Forces of the
//    lower row on the upper stay in registers; those of rows i + 2 and i + 3 wait in a ring of four rows, to be
//    subtracted there.
// 2. Everything above and to the left is done, so the force on the block is complete and the block is updated in place.
// 3. Pinned and held particles receive no force; the force on the hand is measured here.
// 4. Bodies: if a quick test says that the row may touch one, the exact correction runs in double, particle by
//    particle.
// 5. The largest displacement is kept, and whether a value was not finite (fault.h).
//
// So each spring is computed once, a sweep reads and writes the state once, and accelerations are never stored in
// memory. Once all bands are done, one thread ends the step (cpu_step.cpp): springs above F_max break, and the hand
// releases.
//
// If the state exceeds the cache of a core, and whenever several threads work, steps follow each other in waves
// (step_in_waves): a sweep runs two rows behind the sweep before it, up to eight sweeps per thread, so rows are used
// eight times while they are in the cache. Threads wait for rows, not for barriers. A wave starts only if the
// divergence budget suffices for it with a margin; if a step in it was faster than that, the engine returns to its
// backup and makes the steps one by one. The bits are identical either way (tests/unit/waves_test.cpp).
#pragma once

#include <cassert>
#include <functional>
#include <limits>
#include <memory>
#include <span>

#include "core/contact/self_contact.h"
#include "core/engines/cpu/band.h"
#include "core/engines/cpu/block_descent.h"
#include "core/engines/cpu/constant_solve.h"
#include "core/engines/cpu/implicit.h"
#include "core/engines/cpu/projection.h"
#include "core/engines/cpu/team.h"
#include "core/engines/cpu/team_crew.h"
#include "core/engines/cpu/thread_governor.h"
#include "core/engines/engine.h"
#include "core/engines/step_guard.h"
#include "core/forces/parted.h"
#include "core/integrators/scheme.h"
#include "core/integrators/stabilized.h"

namespace tyglab::cpu {

/// What steps go on from: of every engine of that precision, whichever parts are compiled in.
template <class R>
struct CpuMotion final : HeldMotion {
  std::string_view method;  ///< Scheme::name
  bool synchronized = true;
  std::vector<RowField<R>> vectors;
  StepControl control;
  StepGuard::Given given;
  std::size_t bytes() const override {
    std::size_t total = 0;
    for (const auto& field : vectors) total += field.bytes();
    return total;
  }
};

/// `Present`: the parts that are compiled in (parts.h).
template <class R, unsigned Present = part::everything>
class CpuEngine final : public Engine, private GuardedSteps {
 public:
  CpuEngine(const Preset& preset, const Lattice& lattice, int threads);

  using Engine::load;
  void load(const StateRows& rows, const Tears& tears) override;
  void synchronize(const Tears& tears) override;
  void set_preset(const Preset& preset, const Tears& tears) override;
  void set_fixed(std::span<const int> pinned, Held held) override;
  void drive_pins(std::span<const DrivenPin> pins, bool place) override;
  void prepare(std::size_t fixed) override;
  AdvanceResult advance(int steps, Tears& tears) override;
  void note_contacts(bool on) override { cloth_.notes_contacts = on; }
  std::vector<Contact> contacts() const override;
  void read(State& state, const Tears& tears) override;
  void read_raw(State& state, const Tears& tears) override;
  std::shared_ptr<const HeldMotion> held_motion() const override;
  void go_on_from(const HeldMotion& then) override;
  PositionView positions() const override;
  StoredParticle stored(int i, int j) const override;
  std::size_t bytes() const override;
  int threads() const override { return team_->capacity(); }
  int threads_at_work() const override { return team_->size(); }
  /// For tests: from now on every few steps are made by as many threads as this says, 1 … threads().
  void force_threads(std::function<int()> next) { forced_threads_ = std::move(next); }
  SolveCounts solves() const override;
  double given_squared() const override { return guard_.given_squared(); }
  std::int64_t held_back() const override { return self_ != nullptr ? self_->held_back : 0; }
  InnerSteps inner_steps() const override { return control_.counts(); }
  void continue_counts(const InnerSteps& counts) override { control_.continue_counts(counts); }
  std::vector<StepFeature> features() const override;
  std::string name() const override;

 private:
  using Field = RowField<R>;

  static constexpr bool has(unsigned which) { return (Present & which) != 0; }
  /// More rows than the cloth has, since the sweep loads neighbors before it masks those that do not exist.
  int array_rows() const { return cloth_.lattice.rows + 3; }
  /// The first row of a thread's band; for the number after the last, the number of rows.
  int band_begin(int number) const;
  /// What follows from the preset alone.
  struct Resolved {
    double dt = 0;
    std::vector<ResolvedSweep> sweeps;
    ResolvedSweep start;  ///< the method's own start; without assignments where it has none
    ResolvedEstimate estimate;
    std::vector<ResolvedSweep::ResolvedAssignment> next_stage, accepting;
    std::vector<std::vector<ResolvedSweep>> tables;
    std::size_t table = 0;
    Spectrum spectrum;
  };
  void swap(Resolved& other);
  void resolve();
  /// Takes other constants, but where memory fails.
  void exchange(const Preset& preset);
  void resolve_estimate();
  /// Each number of stages of a stabilized method that steps may take.
  void resolve_tables();
  /// The sweeps that are made now, as their method has them.
  const std::vector<Sweep>& table() const {
    return is_stabilized(*scheme_) ? scheme_->tables[table_].sweeps : scheme_->sweeps;
  }
  void write_fixed_velocities();
  void set_synchronized(bool yes);
  /// The method's own start from a synchronized state.
  void start(const Tears& tears);
  /// The a (or, of a method that solves for the damping, the slope) that read() and synchronize() add to velocities
  /// that lag behind; into acceleration_.
  void find_lagging_a(const Tears& tears);
  void add_lag(double lag, double scale);
  /// How far velocities lag behind positions, s.
  double lag() const { return synchronized_ ? 0 : scheme_->lag * cloth_.preset.dt; }
  void make_waves();
  /// Whether a step may take so long that it asks to be stopped within, which costs a backup before it.
  bool stops_within_steps() const;
  /// How many steps that many threads can make in a wave; 0 where waves do not pay.
  int steps_of_wave(int threads) const;
  void resize_team(int size);
  /// Those that work.
  std::span<const std::unique_ptr<Band<R, Present>>> bands() const {
    return std::span(bands_).first(std::size_t(team_->size()));
  }
  bool keeps_old_rows() const;
  ResolvedSweep resolve(const Sweep& sweep) const;
  ResolvedSweep::ResolvedAssignment resolve(const Assignment& assignment) const;
  /// Takes what forces that are linear in positions make of the springs (linear_springs.h); on one thread, wherever
  /// tears or the preset may have changed.
  void follow_springs(const Tears& tears) {
    cloth_.springs.follow(cloth_.preset, tears, cloth_.stride), follow_loose(tears);
  }
  /// F/m at two of the vectors, between steps.
  void accelerations(int position, int velocity, const Tears& tears, Field& out);
  /// F/m of a sweep, also within a step. `of_step`: as Band has it.
  void accelerations_of(const ResolvedSweep& look, const Tears& tears, Field& out, bool of_step);
  /// The implicit stage of a sweep. Returns false, to all threads, where it was stopped.
  bool solve_stage(int number, const ResolvedSweep& sweep, const Tears& tears);
  void begin_lagged(const ResolvedSweep& sweep, const Tears& tears);
  void stage_accelerations(const ResolvedSweep& sweep, const Tears& tears, Field& out, bool of_step);
  /// The same on this thread alone.
  bool solve(const ResolvedSweep& sweep, const Tears& tears);
  /// The same from c_x and c_v on by passes of all threads.
  int most_passes() const;
  bool descend(int number, const ResolvedSweep& sweep, const Tears& tears);
  bool begin_pass(int number, int pass, const ResolvedSweep& sweep, const Tears& tears);
  /// Whether springs or what is fixed have changed since the last accept_springs().
  bool springs_changed(const Tears& tears) const { return springs_changed_ || known_torn_ != tears.torn_count(); }
  /// What follows from them has been made: only then, since memory may fail while it is.
  void accept_springs(const Tears& tears) { springs_changed_ = false, known_torn_ = tears.torn_count(); }
  /// Computes the coefficients for steps of that length.
  void set_dt(double dt);
  std::vector<std::vector<PlacedBody>> bodies_in(int steps) const;
  void place_next_bodies();
  /// The same in place, for inner steps, where it happens often.
  void change_dt(double dt);
  void scale(const Assignment& assignment, ResolvedSweep::ResolvedAssignment& out) const;
  void scale_estimate();
  /// Covers dt with inner steps, all threads together, and checks each.
  void step_adaptively(int number, Tears& tears, Fault& fault);
  void take_next_dt();
  void begin_interval(const Tears& tears);
  void begin_control(const Tears& tears);
  void try_inner_step(int number, const Tears& tears);
  void judge_inner_step();
  void add_inner_contacts();
  void finish_inner_step(Tears& tears, Fault& fault);
  /// Positions and vector 1 as a velocity.
  void read_stored(State& state) const;

  // What the guard asks for.
  BatchResult make_steps(int most, Tears& tears, Fault& fault) override;
  StepMeasures measures(int step) override;
  double tear_overloaded(Tears& tears) override;
  bool find_fault(Tears& tears, Fault& fault, double& divergence_budget) override;
  bool find_runaway(const MotionLimit& limit, Fault& fault) override;
  Motion motion(const Tears& tears) override;
  void keep_backup() override;
  void repeat(int steps, Tears& tears) override;

  double tear_row(Tears& tears, int direction, int i);
  bool guarded(int i, int j) const {
    assert(cloth_.lattice.contains(i, j));
    return !guards_.empty() && guards_[std::size_t(i) * cloth_.lattice.columns + j] != 0;
  }
  StateView<R> view() const;
  /// The steps before no longer say anything about how long the next may be.
  void restart_control() { control_.restart(), knows_first_a_ = false; }
  /// Makes and checks steps until one asks to stop. `waves`: several steps at a time where that pays off.
  BatchResult run(int steps, Tears& tears, Fault& fault, bool waves);
  int steps_of_run(int left) const;
  /// The same with as many threads as the team has now.
  BatchResult run_together(int steps, Tears& tears, Fault& fault, bool waves);
  void step_in_bands(int number, const Tears& tears);
  /// A sweep that projects, with its assignments. Returns false, to all threads, where it was stopped.
  bool project(int number, const ResolvedSweep& sweep, const Tears& tears, bool last);
  void read_hand(const Tears& tears);
  /// For a method that solves for the damping: the matrix, where springs or what is fixed have changed.
  void prepare_damping(const Tears& tears);
  Balance damping_balance() const;
  // Where the cloth has parted (cpu_loose.cpp).
  void follow_loose(const Tears& tears);
  void find_given_force(const ResolvedSweep& sweep);
  void find_loose_force(const ResolvedSweep& sweep);
  void add_loose_springs();
  const implicit::Beside* begin_beside();
  void add_loose_couplings(double h, std::vector<implicit::Coupling>& out) const;
  double loose_slack(const Tears& tears) const;
  double share_held() const;
  // Contact of the cloth with itself, on one thread (cpu_self.cpp).
  void begin_self(const Tears& tears);
  void find_near_force(const ResolvedSweep& sweep);
  bool end_self();
  bool begin_self_solve();
  void add_self_couplings(double h, std::vector<implicit::Coupling>& out) const;
  void fetch(const Field& field, double scale, std::vector<glm::dvec3>& out) const;
  /// Something other than steps has moved particles.
  void lose_self() {
    if (self_ != nullptr) self_->way = std::numeric_limits<double>::infinity();
  }
  /// It may also have torn or mended as many springs as were torn before.
  void forget_self() {
    if (self_ != nullptr) self_->contact.forget();
  }
  /// How many of the `left` steps can follow each other through the rows before one must be examined: 1 or more.
  int steps_in_wave(int left) const;
  /// Makes that many steps in one pass over the rows: each sweep is two rows behind the one before it, so that rows are
  /// still in the cache. Threads divide the sweeps among them and follow each other, without a barrier.
  void step_in_waves(int number, int steps, const Tears& tears);

  Cloth<R> cloth_;
  const Scheme* scheme_ = nullptr;
  std::vector<ResolvedSweep> sweeps_;
  ResolvedSweep start_;  ///< the method's own start; without assignments where it has none
  StepControl control_, control_backup_;
  ResolvedEstimate estimate_;
  std::vector<ResolvedSweep::ResolvedAssignment> next_stage_;  ///< of an inner step, whose first a is known
  std::vector<ResolvedSweep::ResolvedAssignment> accepting_;   ///< of its last sweep, made once the step is accepted
  double left_of_dt_ = 0;                                      ///< that inner steps have yet to cover, s
  bool knows_first_a_ = false, accepted_ = false;
  bool synchronized_ = true;  ///< vectors 0 and 1 hold positions and velocities of one time, others nothing
  bool synchronized_backup_ = true;
  StepNumber step_backup_;
  std::vector<std::vector<ResolvedSweep>> tables_;  ///< sweeps by the number of stages; those in use are in sweeps_
  std::size_t table_ = 0;                           ///< that is in use
  Spectrum spectrum_;
  std::vector<Field> backup_;
  Field acceleration_;                ///< used only between steps (readouts, starts)
  Field lagged_;                      ///< accelerations by forces of the beginning of an implicit stage,
  bool has_lagged_ = false;           ///< where it has any
  std::vector<std::uint8_t> guards_;  ///< nonzero at particles whose springs do not tear
  std::vector<int> pinned_;
  std::vector<int> all_fixed_;  ///< the same and the held one, in rising order
  std::vector<DrivenPin> driven_;
  Array<double> rows_;  ///< of load(): six for each thread; else empty
  std::vector<Contact>
      inner_contacts_;                 ///< sums over all inner steps of the last dt, of each particle that was stopped
  std::vector<int> inner_contact_of_;  ///< where a particle's sum is; -1: it has none
  ImplicitSolver<R> solver_;
  Projector<R> projector_;
  ConstantSolver<R> constant_;
  BlockDescent<R> descent_;
  /// Contact of the cloth with itself; null: the scene has none.
  struct Self {
    explicit Self(const Lattice& lattice) : contact(lattice) {}
    SelfContact contact;
    int particles = 0;
    double way = std::numeric_limits<double>::infinity();  ///< of particles since its list was looked at, m
    std::vector<glm::dvec3> x, v, F;                       ///< v: also positions at the beginning of the step, after it
    bool looked = false;                                   ///< at the positions of the state
    bool solving = false;                                  ///< within an implicit solve
    Field rows_before;                                     ///< positions at the beginning of the step
    Field force;
    std::int64_t held_back = 0, held_back_then = 0;  ///< by the guard; and as of the backup
  };
  std::unique_ptr<Self> self_;
  /// Loose stencils of a cloth that has parted, and the particles that they act on, by whose place here they name them.
  struct Loose {
    /// F_s or F_b, and F_d, of a spring, with all halves that join its particles.
    struct Spring {
      int a, b;
      int direction;                    ///< of the lattice
      double sign;                      ///< 1 pulls, -1 pushes
      double rest = 0, k = 0, k_d = 0;  ///< m, N/m, N s/m
    };
    std::vector<Spring> springs;
    std::vector<LooseStencil> others;
    std::vector<int> particles;
    std::vector<std::ptrdiff_t> places;  ///< in the rows of a field
    std::vector<double> per_share;
    std::vector<glm::dvec3> x, v, F;
    Field force;
    std::vector<std::uint8_t> rows;  ///< not 0: a row of it that has something
    int known_torn = 0;              ///< -1: the constants have changed
  };
  Loose loose_;
  implicit::Beside beside_;            ///< what implicit stages are told of both; its particles as of known_torn
  std::int64_t damping_products_ = 0;  ///< of a method that solves for the damping, in all steps
  int known_torn_ = 0;
  bool springs_changed_ = true;  ///< or what is fixed, since what follows from them was made
  std::unique_ptr<Team> team_;
  std::unique_ptr<TeamCrew> crew_;
  ThreadGovernor governor_;
  std::function<int()> forced_threads_;
  double steps_per_second_ = 0;                           ///< of the last run; 0: not known
  int wave_steps_ = 0;                                    ///< at most, of the threads that work
  std::vector<std::unique_ptr<Band<R, Present>>> bands_;  ///< one for each thread
  std::vector<std::unique_ptr<Band<R, Present>>> waves_;  ///< one for each sweep of a wave, over all rows
  std::vector<Progress> progress_;                        ///< of each thread's last sweep in a wave
  StepGuard guard_;
  BatchResult made_;        ///< by the present run
  int together_ = 0;        ///< steps that are made in one pass over the rows; 0: the run is over
  bool abandoned_ = false;  ///< the present step was stopped halfway
  bool late_ = false;       ///< the present stage ends with the passes that are made
  bool repeating_ = false;  ///< known steps, which are not stopped
  const Stop never_{};
  glm::dvec3 hand_force_{0};  ///< on the held particle: of a method that projects, or what one that solves lags
};

std::unique_ptr<Engine> make_cpu_engine(const Preset& preset, const Lattice& lattice, int threads);

}  // namespace tyglab::cpu
