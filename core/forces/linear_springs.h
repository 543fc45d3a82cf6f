// Forces that are linear in positions, as springs. A potential ½κ|Σ w x|² with Σ w = 0 is the sum of
// -½κ w_k w_l |x_k - x_l|² over the pairs of its points, so all such forces together are springs of rest length 0 along
// the directions of the lattice: engines add one constant a spring, whatever and however many these forces are. A
// constant may be negative; the sum of all potentials is not.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/cloth/state.h"
#include "core/forces/force.h"
#include "core/model/preset.h"

namespace tyglab {

/// In precision R and with rows of `stride` numbers, as an engine's own fields.
template <class R>
class LinearSprings {
 public:
  /// Whether the scene has such forces.
  static bool exist(const Preset& preset);

  /// Takes the scene's constants times `scale`. To be called wherever the preset or tears may have changed; does
  /// nothing where they have not. Afterwards empty() where the scene has no such forces.
  void follow(const Preset& preset, const Tears& tears, int stride, double scale = 1);
  bool empty() const { return block_of_.empty(); }
  /// Another number after each change.
  std::uint64_t version() const { return version_; }
  /// Row i: `stride` constants for each direction (lattice.h), N/m times the scale; a spring to the lower left at the
  /// column of its lower end. 0 where there is no spring; nullptr if empty.
  const R* row(int i) const;
  /// The constant of the spring of that direction that (i, j) owns.
  R at(int direction, int i, int j) const;
  std::size_t bytes() const { return data_.size() * sizeof(R) + block_of_.size() * sizeof(int) + known_.bytes(); }

  /// What a stencil owned by (i, j) adds to the spring of a direction that (i + di, j + dj) owns.
  struct Share {
    const Stencil* stencil;
    int direction, di, dj;
    double constant;  ///< N/m, times the scale
    bool operator==(const Share&) const = default;
  };
  static std::vector<Share> shares_of(const Preset& preset, double scale);

 private:
  bool is_regular(const Tears& tears, int i) const;
  void compute(const Tears& tears, int i, R* to) const;
  std::ptrdiff_t pitch() const { return std::ptrdiff_t(directions.size()) * stride_; }

  int stride_ = 0;
  std::vector<Share> shares_;
  Tears known_;                ///< for which the rows have been computed
  Array<R> data_;              ///< blocks of one row; the first is that of all rows far from edges and tears
  std::vector<int> block_of_;  ///< of each row
  int blocks_ = 0;
  std::uint64_t version_ = 0;
};

}  // namespace tyglab
