#include "core/output/point_cache.h"

#include <bit>

#include "core/io/text.h"

namespace tyglab {
namespace {

constexpr std::uint64_t count_offset = 28;  // of the number of samples within the header

/// Appends the four bytes of an int32 or a float32, lowest first, whatever the machine's own order.
template <class T>
void append_little_endian(std::string& bytes, T value) {
  static_assert(sizeof(T) == 4);
  const auto bits = std::bit_cast<std::uint32_t>(value);
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<char>(bits >> shift & 0xff));
}

}  // namespace

PointCache::PointCache(const std::filesystem::path& file, std::int32_t points)
    : out_(file, OutputFile::Order::any), points_(points) {
  std::string header("POINTCACHE2");
  header.push_back('\0');
  append_little_endian<std::int32_t>(header, 1);
  append_little_endian<std::int32_t>(header, points_);
  append_little_endian<float>(header, 0);
  append_little_endian<float>(header, 1);
  append_little_endian<std::int32_t>(header, 0);
  out_.write(header);
}

void PointCache::add(const VectorField<double>& x) {
  sample_.clear();
  for (std::size_t p = 0; p < std::size_t(points_); ++p)
    for (const double value : {x.x[p], x.y[p], x.z[p]}) append_little_endian(sample_, float_coordinate(value));
  out_.write(sample_);
  ++samples_;
  std::string count;
  append_little_endian(count, samples_);
  out_.write_at(count_offset, count);
  out_.keep();
}

}  // namespace tyglab
