// Row updates in SIMD against plain loops.
#include "core/engines/cpu/row_update.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "core/integrators/scheme.h"
#include "core/simd/row_field.h"

namespace tyglab::row_update_test {

template <class R>
simd::RowField<R> random_rows(int columns, int rows, unsigned seed) {
  simd::RowField<R> made;
  made.resize(rows, simd::row_stride<R>(columns));
  std::mt19937 random(seed);
  for (int c = 0; c < 3 * rows; ++c)
    for (int j = 0; j < columns; ++j) made.row(0, c)[j] = R(std::uniform_real_distribution(-1.0, 1.0)(random));
  return made;
}

TEST_CASE_TEMPLATE("a sum is that of plain loops, and ends with the row", R, float, double) {
  for (const int columns : {1, 5, 16, 17, 40})
    for (int terms = 1; terms <= cpu::RowSum<R>::most_terms; ++terms) {
      const int count = 1 + terms % 2;
      CAPTURE(columns);
      CAPTURE(terms);
      const int stride = simd::row_stride<R>(columns);
      simd::RowField<R> rows[cpu::RowSum<R>::most_terms];
      for (unsigned n = 0; n < std::size(rows); ++n) rows[n] = random_rows<R>(columns, 2, n + 1);
      const std::vector<R> second(rows[0].row(1), rows[0].row(1) + rows[0].pitch());
      cpu::RowSums<R> sums;
      cpu::RowSum<R>& sum = sums.sum[sums.count++];
      sum.target = rows[0].row(0), sum.terms = terms;
      // The last one is the force, which is given apart.
      for (int n = 0; n < terms; ++n)
        sum.source[n] = n + 1 < terms ? rows[n].row(0) : nullptr, sum.factor[n] = R(0.3 + n);
      std::vector<double> expected;
      for (int c = 0; c < 3 * count; ++c)
        for (int j = 0; j < columns; ++j) {
          double value = 0;
          for (int n = 0; n < terms; ++n) value += double(sum.factor[n]) * double(rows[n].row(0, c)[j]);
          expected.push_back(value);
        }
      cpu::make_sums(sums, 0, rows[terms - 1].row(0), {stride, columns, count});
      if (count == 1) CHECK(std::equal(second.begin(), second.end(), rows[0].row(1)));
      for (int c = 0; c < 3 * count; ++c)
        for (int j = 0; j < stride; ++j) {
          const double wanted = j < columns ? expected[std::size_t(c * columns + j)] : 0;
          CHECK(std::abs(double(rows[0].row(0, c)[j]) - wanted) <=
                8 * terms * double(std::numeric_limits<R>::epsilon()));
        }
    }
}

TEST_CASE_TEMPLATE("the largest way of two rows is found, and what is not finite", R, float, double) {
  for (const int columns : {1, 7, 16, 33}) {
    CAPTURE(columns);
    const int stride = simd::row_stride<R>(columns), last = columns - 1;
    const auto largest = [&](auto change) {
      simd::RowField<R> x = random_rows<R>(columns, 2, 1), old = x, v = random_rows<R>(columns, 2, 2);
      change(x, v);
      alignas(simd::widest_vector) R most[simd::widest_vector / sizeof(R)] = {};
      cpu::watch_displacements(x.row(0), old.row(0), v.row(0), R(1e-3), {stride, columns, 2}, most);
      R found = 0;
      for (const R m : most) found = std::isfinite(m) ? std::max(found, m) : std::numeric_limits<R>::infinity();
      return double(found);
    };
    const double far = largest([&](auto& x, auto&) { x.row(0, 2)[last] -= R(5); });
    CHECK(far == doctest::Approx(5).epsilon(1e-6));
    const double fast = largest([&](auto&, auto& v) { v.row(0, 1)[0] = R(-3000); });
    CHECK(fast == doctest::Approx(3).epsilon(1e-6));
    CHECK(largest([&](auto& x, auto&) { x.row(1, 2)[last] += R(7); }) == doctest::Approx(7).epsilon(1e-6));
    CHECK(largest([&](auto&, auto& v) { v.row(0, 0)[last] = std::numeric_limits<R>::quiet_NaN(); }) > 1e30);
    CHECK(largest([&](auto& x, auto&) { x.row(0, 1)[last] = -std::numeric_limits<R>::infinity(); }) > 1e30);
  }
}

TEST_CASE("sums of a row are made one after another, at the row's offset") {
  constexpr int columns = 33;
  const int stride = simd::row_stride<float>(columns), pitch = 3 * stride;
  simd::RowField<float> a, b;
  a.resize(2, stride), b.resize(2, stride);
  for (int c = 0; c < 3; ++c)
    for (int j = 0; j < columns; ++j) a.row(1, c)[j] = float(c * 100 + j);
  cpu::RowSums<float> sums;
  sums.count = 2;
  sums.sum[0] = {.target = b.row(0), .terms = 1, .source = {a.row(0)}, .factor = {2}};
  sums.sum[1] = {.target = a.row(0), .terms = 2, .source = {a.row(0), b.row(0)}, .factor = {1, 10}};
  cpu::make_sums<float>(sums, pitch, nullptr, {stride, columns});
  for (int c = 0; c < 3; ++c)
    for (int j = 0; j < columns; ++j) {
      CHECK(b.row(1, c)[j] == float(2 * (c * 100 + j)));
      CHECK(a.row(1, c)[j] == float(21 * (c * 100 + j)));
      CHECK(a.row(0, c)[j] == 0);
    }
}

TEST_CASE("no method adds more terms than a row's sum can take, nor makes more sums") {
  for (const Scheme& scheme : schemes())
    for (const Sweep& sweep : scheme.sweeps)
      for (const auto* list : {&sweep.before, &sweep.assignments}) {
        CHECK(int(list->size()) <= cpu::RowSums<float>::most);
        for (const Assignment& assignment : *list)
          CHECK(int(assignment.terms.size()) <= cpu::RowSum<float>::most_terms);
      }
}

}  // namespace tyglab::row_update_test
