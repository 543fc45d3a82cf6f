#include "core/output/point_cache.h"

#include <bit>
#include <cerrno>
#include <cstring>

#include "core/io/destination.h"
#include "core/io/files.h"
#include "core/io/text.h"

namespace tyglab {
namespace {

constexpr long count_offset = 28;  // of the number of samples within the header

/// Appends the four bytes of an int32 or a float32, lowest first, whatever the machine's own order.
template <class T>
void append_little_endian(std::string& bytes, T value) {
  static_assert(sizeof(T) == 4);
  const auto bits = std::bit_cast<std::uint32_t>(value);
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<char>(bits >> shift & 0xff));
}

}  // namespace

PointCache::PointCache(const std::filesystem::path& file, std::int32_t points)
    : file_(file), out_(is_standard_output(file) ? std::tmpfile() : std::fopen(file.c_str(), "wb")), points_(points) {
  if (!out_) fail();
  if (std::fseek(out_.get(), 0, SEEK_SET) != 0)
    throw OutputError(file_.string() +
                      ": a point cache has its sample count at the start, so it cannot be piped; name a file, or -");
  std::string header("POINTCACHE2");
  header.push_back('\0');
  append_little_endian<std::int32_t>(header, 1);
  append_little_endian<std::int32_t>(header, points_);
  append_little_endian<float>(header, 0);
  append_little_endian<float>(header, 1);
  append_little_endian<std::int32_t>(header, 0);
  put(header);
}

void PointCache::add(const VectorField<double>& x) {
  sample_.clear();
  for (std::size_t p = 0; p < std::size_t(points_); ++p)
    for (const double value : {x.x[p], x.y[p], x.z[p]}) append_little_endian(sample_, float_coordinate(value));
  put(sample_);
  ++samples_;
  std::string count;
  append_little_endian(count, samples_);
  if (std::fseek(out_.get(), count_offset, SEEK_SET) != 0) fail();
  put(count);
  if (std::fseek(out_.get(), 0, SEEK_END) != 0) fail();
}

void PointCache::finish() {
  if (!is_standard_output(file_)) return;
  std::rewind(out_.get());
  std::string part(std::size_t{1} << 20, '\0');
  while (const std::size_t size = std::fread(part.data(), 1, part.size(), out_.get()))
    write_output(file_, std::string_view(part).substr(0, size));
  if (std::ferror(out_.get()) != 0) fail();
}

void PointCache::put(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), out_.get()) != bytes.size() || std::fflush(out_.get()) != 0) fail();
}

void PointCache::fail() const {
  const std::string why = std::strerror(errno);
  throw OutputError((is_standard_output(file_) ? "the temporary file of --pc2 -" : file_.string()) +
                    ": cannot be written: " + why);
}

}  // namespace tyglab
