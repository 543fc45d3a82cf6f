// A fixed state with the interface of an engine, for reading while the cloth's own engine makes a step in another
// thread.
#pragma once

#include "core/engines/engine.h"
#include "core/simd/row_field.h"

namespace tyglab {

class StillEngine final : public Engine {
 public:
  /// What the engine of a cloth with these constants holds now, and says of itself. The velocity that damping sees is
  /// taken to be the particle's own.
  StillEngine(Engine& of, const Preset& preset, const Lattice& lattice, const Tears& tears);

  /// Nothing here can be changed or moved: that is for the engine itself.
  void load(const StateRows&, const Tears&) override {}
  void synchronize(const Tears&) override {}
  void set_preset(const Preset&, const Tears&) override {}
  void set_fixed(std::span<const int>, Held) override {}
  void drive_pins(std::span<const DrivenPin>, bool) override {}
  AdvanceResult advance(int, Tears&) override;
  void note_contacts(bool) override {}

  /// None: the ledger of who steps asks the engine itself.
  std::vector<Contact> contacts() const override { return {}; }
  void read(State& state, const Tears&) override { state = state_; }
  void read_raw(State& state, const Tears&) override { state = raw_; }
  PositionView positions() const override;
  StoredParticle stored(int i, int j) const override;
  std::size_t bytes() const override { return bytes_; }
  int threads() const override { return threads_; }
  int threads_at_work() const override { return threads_at_work_; }
  SolveCounts solves() const override { return solves_; }
  InnerSteps inner_steps() const override { return inner_steps_; }
  std::vector<StepFeature> features() const override { return features_; }
  std::string name() const override { return name_; }

 private:
  Lattice lattice_;
  State state_, raw_;
  double lag_;                ///< s, of the velocities in raw_
  simd::RowField<double> x_;  ///< in the layout of positions()
  int stride_;
  std::size_t bytes_;
  int threads_, threads_at_work_;
  SolveCounts solves_;
  InnerSteps inner_steps_;
  std::vector<StepFeature> features_;
  std::string name_;
};

}  // namespace tyglab
