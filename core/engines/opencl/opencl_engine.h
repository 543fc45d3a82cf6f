// The OpenCL engine runs every explicit scheme of fixed dt, and the implicit schemes, on an OpenCL device.
//
// Its program consists of the files of kernels/ followed by a kernel for each sweep of the method, whose sums are
// generated from the scheme (program_text.h). The features of a scene (bending, damping, wind, bodies) are build
// options, so unused features cost nothing. Constants are arguments, so a slider builds nothing unless it switches a
// feature.
//
// A sweep has two forms. On processors (kernels/band.cl) a work-item processes a band of rows in vectors of the
// processor's width and computes each spring once, like the CPU engine, because compilers for processors do not turn
// work-items into vectors. On graphics cards (kernels/gather.cl) a work-item processes one particle and gathers the
// forces from its twelve neighbors; every spring is computed twice, and nothing is passed on.
//
// A sweep reads one set of arrays and writes another, since neighbors may still read the old values. On processors a
// launch makes several levels, that is, steps: each runs three rows behind the one before, and at the edges of a band
// the rows that the next step needs are computed twice. So the state passes through memory once for several steps, and
// these share the cost of a launch.
//
// Masks contain one byte per particle: which of its springs are intact, whether it is free, and whether everything that
// a block depends on is intact, in which case no other mask is read. Values beyond the cloth are zeros, so an edge
// works like a tear.
//
// Steps are queued in batches, each as long as the divergence budget allows with a margin (fault.h). A batch reports
// its largest displacement; if a step in it should have been examined, the engine returns to its backup and repeats the
// steps up to that one. The host waits only for the end of a batch. Positions are read through a mapping: on a
// processor this is the memory that kernels write, on a card one copy. For a single particle, a card transfers only the
// values near it.
#pragma once

#include <cassert>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/engines/engine.h"
#include "core/engines/opencl/device_constants.h"
#include "core/engines/opencl/device_solver.h"
#include "core/engines/opencl/device_state.h"
#include "core/engines/opencl/opencl_devices.h"
#include "core/engines/opencl/program_text.h"
#include "core/engines/step_guard.h"
#include "core/engines/vertex_sharing.h"
#include "core/integrators/scheme.h"

namespace tyglab::opencl {

template <class R>
class OpenClEngine final : public Engine, private VertexSharing, private GuardedSteps {
 public:
  OpenClEngine(const Preset& preset, const Lattice& lattice, std::shared_ptr<Device> device, int width);

  using Engine::load;
  void load(const StateRows& rows, const Tears& tears) override;
  void synchronize(const Tears& tears) override;
  void set_preset(const Preset& preset, const Tears& tears) override;
  bool ready_for(const Preset& preset) const override;
  bool ready_for_contacts() const override;
  void set_fixed(std::span<const int> pinned, Held held) override;
  void drive_pins(std::span<const DrivenPin> pins, bool place) override;
  AdvanceResult advance(int steps, Tears& tears) override;
  void note_contacts(bool on) override;
  std::vector<Contact> contacts() const override {
    assert(notes_contacts_);
    return contacts_;
  }
  void read(State& state, const Tears& tears) override;
  void read_raw(State& state, const Tears& tears) override;
  PositionView positions() const override;
  VertexSharing* vertex_sharing() override { return this; }
  StoredParticle stored(int i, int j) const override;
  glm::dvec3 position(int i, int j) const override { return state_.at(vector_x, i, j); }
  std::size_t bytes() const override;
  int threads() const override { return int(device_->facts().compute_units); }
  SolveCounts solves() const override { return guard_.with_steps(solver_ ? solver_->counts() : SolveCounts{}); }
  double given_squared() const override { return guard_.given_squared(); }
  InnerSteps inner_steps() const override { return {}; }
  std::vector<StepFeature> features() const override;
  std::string name() const override;

 private:
  using Constants = DeviceConstants<R>;
  /// The kernels for one set of features.
  struct Kernels {
    std::vector<Kernel> passes;  ///< an empty one for a solution
    Kernel start, accelerations, residual, set_fixed, drive_pins, combine, tear, derive_masks, derive_linear, look,
        to_float;
    typename DeviceSolver<R>::Kernels solver;
  };
  /// A sweep with its constants; for a solution, those of its residual.
  struct Resolved {
    const Sweep* sweep;
    Constants constants;
    Work work = Work::forces;
  };

  bool remote() const override { return !device_->facts().shared_memory; }
  std::uint64_t bytes_read() const override { return state_.bytes_read(); }
  std::size_t wanted_slot_bytes() const override;
  bool use_memory(std::shared_ptr<PositionMemory> memory) override;
  PositionView drawn_positions() override;
  GlSharing gl_sharing() const override;
  std::unique_ptr<GlVertices> share(const GlBuffers& buffers) const override;
  std::optional<VertexBox> write(GlVertices& vertices, const VertexRequest& request) override;
  std::string copy_reason() const override;

  bool tears_watched() const { return tears_springs(preset_); }
  double velocity_scale() const { return scheme_->keeps_displacement && !synchronized_ ? preset_.dt : 1; }
  /// How far velocities lag behind positions, s.
  double lag() const { return synchronized_ ? 0 : scheme_->lag * preset_.dt; }
  /// The vector that damping uses at the start of a step.
  int seen() const { return synchronized_ ? vector_v : seen_velocity(*scheme_); }
  /// The method's own start from a synchronized state.
  void start();
  std::string options(const Preset& preset, bool contacts) const;
  /// The name under which the device knows the kernels for such a preset.
  std::string program_name(const Preset& preset, const std::string& options) const;
  /// The kernels for a preset. Throws EngineError if they do not build.
  Kernels make_kernels(const Preset& preset, bool contacts) const;
  Constants constants(const Preset& preset, const Sweep& sweep) const;
  void resolve();
  /// Where bodies are in each of that many steps from now on.
  void upload_bodies(int steps);
  /// Shares of the springs that take over what forces do that are linear in positions (linear_springs.h).
  void upload_shares();
  /// Makes the masks, and the constants of those springs, from what is whole. `report`: of the look before, or null.
  void derive(cl_mem report, int slot);
  template <class B>
  void upload_bodies_as(int steps);
  void read_contacts(std::uint32_t count);

  /// Launches `columns` work-items for each row.
  void launch_rows(const Kernel& kernel, int columns) const;
  /// Sets a sweep's arguments after its vectors, and launches it.
  void launch_sweep(const Kernel& kernel, int at, const Constants& constants, int slot, int levels) const;
  /// Queues one sweep, or `levels` steps of a method of one sweep.
  void enqueue_sweep(const Kernel& kernel, const Resolved& resolved, int slot, int levels = 1);
  /// Solves the implicit stage of a sweep; waits for it. Returns false where it was stopped.
  bool solve(const Resolved& resolved, int slot);
  void plan_bands();
  void enqueue_tear(int slot);
  /// Writes F/m of the present state into acceleration_.
  void accelerations() const;
  void write_fixed_velocities(bool place = false);
  /// Brings masks, guards and backup up to date with changes from outside.
  void accept_changes(const Tears& tears);
  void upload_masks(const Tears& tears);
  void read_stored(State& state) const;
  void add_accelerations(State& state, double times);
  StateView<R> view() const { return {state_.host(vector_x), state_.host(vector_v), state_.stride()}; }

  // What the guard asks for.
  BatchResult make_steps(int most, Tears& tears, Fault& fault) override;
  StepMeasures measures(int step) override;
  double tear_overloaded(Tears& tears) override;
  bool find_fault(Tears& tears, Fault& fault, double& divergence_budget) override;
  bool find_runaway(const MotionLimit& limit, Fault& fault) override;
  Motion motion(const Tears& tears) override;
  void keep_backup() override { state_.keep_backup(), synchronized_backup_ = synchronized_, step_backup_ = step(); }
  void repeat(int steps, Tears& tears) override;

  /// Makes that many steps, and reads their reports. `tear_each`: each breaks overloaded springs. Returns false where a
  /// step was stopped halfway.
  bool run(int count, bool tear_each);
  int steps_of_batch(int most) const;
  /// find_fault() on the device, which leaves the state there. False: something may be wrong.
  bool well_on_device(double& divergence_budget);
  /// What kernels report outside of a step.
  template <class Launch>
  DeviceStepMeasures report_of(const Launch& launch);
  /// By how much any spring may grow before one can be overloaded, m.
  double tear_slack(const DeviceStepMeasures& report) const;
  /// Copies what steps have broken on the device.
  void read_tears(Tears& tears);

  std::shared_ptr<Device> device_;
  Preset preset_;
  Lattice lattice_;
  const Scheme* scheme_;
  mutable DeviceState<R> state_;
  std::vector<Pass> passes_;
  std::vector<Resolved> resolved_;  ///< as passes_
  std::unique_ptr<DeviceSolver<R>> solver_;
  mutable Memory acceleration_;
  int width_;                     ///< particles that a work-item processes at a time
  int bands_ = 1, levels_ = 1;    ///< work-items of a sweep, and steps of a launch at most, if width_ > 1
  std::size_t band_numbers_ = 0;  ///< size of a band's scratch memory
  Memory scratch_;
  mutable Kernels kernels_;
  std::string options_;
  Memory guards_, reports_, hand_, fixed_list_, bodies_, contact_list_, shares_, linear_;
  int share_count_ = 0;
  std::vector<int> pinned_;
  std::vector<DrivenPin> driven_;
  Memory driven_list_, driven_values_;  ///< of as many pins as have room
  std::size_t driven_room_ = 0;
  Held held_;
  bool masks_stale_ = true, notes_contacts_ = false;
  bool synchronized_ = true;  ///< vectors 0 and 1 hold positions and velocities of one time, others nothing
  bool synchronized_backup_ = true;
  StepNumber step_backup_;
  bool bodies_move_ = false;
  bool memory_settled_ = false;  ///< positions are in lent memory, or cannot be
  bool noted_run_ = false;       ///< the device knows that the present kernels have made steps
  std::vector<Contact> contacts_;
  std::vector<DeviceStepMeasures> report_;
  std::vector<R> hand_forces_;  ///< of each step of the batch
  StepGuard guard_;
  bool tears_each_ = false;      ///< the steps that are being checked have each broken overloaded springs
  bool tears_unread_ = false;    ///< some were broken that `tears` does not have yet
  bool repeating_ = false;       ///< known steps, which are not stopped
  double seconds_per_step_ = 0;  ///< of the last batch; 0: not known
};

}  // namespace tyglab::opencl
