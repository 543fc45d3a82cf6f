// The implicit stages of a method on a device (newton.h, kernels/implicit.cl). Vectors stay on the device, and the host
// reads only the sums that Newton's method needs.
//
// The residual is one more sweep; the linearized force is stored as four numbers per spring. A step of conjugate
// gradients with the diagonal blocks takes two launches: in the first, each particle gathers the product from its
// twelve springs; the second updates. Each work-item or group stores its part of the sums, and every reader adds the
// parts in one fixed order: nothing is read back, sums need no launches, and every run has identical bits. The host
// queues as many steps as the last system took and then reads the result; launches that come too late do nothing. For
// small cloths, one group solves in a single launch. If conjugate gradients do not converge, the host reads the four
// numbers per spring and factorizes (direct_solve.h). The host also solves stiff stages, and those at which Newton's
// method fails (implicit/stiff_stage.h), as with the CPU engine.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "core/engines/direct_solve.h"
#include "core/engines/implicit/stiff_stage.h"
#include "core/engines/newton.h"
#include "core/engines/opencl/device.h"
#include "core/engines/opencl/device_constants.h"
#include "core/engines/opencl/device_state.h"
#include "core/engines/opencl/opencl_devices.h"

namespace tyglab::opencl {

template <class R>
class DeviceSolver final : private implicit::EitherStage {
 public:
  struct Kernels {
    Kernel linearise, gradients, begin_gradients, multiply, update, go, inner_products;
  };
  static Kernels make_kernels(const Program& program);
  /// Work-items of a group where a work-item has one particle.
  static constexpr int group_items = 128;
  /// Number of particles up to which one launch makes all iterations of conjugate gradients, since a launch for each
  /// would take longer than its work.
  static constexpr int most_at_once(int width) { return width == 1 ? 4096 : most_solved_in_one_launch; }
  /// Writes the residual of x and v, for c_v.
  using Residual = std::function<void(cl_mem x, cl_mem v, cl_mem c_v, cl_mem residual)>;

  /// `width`: particles that a work-item processes at a time.
  DeviceSolver(std::shared_ptr<Device> device, const Lattice& lattice, DeviceState<R>& state, int width);

  struct Task {
    const Kernels* kernels;
    const Preset* preset;
    const std::vector<int>* fixed;  ///< particles that keep their velocity
    cl_mem constants;               ///< of forces that are linear in positions; null if there are none
    int position, velocity;         ///< vectors
    double h;                       ///< β dt
    Residual residual;
    Stop stop;
    std::function<void(double part)> progress;
  };
  /// Replaces c_x and c_v in the two vectors by the solution. Returns false where it was stopped; the vectors may then
  /// hold anything.
  bool solve(const Task& task);
  const SolveCounts& counts() const { return counts_; }
  /// As of the CPU engine's solver.
  void begin_step() { solved_ = {true, 0}; }
  /// The stages of the step together, as they are kept, in the precision of the state.
  const Balance& solved() const { return solved_; }
  std::size_t bytes() const;

 private:
  /// Inner products of two vectors a and b.
  struct Products {
    double aa, ab, bb;
  };
  /// What remains of the residual of a linear system.
  struct Left {
    double squared, enough;
    int count;
  };

  double start_size() override { return start_size_; }
  double evaluate() override;
  void linearize() override;
  bool gradients() override;
  bool solve_directly() override;
  Step step() override;
  Trial try_part(double part) override;
  Balance balance() override;
  Balance solve_by_newton() override;
  Balance solve_stiff() override;
  void keep() override;
  void restore() override;
  bool stops() override { return stopped_ = stopped_ || (task_.stop && task_.stop()); }
  void note_progress(double part) override { task_.progress(part); }

  /// What the host needs to know of the stage, read from the device.
  void read_scene();
  /// Makes the velocity that was tried the present one.
  void arrive();
  void launch_go(double part);
  void launch(const Kernel& kernel, std::size_t groups) const;
  /// Sets the first arguments, common to all kernels of a system; returns the number of the next.
  int set_system(const Kernel& kernel) const;
  /// Sets a number in the precision of sums.
  int set_sum(const Kernel& kernel, int at, double value) const;
  Products inner_products(cl_mem a, cl_mem b) const;
  /// All iterations by one group, in one launch.
  Left make_gradients(int most) const;
  /// Two launches for each iteration; now and then the host checks whether they have converged.
  Left make_gradients_in_launches(int most);
  void launch_step(int n, int most) const;
  Left read_left(const Memory& progress, std::size_t groups) const;
  template <class B>
  Left read_left_as(const Memory& progress, std::size_t groups) const;

  std::shared_ptr<Device> device_;
  Lattice lattice_;
  DeviceState<R>& state_;
  int width_;
  std::size_t groups_;  ///< of a launch over the whole cloth
  bool at_once_;        ///< one group makes all iterations of conjugate gradients
  std::size_t coefficient_numbers_, block_numbers_;
  Memory start_x_, start_v_, residual_, step_;
  Memory left_, preconditioned_, product_;  ///< of conjugate gradients
  Memory kept_;                             ///< velocities
  std::array<Memory, 2> directions_;        ///< theirs, of an even and of an odd iteration
  std::array<Memory, 2> progress_;          ///< likewise, before it
  Memory coefficients_, blocks_, sums_;
  DirectSolver direct_;
  implicit::StiffStage stiff_;
  Tears tears_;                      ///< of the stage
  std::vector<std::uint8_t> fixed_;  ///< likewise: 1 at i·columns + j
  Task task_{};
  bool stopped_ = false;
  implicit::TooSlow too_slow_;
  Balance solved_{true, 0};
  Balance judged_;     ///< of the present stage, by balance()
  bool away_ = false;  ///< a velocity is being tried
  double start_size_ = 0;
  int last_count_ = 16;  ///< iterations for the last system: about as many are likely again
  SolveCounts counts_;
};

}  // namespace tyglab::opencl
