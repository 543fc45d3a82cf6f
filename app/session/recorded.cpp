
#include "app/session/recorded.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>
#include <utility>

#include "app/session/session.h"
#include "core/analysis/one_weight.h"

namespace tyglab {
namespace {

void sample_forces(Session& session) {
  Recorded& to = session.recorded;
  const double t = session.simulation->time();
  const Source source = force_source(session);
  if (source != Source::particle) {
    const auto reduction = source == Source::sum ? Reduction::sum : Reduction::maximum;
    to.forces.add(t, session.simulation->forces(reduction).values);
  } else if (session.picked) {
    const auto on = session.simulation->particle(session.picked->i, session.picked->j).forces;
    std::array<double, std::tuple_size_v<decltype(on.values)>> sizes;
    std::transform(on.values.begin(), on.values.end(), sizes.begin(),
                   [](const glm::dvec3& F) { return glm::length(F); });
    to.forces.add(t, sizes);
  }
}

void sample_height(Session& session, std::int64_t made) {
  Recorded& to = session.recorded;
  const double t = session.simulation->time(), y = session.simulation->position(0, 0).y;
  const bool fresh = to.height.empty() || t <= to.height.t().back();
  if (fresh) to.height_methods.clear();
  if (fresh || to.height_methods.back().second != session.preset().integrator)
    to.height_methods.emplace_back(t, session.preset().integrator);
  const ReferenceCurves::Heights others = session.curves.follow(*session.simulation, made);
  const std::array row{y, others[0], others[1], others[2], others[3]};
  to.height.add(t, row);
}

void sample_energy(Session& session) {
  const auto reading = session.simulation->ledger();
  if (!reading) return;
  const Energy& now = reading->energy;
  const std::array row{now.kinetic, now.elastic(), now.total() - reading->start, reading->unexplained()};
  session.recorded.energy.add(session.simulation->time(), row);
}

}  // namespace

void Recorded::go_on_from(double t) {
  for (Series* series : {&forces, &height, &energy}) series->go_on_from(t);
  std::erase_if(height_methods, [t](const auto& since) { return since.first > t; });
}

const Variable& variable(std::string_view key) {
  const auto list = variables();
  const auto it = std::find_if(list.begin(), list.end(), [&](const Variable& v) { return v.key == key; });
  if (it == list.end()) throw std::logic_error("no variable is called " + std::string(key));
  return *it;
}

std::vector<SeriesColumn> height_columns() {
  std::vector<SeriesColumn> columns{{"y", "m"}};
  for (std::string_view curve : ReferenceCurves::curves) columns.push_back({"y_" + std::string(curve), "m"});
  return columns;
}

std::vector<SeriesColumn> energy_column_list() {
  std::vector<SeriesColumn> columns;
  for (std::string_view column : energy_columns) columns.push_back({std::string(column), "J"});
  return columns;
}

std::vector<SeriesColumn> force_columns(Source source) {
  const std::string before = source == Source::particle ? "abs_" : source == Source::sum ? "sum_" : "max_";
  std::vector<SeriesColumn> columns;
  for (std::string_view key : force_keys()) columns.push_back({before + std::string(key), "N"});
  return columns;
}

Source force_source(const Session& session) {
  return session.preset().kind == Kind::one_weight ? Source::particle : session.recorded.chosen;
}

void sample_start(Session& session) {
  const Recorded& to = session.recorded;
  const Wants& wants = session.wants;
  if (to.paused) return;
  if (wants.forces && to.forces.empty()) sample_forces(session);
  if (wants.copies && session.copies.distance.empty()) sample_copies(session);
  if (wants.height && to.height.empty()) sample_height(session, 0);
}

void sample(Session& session) {
  Recorded& to = session.recorded;
  const Wants& wants = session.wants;
  assert(to.sampled <= session.steps_made);
  const std::int64_t made = session.steps_made - to.sampled;
  to.sampled = session.steps_made;
  if (made == 0) return;
  if (to.paused || !wants.forces) to.forces.interrupt();
  if (to.paused || !wants.height) to.height.interrupt();
  if (to.paused || !wants.ledger) to.energy.interrupt();
  if (to.paused || !wants.copies) session.copies.distance.interrupt(), session.copies.energy.interrupt();
  if (to.paused) return;
  const FrameCosts::Timer timer(session.costs, Part::sample);
  if (wants.forces) sample_forces(session);
  if (wants.copies) sample_copies(session);
  if (wants.height) sample_height(session, made);
  if (wants.ledger) sample_energy(session);
}

int steps_between_samples(const Session& session) {
  constexpr double apart = 1.0 / 240;  // s, simulated
  const Wants& wants = session.wants;
  const bool particle = wants.forces && force_source(session) == Source::particle;
  const bool cheap = session.preset().engine == EngineKind::cpu && session.copies.lockstep.empty();
  if (session.recorded.paused || !cheap || !(particle || wants.height)) return std::numeric_limits<int>::max();
  return int(std::clamp(std::round(apart / session.preset().dt), 1.0, 1e9));
}

void Series::add(double t, std::span<const double> values) {
  assert(values.size() == columns_.size());
  if (!t_.empty() && t <= t_.back()) {
    if (t == t_.back()) return;
    clear();
  }
  if (t_.size() >= most) {
    // Half at a time, so that the cost of moving is spread over many samples.
    const auto half = std::ptrdiff_t(most / 2);
    t_.erase(t_.begin(), t_.begin() + half);
    for (auto& column : columns_) column.erase(column.begin(), column.begin() + half);
    std::erase_if(gaps_, [](std::size_t gap) { return gap <= most / 2; });
    for (std::size_t& gap : gaps_) gap -= most / 2;
  }
  if (std::exchange(interrupted_, false)) gaps_.push_back(t_.size());
  t_.push_back(t);
  for (std::size_t k = 0; k < columns_.size(); ++k) columns_[k].push_back(values[k]);
  assert(t_.size() <= most && (gaps_.empty() || gaps_.back() < t_.size()));
}

void Series::go_on_from(double t) {
  const auto kept = std::size_t(std::upper_bound(t_.begin(), t_.end(), t) - t_.begin());
  if (kept == t_.size()) return interrupt();
  t_.resize(kept);
  for (auto& column : columns_) column.resize(kept);
  std::erase_if(gaps_, [kept](std::size_t gap) { return gap >= kept; });
  interrupted_ = false;
}

void Series::clear() {
  t_.clear(), gaps_.clear();
  interrupted_ = false;
  for (auto& column : columns_) column.clear();
}

std::string Series::csv(std::span<const SeriesColumn> columns, const std::string& about) const {
  assert(columns.size() == columns_.size());
  std::string text = series_head(columns, about);
  std::vector<double> row(columns_.size());
  for (std::size_t n = 0; n < t_.size(); ++n) {
    for (std::size_t k = 0; k < row.size(); ++k) row[k] = columns_[k][n];
    append_series_row(text, t_[n], row);
  }
  return text;
}

namespace {

/// The constants with a start at y (m) and v (m/s).
Preset starting_at(Preset preset, double y, double v) {
  preset.offset = y - preset.x_0.y;
  preset.v_0.y = v;
  return preset;
}

}  // namespace

void ReferenceCurves::begin(const Simulation& weight, double y, double v, double t) {
  of_ = weight.preset();
  exact_ = starting_at(of_, y, v);
  exact_t_ = t_ = t;
  for (std::size_t n = 0; n < companions_.size(); ++n) {
    Preset own = of_;
    own.integrator = curves[n], own.precision = Precision::double_;
    companions_[n] = std::make_unique<Simulation>(own);
    if (exact_ == of_) continue;
    // A weight may have come to where no preset lets it start.
    State state = companions_[n]->read();
    state.x.y[0] = y, state.v.y[0] = v;
    companions_[n]->load(state);
  }
}

/// What counts while the weight moves; each companion keeps its method.
void ReferenceCurves::take_constants(const Preset& preset) {
  assert(companions_[0] != nullptr);
  const WeightMotion now = exact_weight(exact_, t_ - exact_t_);
  exact_ = starting_at(preset, now.y, now.v);
  exact_t_ = t_;
  for (const auto& companion : companions_) {
    Preset own = companion->preset();
    own.m = preset.m, own.k = preset.k, own.k_d = preset.k_d, own.g = preset.g, own.dt = preset.dt;
    own.x_0 = preset.x_0;
    if (own != companion->preset()) companion->apply(edit::Change{own});
  }
  of_ = preset;
}

ReferenceCurves::Heights ReferenceCurves::follow(Simulation& weight, std::int64_t steps) {
  assert(weight.preset().kind == Kind::one_weight && steps >= 0);
  const bool from_start = weight.steps() == steps;
  const bool unseen = companions_[0] == nullptr || weight.steps() != steps_ + steps;
  if (from_start) {
    begin(weight, weight.preset().x_0.y + weight.preset().offset, weight.preset().v_0.y, 0);
  } else if (unseen) {
    const State& state = weight.read();
    begin(weight, state.x.y[0], state.v.y[0], weight.time());
    steps = 0;
  }
  if (of_ != weight.preset()) take_constants(weight.preset());
  Heights y;
  y.fill(std::numeric_limits<double>::quiet_NaN());
  for (std::size_t n = 0; n < companions_.size(); ++n) {
    Simulation& companion = *companions_[n];
    companion.advance(int(steps));
    if (!companion.divergence()) y[n] = companion.position(0, 0).y;
  }
  steps_ = weight.steps(), t_ = weight.time();
  y.back() = exact_weight(exact_, t_ - exact_t_).y;
  return y;
}

}  // namespace tyglab
