#include "tests/bench/contact.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <unordered_map>

#include "core/contact/self_contact.h"
#include "core/simulation.h"
#include "tests/bench/throughput.h"

namespace tyglab {
namespace {

constexpr int crumpling_steps = 400;  // until the sheet is full of folds
constexpr int steps_of_round = 20;

/// ns of a particle.
template <class Work>
double timed(int particles, Work work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count() / particles;
}

double timed_steps(Simulation& simulation, int steps) {
  return timed(simulation.lattice().size(), [&] { simulation.advance(steps); }) / steps;
}

/// The default cloth, hung by its top row.
Preset swinging(int side, const char* self) {
  Preset preset;
  preset.rows = preset.columns = side;
  preset.pins.mode = Pins::Mode::top_row, preset.self = self;
  return preset;
}

double bytes_of(const Simulation& simulation) {
  return double(simulation.engine().bytes()) / simulation.lattice().size();
}

void measure_apart(ContactRow& row) {
  Simulation off(swinging(row.side, "off")), guarded(swinging(row.side, "guard"));
  off.advance(steps_of_round), guarded.advance(steps_of_round);
  std::vector<double> times, ratios;
  for (int n = 0; n < row.rounds; ++n) {
    times.push_back(timed_steps(off, steps_of_round));
    ratios.push_back(timed_steps(guarded, steps_of_round) / times.back());
  }
  row.ns_off = median(times), row.ns_apart = row.ns_off * median(ratios);
  row.bytes_apart = bytes_of(guarded) - bytes_of(off);
}

void measure_pile(ContactRow& row) {
  const Preset preset = crumpling_sheet(row.side);
  Simulation pile(preset);
  Preset without = preset;
  without.self = "off";
  pile.load(crumpling_start(preset));
  pile.advance(crumpling_steps);
  std::vector<double> times, of_grid;
  std::int64_t pairs = 0;
  for (int n = 0; n < row.rounds; ++n) {
    times.push_back(timed_steps(pile, steps_of_round));
    const State state = pile.read();
    std::vector<glm::dvec3> x;
    for (std::size_t p = 0; p < state.x.x.size(); ++p) x.emplace_back(state.x.x[p], state.x.y[p], state.x.z[p]);
    of_grid.push_back(
        timed(int(x.size()), [&] { pairs = pairs_by_hash_grid(x, pile.lattice(), 2 * contact_thickness(preset)); }));
  }
  if (pile.divergence()) throw std::runtime_error("the sheet of bench contact diverged, so its times mean nothing");
  row.ns_pile = median(times), row.ns_hash_grid = median(of_grid);
  row.pairs = double(pairs) / pile.lattice().size();
  row.bytes_pile = bytes_of(pile) - bytes_of(Simulation(without));
}

/// Particles, edges or triangles by the cell of their middle.
class HashGrid {
 public:
  explicit HashGrid(double cell) : cell_(cell) {}
  void add(const glm::dvec3& at, int which) { cells_[key(place(at))].push_back(which); }
  template <class Visit>
  void visit(const glm::dvec3& around, Visit visit) const {
    const std::array<std::int64_t, 3> at = place(around);
    for (int n = 0; n < 27; ++n) {
      const auto found = cells_.find(key({at[0] + n / 9 - 1, at[1] + n / 3 % 3 - 1, at[2] + n % 3 - 1}));
      if (found == cells_.end()) continue;
      for (const int which : found->second) visit(which);
    }
  }

 private:
  using Place = std::array<std::int64_t, 3>;
  Place place(const glm::dvec3& at) const {
    return {std::int64_t(std::floor(at.x / cell_)), std::int64_t(std::floor(at.y / cell_)),
            std::int64_t(std::floor(at.z / cell_))};
  }
  /// Cells so far apart that they share a key are not met: 2^21 a side.
  static std::uint64_t key(const Place& at) {
    constexpr std::uint64_t mask = (1 << 21) - 1;
    return (std::uint64_t(at[0]) & mask) << 42 | (std::uint64_t(at[1]) & mask) << 21 | (std::uint64_t(at[2]) & mask);
  }

  double cell_;
  std::unordered_map<std::uint64_t, std::vector<int>> cells_;
};

/// Edges and triangles of a cloth, by their particles.
struct ClothParts {
  std::vector<std::array<int, 2>> edges;
  std::vector<std::array<int, 3>> triangles;

  explicit ClothParts(const Lattice& lattice) {
    const int columns = lattice.columns;
    for (int i = 0; i < lattice.rows; ++i)
      for (int j = 0; j < columns; ++j) {
        const int at = i * columns + j;
        if (j + 1 < columns) edges.push_back({at, at + 1});
        if (i + 1 < lattice.rows) edges.push_back({at, at + columns});
        if (i + 1 == lattice.rows || j + 1 == columns) continue;
        const bool odd = (i + j) % 2 != 0;
        edges.push_back(odd ? std::array{at + 1, at + columns} : std::array{at, at + columns + 1});
        for (const auto& corners : quad_triangles[odd ? 1 : 0]) {
          auto& triangle = triangles.emplace_back();
          for (std::size_t n = 0; n < 3; ++n) triangle[n] = at + corners[n].di * columns + corners[n].dj;
        }
      }
  }
};

template <std::size_t n, std::size_t m>
bool share(const std::array<int, n>& a, const std::array<int, m>& b) {
  return std::any_of(a.begin(), a.end(), [&](int one) { return std::find(b.begin(), b.end(), one) != b.end(); });
}

}  // namespace

std::int64_t pairs_by_hash_grid(const std::vector<glm::dvec3>& x, const Lattice& lattice, double below) {
  const ClothParts parts(lattice);
  const auto at = [&](int particle) { return x[std::size_t(particle)]; };
  double longest = 0;
  for (const auto& [a, b] : parts.edges) longest = std::max(longest, glm::distance(at(a), at(b)));
  // No point of an edge or triangle is farther from its middle than that of an edge's length, or two thirds of it.
  const double cell = longest + below;
  HashGrid particles(cell), edges(cell);
  for (int p = 0; p < lattice.size(); ++p) particles.add(at(p), p);
  const auto middle = [&](const std::array<int, 2>& edge) { return (at(edge[0]) + at(edge[1])) / 2.0; };
  for (std::size_t n = 0; n < parts.edges.size(); ++n) edges.add(middle(parts.edges[n]), int(n));
  std::int64_t pairs = 0;
  const auto count = [&](const Gap& gap) { pairs += glm::dot(gap.between, gap.between) < below * below; };
  for (const auto& triangle : parts.triangles) {
    const std::array<glm::dvec3, 3> corners{at(triangle[0]), at(triangle[1]), at(triangle[2])};
    particles.visit((corners[0] + corners[1] + corners[2]) / 3.0, [&](int p) {
      if (!share(triangle, std::array{p})) count(gap_to_triangle(at(p), corners));
    });
  }
  for (std::size_t n = 0; n < parts.edges.size(); ++n) {
    const auto& edge = parts.edges[n];
    edges.visit(middle(edge), [&](int other) {
      const auto& second = parts.edges[std::size_t(other)];
      if (other > int(n) && !share(edge, second))
        count(gap_of_edges({at(edge[0]), at(edge[1])}, {at(second[0]), at(second[1])}));
    });
  }
  return pairs;
}

Preset crumpling_sheet(int side) {
  Preset preset;
  preset.rows = preset.columns = side;
  preset.L = 0.02, preset.m = 2e-4, preset.k_s = 60, preset.k_b = 1, preset.k_d = 1e-3, preset.g = 0;
  preset.dt = 2e-4, preset.pins.mode = Pins::Mode::none, preset.self = "guard";
  return preset;
}

State crumpling_start(const Preset& preset) {
  State state = start_state(preset);
  const auto middle = [](const Array<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / double(values.size());
  };
  const glm::dvec3 center(middle(state.x.x), middle(state.x.y), middle(state.x.z));
  // Towards the middle, so that every part is pressed together alike, and out of the plane in short waves.
  constexpr double pressing = 6, height = 1;  // 1/s, m/s
  for (std::size_t p = 0; p < state.v.x.size(); ++p) {
    const double i = double(p / std::size_t(preset.columns)), j = double(p % std::size_t(preset.columns));
    state.v.x[p] = -pressing * (state.x.x[p] - center.x), state.v.y[p] = -pressing * (state.x.y[p] - center.y);
    state.v.z[p] = -pressing * (state.x.z[p] - center.z) + height * (std::sin(0.7 * i + 0.2 * j) + std::cos(0.9 * j));
  }
  return state;
}

ContactRow measure_contact(int side, int rounds) {
  ContactRow row;
  row.side = side, row.rounds = rounds;
  measure_apart(row);
  measure_pile(row);
  return row;
}

}  // namespace tyglab
