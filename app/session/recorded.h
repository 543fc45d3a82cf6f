// Samples for the plots of the forces, of the energies and of a weight's height, recorded while a plot needs them.
#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/model/notation.h"
#include "core/output/series_csv.h"
#include "core/simulation.h"

// Samples over simulated time, for plots and their CSV files.

namespace tyglab {

class Series {
 public:
  explicit Series(std::size_t columns = 0) : columns_(columns) {}
  bool empty() const { return t_.empty(); }
  std::size_t size() const { return t_.size(); }
  std::span<const double> t() const { return t_; }
  std::span<const double> column(std::size_t k) const {
    assert(k < columns_.size());
    return columns_[k];
  }
  /// One value a column. Samples that do not come after the last one start a new series.
  void add(double t, std::span<const double> values);
  /// Marks steps without samples: a curve has a gap before the next sample.
  void interrupt() { interrupted_ = !t_.empty(); }
  /// Samples before which there is a gap, ascending.
  std::span<const std::size_t> gaps() const { return gaps_; }
  /// The motion goes on from that time, s: later samples are of a motion that is gone, and before it begins where there
  /// are none there is a gap.
  void go_on_from(double t);
  void clear();
  std::size_t bytes() const { return t_.capacity() * sizeof(double) * (1 + columns_.size()); }
  /// Text of a CSV file as `tyglab run --series` writes it.
  std::string csv(std::span<const SeriesColumn> columns, const std::string& about) const;

 private:
  static constexpr std::size_t most = 40000;
  std::vector<double> t_;
  std::vector<std::vector<double>> columns_;
  std::vector<std::size_t> gaps_;
  bool interrupted_ = false;
};

/// The source of the force plot.
enum class Source { particle, sum, maximum };

struct Recorded {
  Source chosen = Source::particle;  ///< force_source() is what it follows
  bool paused = false;
  std::int64_t sampled = 0;                                    ///< of Session::steps_made, those with a sample
  Series forces{force_keys().size()};                          ///< magnitudes, N, by force_keys()
  Series energy{4};                                            ///< J, by energy_columns
  Series height{5};                                            ///< m, of the weight, then by ReferenceCurves::curves
  std::vector<std::pair<double, std::string>> height_methods;  ///< from which t on (s) which method moved the weight

  void clear() { forces.clear(), height.clear(), energy.clear(); }
  /// The motion goes on from that time (Series::go_on_from).
  void go_on_from(double t);
};

/// Curves of the energies, in the order of Recorded::energy's columns. "by method": what it added, below 0 removed.
inline constexpr std::array<std::string_view, 4> energy_columns{"kinetic", "elastic", "total change", "by method"};
const Variable& variable(std::string_view key);
/// Of Recorded::forces: abs_F_s of a particle, sum_F_s or max_F_s of all, as `run --series` names them; all are
/// magnitudes.
std::vector<SeriesColumn> force_columns(Source source);
/// y, y_euler, … of Recorded::height.
std::vector<SeriesColumn> height_columns();
/// kinetic, … of Recorded::energy.
std::vector<SeriesColumn> energy_column_list();

struct Session;
/// The source of the force plot; for a mass on a spring it is the mass, whatever was chosen for cloths.
Source force_source(const Session& session);
/// Before the first steps of a plot: a series begins with the present state, at t = 0 after a restart.
void sample_start(Session& session);
/// Takes the requested samples of the steps just made.
void sample(Session& session);
/// How many steps apart samples are taken within a frame, so that what is plotted does not depend on how often pictures
/// are drawn; more than there are in a frame where a sample costs much, as on a device or of a sum over the cloth.
int steps_between_samples(const Session& session);

// Figure 3.2 live: companions of the mass on a spring that use the report's other methods, and its exact motion.

class ReferenceCurves {
 public:
  /// The curves, in the colors of figure 3.2; the last is the closed form.
  static constexpr std::array<std::string_view, 4> curves{"euler", "improved_euler", "verlet", "exact"};
  static constexpr std::array<std::string_view, 4> titles{"Euler", "improved Euler", "Verlet", "exact"};
  using Heights = std::array<double, curves.size()>;

  /// Makes the `steps` that the weight has just made, with its constants and dt, from where it began; returns y by each
  /// curve, m: not a number once a companion has diverged. Where the weight has moved unseen, its constants may have
  /// changed on the way: all begin again from where it is, or from its start where it has made no other steps.
  Heights follow(Simulation& weight, std::int64_t steps);
  void clear() { companions_ = {}; }

 private:
  void begin(const Simulation& weight, double y, double v, double t);
  void take_constants(const Preset& preset);

  std::array<std::unique_ptr<Simulation>, curves.size() - 1> companions_;
  Preset of_;  ///< the weight's constants as they were last seen
  std::int64_t steps_ = 0;
  double t_ = 0;        ///< s, of the last call
  Preset exact_;        ///< whose start is the exact motion's last start
  double exact_t_ = 0;  ///< s, when that was
};

}  // namespace tyglab
