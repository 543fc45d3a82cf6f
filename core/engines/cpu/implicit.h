// The implicit stages of a method on the processor (newton.h), in SIMD, and on one thread except for the linear systems
// of stiff stages. Products with the matrix are computed row by row from the stiffness of each spring (stiffness.h);
// the matrix is stored only for factorization.
#pragma once

#include <cassert>
#include <functional>
#include <utility>

#include "core/engines/cpu/band.h"
#include "core/engines/cpu/global_step.h"
#include "core/engines/direct_solve.h"
#include "core/engines/implicit/couplings.h"
#include "core/engines/implicit/stiff_stage.h"
#include "core/engines/implicit/stiffness.h"
#include "core/engines/newton.h"

namespace tyglab::cpu {

template <class R>
class ImplicitSolver final : private implicit::EitherStage {
 public:
  using Field = RowField<R>;
  /// Writes a for the vectors that are being solved for.
  using Accelerations = std::function<void(Field&)>;

  /// What surrounds a solution.
  struct Watch {
    const Stop& stop;
    StageLimit limit;
    std::function<void(double part)> progress;
    implicit::Crew& crew;
  };
  /// How to solve, and whether springs or what is fixed may differ from the last call.
  struct Way {
    Solver solver;
    bool changed;
    const Field* air;  ///< accelerations that the stage has beside those of its positions and velocities; or null
    /// What the cloth has beside the lattice, which Newton's method alone knows; or null.
    const implicit::Beside* beside;
  };

  /// A step begins, whose stages come next.
  void begin_step() { solved_ = {true, 0}, late_ = counted_ = false; }
  /// The stages of the step together, as they are kept, in the precision of the state.
  const Balance& solved() const { return solved_; }
  /// Replaces c_x and c_v in the two vectors by the solution; `dt` is β dt. Fixed particles keep their velocity.
  /// Returns false where it was stopped; the vectors may then hold anything.
  bool solve(Cloth<R>& cloth, int position, int velocity, double dt, const Tears& tears,
             const Accelerations& accelerations, const Watch& watch, Way way);
  /// For a stage that others solve: keeps c_x and c_v, which the two vectors hold.
  void begin_stage(Cloth<R>& cloth, int position, int velocity) { begin_stage(cloth, position, velocity, nullptr); }
  /// What the velocities that `passes` passes have found leave of that stage's equations.
  void measure_stage(double dt, const Tears& tears, const Accelerations& accelerations, const Watch& watch, int passes);
  /// Whether the stage is as it was before, to be solved by passes of block descent while there is time.
  bool left_to_passes() const { return left_to_passes_; }
  /// The present step's time is up.
  void note_late() { late_ = true; }
  const SolveCounts& counts() const { return counts_; }
  std::size_t bytes() const;

 private:
  /// Arguments of solve().
  struct Task {
    Cloth<R>* cloth;
    int position, velocity;
    double dt;
    const Tears* tears;
    const Accelerations* accelerations;
    const Watch* watch;
  };
  double start_size() override;
  double evaluate() override;
  void linearize() override;
  bool gradients() override;
  bool solve_directly() override;
  Step step() override;
  Trial try_part(double part) override;
  Balance balance() override;
  Balance solve_by_newton() override;
  Balance solve_beside();
  Balance solve_stiff() override;
  Balance solve_quickly() override;
  void keep() override { kept_ = velocity(); }
  void restore() override {
    assert(!kept_.empty());
    velocity() = kept_, evaluate(), balance();
  }
  bool stops() override {
    return stopped_ = stopped_ || (task_.watch != nullptr && task_.watch->stop && task_.watch->stop());
  }
  /// Asks every so many rows.
  bool stops_before(int row);
  bool out_of_time() override { return is_over(1); }
  StageLimit limit() override { return task_.watch->limit; }
  void note_progress(double part) override { task_.watch->progress(part); }

  const Cloth<R>& cloth() const { return *task_.cloth; }
  Field& position() { return task_.cloth->vector(task_.position); }
  Field& velocity() { return task_.cloth->vector(task_.velocity); }
  bool begin_stage(Cloth<R>& cloth, int position, int velocity, const Watch* watch);
  template <class What>
  bool in_parts(std::size_t count, const What& what);
  bool take_zeros(Array<R>& array, std::size_t count);
  bool copy(const Field& from, Field& to);
  bool resize();
  bool resize_newton();
  Balance alternate(bool changed);
  void note_balance(const Balance& balance);
  /// Whether this part of the stage's time is.
  bool is_over(double part) {
    const StageLimit& limit = task_.watch->limit;
    const bool over = limit.seconds > 0 && limit.is_over(part);
    late_ = late_ || over;
    return over;
  }
  void linearize_row(int direction, int i);
  void invert_blocks();
  bool conjugate_gradients();
  void add_couplings();
  double multiply();
  double multiply_beside();
  implicit::Residual update(double alpha);
  double inner(const Field& a, const Field& b);
  R* block(int i) { return blocks_.data() + std::size_t(i) * 6 * stride_; }

  Task task_{};
  bool stopped_ = false, left_to_passes_ = false;
  bool late_ = false, counted_ = false;  ///< in this step: time was up for something; that counts
  Balance solved_{true, 0};
  Balance judged_;  ///< of the present stage, by balance()
  int rows_ = 0, stride_ = 0;
  double mass_ = 1;          ///< diagonal of A without the springs
  Field start_x_, start_v_;  ///< c_x and c_v
  Field acceleration_, before_, kept_;
  Field residual_;  ///< then that of conjugate gradients
  Field step_;
  Field direction_, product_, preconditioned_;
  Array<R> blocks_;  ///< on the diagonal, then their inverses
  Array<R> coefficients_;
  DirectSolver direct_;
  implicit::StiffStage stiff_;
  const Field* air_ = nullptr;                 ///< of the present stage
  const implicit::Beside* beside_ = nullptr;   ///< likewise
  std::vector<implicit::Coupling> couplings_;  ///< of the present linear system
  implicit::TooSlow too_slow_;
  GlobalStep<R> global_;
  SolveCounts counts_;
};

}  // namespace tyglab::cpu
