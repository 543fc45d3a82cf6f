// The product with the linearised force, row by row in SIMD, against spring after spring in plain loops.
#include "core/engines/implicit/stiffness.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <vector>

#include "core/cloth/lattice.h"
#include "core/simd/row_field.h"

namespace tyglab::implicit::stiffness_test {

using simd::RowField, simd::row_stride;

/// Random coefficients for every spring of a lattice, and none beyond it.
template <class R>
struct Operator {
  Operator(int rows, int columns, unsigned seed)
      : lattice{rows, columns},
        stride(row_stride<R>(columns)),
        coefficients(std::size_t(rows) * coefficient_pitch(stride), R(0)) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(-1, 1);
    for (int i = 0; i < rows; ++i)
      for (int d = 0; d < springs_of_a_particle; ++d)
        for (int j = 0; j < columns; ++j)
          if (lattice.has_spring(d, i, j))
            for (int part = 0; part < spring_parts; ++part) at(d, part, i, j) = R(any(random));
  }

  /// Springs to the lower left stand at the column of their lower end.
  R& at(int d, int part, int i, int j) {
    return coefficients[std::size_t(i * coefficient_pitch(stride) + (d * spring_parts + part) * stride + j +
                                    std::min(0, directions[std::size_t(d)].dj))];
  }

  Lattice lattice;
  int stride;
  std::vector<R> coefficients;
};

template <class R>
void check_product(int rows, int columns, double tolerance) {
  CAPTURE(rows);
  CAPTURE(columns);
  Operator<R> a(rows, columns, 7);
  RowField<R> p, q;
  p.resize(rows + 3, a.stride), q.resize(rows + 3, a.stride);
  std::vector<double> expected(std::size_t(rows) * columns * 3, 0);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int i = 0; i < rows; ++i)
    for (int c = 0; c < 3; ++c)
      for (int j = 0; j < columns; ++j) p.row(i, c)[j] = R(any(random));
  std::fill(q.all().begin(), q.all().end(), R(9));  // what a product before it left
  const auto to = [&](int i, int j, int c) -> double& { return expected[(std::size_t(i) * columns + j) * 3 + c]; };
  constexpr double mass = 1.5;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      for (int c = 0; c < 3; ++c) to(i, j, c) += mass * double(p.row(i, c)[j]);
      for (int d = 0; d < springs_of_a_particle; ++d) {
        if (!a.lattice.has_spring(d, i, j)) continue;
        const int oi = i + directions[std::size_t(d)].di, oj = j + directions[std::size_t(d)].dj;
        double apart[3], along = 0;
        for (int c = 0; c < 3; ++c) {
          apart[c] = double(p.row(oi, c)[oj]) - double(p.row(i, c)[j]);
          along += double(a.at(d, c, i, j)) * apart[c];
        }
        for (int c = 0; c < 3; ++c) {
          const double f = double(a.at(d, 3, i, j)) * apart[c] + double(a.at(d, c, i, j)) * along;
          to(i, j, c) -= f, to(oi, oj, c) += f;
        }
      }
    }
  double inner = 0, expected_inner = 0;
  for (int i = 0; i < rows; ++i)
    inner += multiply_row(ProductTask<R>{a.coefficients.data() + i * coefficient_pitch(a.stride), p.row(i), q.row(i),
                                         a.stride, columns, i == 0, mass});
  for (int i = 0; i < rows; ++i)
    for (int c = 0; c < 3; ++c)
      for (int j = 0; j < columns; ++j) {
        CHECK(double(q.row(i, c)[j]) == doctest::Approx(to(i, j, c)).epsilon(tolerance));
        expected_inner += to(i, j, c) * double(p.row(i, c)[j]);
      }
  CHECK(inner == doctest::Approx(expected_inner).epsilon(10 * tolerance));
}

TEST_CASE("the product is the sum over all springs, in every shape of cloth") {
  for (const int rows : {2, 3, 7})
    for (const int columns : {1, 2, 3, 16, 17, 40}) {
      check_product<double>(rows, columns, 1e-12);
      check_product<float>(rows, columns, 2e-4);
    }
}

TEST_CASE("an update moves along the direction and preconditions what is left, but for fixed particles") {
  constexpr int columns = 5;
  const int stride = row_stride<double>(columns);
  const std::size_t size = std::size_t(3) * stride;
  Array<double> p(size, 0), q(size, 0), d(size, 0), r(size, 0), z(size, 7), blocks(2 * size, 0);
  for (int j = 0; j < columns; ++j)
    for (int c = 0; c < 3; ++c) {
      const std::size_t n = std::size_t(c) * stride + j;
      p[n] = j + c, q[n] = 1, r[n] = 2 * c + j, d[n] = 0.5;
      if (j != 3) blocks[n] = 2, blocks[n + size] = 0.25 * (c + 1);  // the particle at 3 is fixed
    }
  const Residual sums = update_row(
      UpdateTask<double>{p.data(), q.data(), blocks.data(), d.data(), r.data(), z.data(), stride, columns, 2});
  double squared = 0, preconditioned = 0;
  for (int j = 0; j < columns; ++j) {
    const double x = j - 2., y = j, w = j + 2.;  // r - 2 q
    const double left[] = {j == 3 ? 0 : x, j == 3 ? 0 : y, j == 3 ? 0 : w};
    const double scaled[] = {2 * left[0] + 0.75 * left[1] + 0.5 * left[2],
                             0.75 * left[0] + 2 * left[1] + 0.25 * left[2],
                             0.5 * left[0] + 0.25 * left[1] + 2 * left[2]};
    for (int c = 0; c < 3; ++c) {
      const std::size_t n = std::size_t(c) * stride + j;
      CHECK(d[n] == doctest::Approx(0.5 + 2 * (j + c)));
      CHECK(r[n] == doctest::Approx(left[c]));
      CHECK(z[n] == doctest::Approx(j == 3 ? 0 : scaled[c]));
      squared += left[c] * left[c], preconditioned += left[c] * z[n];
    }
  }
  CHECK(sums.squared == doctest::Approx(squared));
  CHECK(sums.preconditioned == doctest::Approx(preconditioned));
}

}  // namespace tyglab::implicit::stiffness_test
