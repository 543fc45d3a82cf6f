// The OpenCL engine: runs every explicit scheme of fixed dt, and those that solve, on an OpenCL device.
#pragma once

#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/engines/engine.h"
#include "core/engines/fault.h"
#include "core/engines/opencl/device_constants.h"
#include "core/engines/opencl/device_solver.h"
#include "core/engines/opencl/device_state.h"
#include "core/engines/opencl/make_opencl_engine.h"
#include "core/engines/opencl/program_text.h"
#include "core/integrators/scheme.h"

namespace tyglab::opencl {

template <class R>
class OpenClEngine final : public Engine {
 public:
  OpenClEngine(const Preset& preset, const Lattice& lattice, std::shared_ptr<Device> device, int width);

  using Engine::load;
  void load(const StateRows& rows, const Tears& tears) override;
  void set_preset(const Preset& preset, const Tears& tears) override;
  bool ready_for(const Preset& preset) const override;
  bool ready_for_contacts() const override;
  void set_fixed(std::span<const int> pinned, Held held) override;
  Advance advance(int steps, Tears& tears) override;
  void note_contacts(bool on) override;
  std::vector<Contact> contacts() const override { return contacts_; }
  void read(State& state, const Tears& tears) override;
  void read_raw(State& state, const Tears& tears) override;
  PositionView positions() const override;
  bool remote() const override { return !device_->facts().shared_memory; }
  std::size_t wants_memory() const override;
  bool take_memory(std::shared_ptr<PositionMemory> memory) override;
  PositionView shown() override;
  GlSharing gl_sharing() const override;
  std::unique_ptr<GlVertices> share(const GlBuffers& buffers) const override;
  std::optional<VertexBox> write(GlVertices& vertices, const VertexOrder& order) override;
  std::string why_copied() const override;
  std::uint64_t copied() const override { return state_.copied(); }
  StoredParticle stored(int i, int j) const override;
  glm::dvec3 position(int i, int j) const override { return state_.at(vector_x, i, j); }
  std::size_t bytes() const override;
  int threads() const override { return int(device_->facts().compute_units); }
  SolveCounts solves() const override { return solver_ ? solver_->counts() : SolveCounts{}; }
  InnerSteps inner_steps() const override { return {}; }
  std::vector<StepFeature> features() const override;
  std::string name() const override;

 private:
  using Constants = DeviceConstants<R>;
  /// The kernels of one set of features.
  struct Kernels {
    std::vector<Kernel> passes;  ///< none for a solution
    Kernel start, accelerations, residual, set_fixed, combine, tear, derive_masks, look, to_float;
    typename DeviceSolver<R>::Kernels solver;
  };
  /// A sweep with its constants worked out; of a solution those of its residual.
  struct Resolved {
    const Sweep* sweep;
    Constants constants;
    Work work = Work::forces;
  };
  enum class End { none, fault, released, rolled_back };

  bool tears_watched() const { return preset_.F_max > 0 && preset_.k_s > 0 && preset_.kind == Kind::cloth; }
  bool meets_bodies(const Preset& preset) const { return !preset.bodies.empty() && preset.kind == Kind::cloth; }
  double velocity_scale() const { return scheme_->keeps_displacement ? preset_.dt : 1; }
  std::string options(const Preset& preset, bool contacts) const;
  /// What the device knows the kernels by that such a preset runs.
  std::string program_name(const Preset& preset, const std::string& options) const;
  /// Kernels for a preset; throws and changes nothing if they do not build.
  Kernels make_kernels(const Preset& preset, bool contacts) const;
  Constants constants(const Preset& preset, const Sweep& sweep) const;
  void resolve();
  void upload_bodies();
  template <class B>
  void upload_bodies_as();
  void read_contacts(std::uint32_t count);

  /// So many work-items for each row.
  void launch_rows(const Kernel& kernel, int columns) const;
  /// A sweep's, behind its vectors, and its work-items.
  void launch_sweep(const Kernel& kernel, int at, const Constants& constants, int slot, int levels) const;
  /// One sweep, or as many steps as there are levels of a method of one sweep.
  void enqueue_sweep(const Kernel& kernel, const Resolved& resolved, int slot, int levels = 1);
  /// Solves the implicit stage of a sweep; waits for it.
  void solve(const Resolved& resolved, int slot);
  void plan_bands();
  void enqueue_tear(int slot);
  /// F/m now, into acceleration_.
  void accelerations() const;
  void write_fixed_velocities();
  /// Brings masks, guards and backup up to date with what was changed from outside.
  void take_changes(const Tears& tears);
  void upload_masks(const Tears& tears);
  void read_stored(State& state) const;

  /// Forgets how far particles may still move: something else than their motion has changed.
  void invalidate_budgets() {
    divergence_budget_ = tear_budget_ = 0;
    since_backup_ = -1;
    growth_ = std::numeric_limits<double>::infinity();
  }
  int steps_in_batch(int left) const;
  /// Makes that many steps, and reads what they report.
  void make_steps(int count, bool tear_each);
  /// Judges the steps made; returns those that count, and end_ says how they ended.
  int judge(int count, bool tear_each, Tears& tears, Fault& fault);
  /// Looks at every particle and spring; if all is well, says so in divergence_budget_.
  bool finds_fault(const Tears& tears, Fault& fault);
  /// The same on the device, which leaves the whole state there; it only tells that something may be wrong.
  bool well_on_device();
  bool releases(int step) const;
  template <class Look>
  StepReport look_at_springs(const Look& look);
  void tear_overloaded(Tears& tears);
  double tear_slack(const StepReport& report) const;
  void keep_backup(const Tears& tears);
  void repeat(int steps, Tears& tears);

  std::shared_ptr<Device> device_;
  Preset preset_;
  Lattice lattice_;
  const Scheme* scheme_;
  mutable DeviceState<R> state_;
  std::vector<Pass> passes_;
  std::vector<Resolved> resolved_;  ///< as passes_
  std::unique_ptr<DeviceSolver<R>> solver_;
  mutable Memory acceleration_;
  int width_;                     ///< particles that a work-item works on at a time
  int bands_ = 1, levels_ = 1;    ///< work-items of a sweep, and steps of a launch at most, where width_ is over 1
  std::size_t band_numbers_ = 0;  ///< of a band's scratch
  Memory scratch_;
  mutable Kernels kernels_;
  std::string options_;
  Memory guards_, reports_, hand_, fixed_list_, bodies_, contact_list_;
  std::vector<int> pinned_;
  Held held_;
  bool masks_stale_ = true, notes_contacts_ = false;
  bool asked_for_memory_ = false;  ///< it has some, or cannot use it
  bool noted_run_ = false;         ///< that the present kernels have made steps
  std::vector<Contact> contacts_;
  std::vector<StepReport> report_;
  std::vector<R> hand_forces_;  ///< of each step of the batch
  Tears tears_backup_;
  int since_backup_ = -1;  ///< steps; under 0: there is none
  int torn_ = 0;           ///< springs, when a step was last made: cuts come from outside
  double growth_ = 0, divergence_budget_ = 0, tear_budget_ = 0;  ///< as in the CPU engine, m
  bool tears_often_ = false;                                     ///< springs are looked at in every step
  int left_inside_ = 0;
  End end_ = End::none;
  glm::dvec3 hand_force_{0};
};

}  // namespace tyglab::opencl
