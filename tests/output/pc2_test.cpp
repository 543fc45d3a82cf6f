// PC2 point caches, byte for byte.
#include <doctest/doctest.h>

#include <cstring>
#include <limits>

#include "core/io/output_file.h"
#include "core/output/state_csv.h"
#include "tests/support/files.h"

namespace tyglab::pc2_test {

template <class T>
void append(std::string& bytes, T value) {
  char four[sizeof(T)];
  std::memcpy(four, &value, sizeof(T));  // the tests run on little-endian machines
  bytes.append(four, sizeof(T));
}

VectorField<double> points(std::initializer_list<double> x, std::initializer_list<double> y,
                           std::initializer_list<double> z) {
  VectorField<double> field;
  field.x = x, field.y = y, field.z = z;
  return field;
}

std::string header(std::int32_t count, std::int32_t samples) {
  std::string bytes("POINTCACHE2\0", 12);
  append<std::int32_t>(bytes, 1);
  append<std::int32_t>(bytes, count);
  append<float>(bytes, 0);
  append<float>(bytes, 1);
  append<std::int32_t>(bytes, samples);
  return bytes;
}

TEST_CASE("header and samples, byte for byte, whole after every frame") {
  const test::TemporaryFolder folder;
  const auto file = folder / "cloth.pc2.incomplete";
  PointCache cache(folder / "cloth.pc2", 2);
  std::string wanted = header(2, 0);
  CHECK(wanted.size() == 32);
  CHECK(test::read_file(file) == wanted);
  cache.add(points({1, 2}, {0.1, -0.5}, {1e-3, 1e30}));
  std::string samples;
  for (const double value : {1.0, 0.1, 1e-3, 2.0, -0.5, 1e30}) append(samples, float(value));
  CHECK(test::read_file(file) == header(2, 1) + samples);
  cache.add(points({4, 5}, {6, 7}, {8, 9}));
  for (const float value : {4.f, 6.f, 8.f, 5.f, 7.f, 9.f}) append(samples, value);
  CHECK(test::read_file(file) == header(2, 2) + samples);
  CHECK(cache.samples() == 2);
  cache.end();
  CHECK(test::read_file(folder / "cloth.pc2") == header(2, 2) + samples);
}

TEST_CASE("a point cache that cannot be written says so") {
  const test::TemporaryFolder folder;
  CHECK_THROWS_AS(PointCache(folder / "missing" / "cloth.pc2", 3), OutputError);
  CHECK_THROWS_AS(PointCache(folder.path(), 3), OutputError);
  CHECK_THROWS_AS(
      [] {
        PointCache cache("/dev/full", 2);
        cache.add(points({1, 2}, {0, 0}, {0, 0}));
      }(),
      OutputError);
}

}  // namespace tyglab::pc2_test
