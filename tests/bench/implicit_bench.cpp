#include "tests/bench/implicit_bench.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/cloth/state.h"
#include "core/engines/implicit/stiff_stage.h"
#include "core/simd/row_field.h"
#include "core/simulation.h"
#include "tests/bench/throughput.h"

namespace tyglab {
namespace {

using Field = simd::RowField<double>;

Field field_of(const VectorField<double>& from, const Lattice& lattice) {
  Field field;
  field.resize(lattice.rows + 3, simd::row_stride<double>(lattice.columns));
  const Array<double>* components[] = {&from.x, &from.y, &from.z};
  for (int i = 0; i < lattice.rows; ++i)
    for (int c = 0; c < 3; ++c)
      std::copy_n(components[c]->data() + std::ptrdiff_t(i) * lattice.columns, lattice.columns, field.row(i, c));
  return field;
}

/// The largest |x_ij|/L - 1 of a stretch spring.
double largest_strain(const Field& x, const Lattice& lattice, double L) {
  double most = 0;
  for (int d = 0; d < stretch_directions; ++d)
    for (int i = 0; i < lattice.rows; ++i)
      for (int j = 0; j < lattice.columns; ++j) {
        if (!lattice.has_spring(d, i, j)) continue;
        const Direction& to = directions[std::size_t(d)];
        double squared = 0;
        for (int c = 0; c < 3; ++c) {
          const double along = x.row(i + to.di, c)[j + to.dj] - x.row(i, c)[j];
          squared += along * along;
        }
        most = std::max(most, std::sqrt(squared) / (to.rest * L) - 1);
      }
  return most;
}

/// Of the exact solution of implicit Euler's step from a state.
double exact_strain(const Preset& preset, const State& state) {
  const Lattice lattice = lattice_of(preset);
  const Tears tears(lattice);
  const std::vector<std::uint8_t> fixed = pinned_particles(preset);
  const Field x = field_of(state.x, lattice), v = field_of(state.v, lattice);
  Field end = v;
  implicit::StiffStage stage;
  implicit::Crew alone;
  SolveCounts counts;
  stage.solve(implicit::StiffTask<double>{preset, lattice, tears, fixed, preset.dt, x.row(0), v.row(0), nullptr,
                                          x.row(0), end.row(0), x.pitch() / 3, [] { return false; },
                                          [](double) { return false; }, [](double) {}, alone, 1e-9},
              counts);
  for (std::size_t n = 0; n < end.all().size(); ++n) end.all()[n] = x.all()[n] + preset.dt * end.all()[n];
  return largest_strain(end, lattice, preset.L);
}

}  // namespace

std::vector<Preset> implicit_cases(bool quick) {
  std::vector<Preset> cases;
  for (const int side : {32, 64, 128, 256}) {
    if (quick && side > 128) break;
    for (const double k_s : {50.0, 1e3, 1e5})
      for (const double dt : {1.0 / 60, 1.0 / 240}) {
        if (quick && dt < 1.0 / 60) continue;
        Preset& p = cases.emplace_back();
        p.rows = p.columns = side, p.k_s = k_s, p.dt = dt;
        p.integrator = "implicit_euler", p.precision = Precision::double_;
      }
  }
  return cases;
}

ImplicitRow measure_implicit(const Preset& preset, int threads) {
  ImplicitRow row;
  row.preset = preset;
  Simulation simulation(preset, threads);
  row.threads = simulation.engine().threads();
  row.steps = preset.rows > 64 ? 3 : 10;
  simulation.advance(1);
  const SolveCounts before = simulation.engine().solves();
  std::vector<double> ms;
  State state;
  for (int n = 0; n < row.steps; ++n) {
    if (n == row.steps - 1) state = simulation.read();
    const auto begun = std::chrono::steady_clock::now();
    simulation.advance(1);
    ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun).count());
  }
  const SolveCounts after = simulation.engine().solves();
  row.ms_per_step = median(ms);
  row.newton_per_step = double(after.newton - before.newton) / row.steps;
  row.linear_per_step = double(after.linear - before.linear) / row.steps;
  row.residual = after.worst_residual, row.converged = after.unconverged == 0;
  row.bytes_per_particle = double(simulation.engine().bytes()) / lattice_of(preset).size();
  const double exact = exact_strain(preset, state);
  const double strain = largest_strain(field_of(simulation.read().x, lattice_of(preset)), lattice_of(preset), preset.L);
  row.strain_error = exact > 0 ? std::abs(strain - exact) / exact : 0;
  return row;
}

}  // namespace tyglab
