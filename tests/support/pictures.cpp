#include "tests/support/pictures.h"

#include <array>
#include <cstdio>  // jpeglib.h needs it
#include <cstdlib>

#include <jpeglib.h>

namespace tyglab::test {
namespace {

std::string number(std::uint32_t value, int bytes, bool little_endian) {
  std::string text;
  for (int k = 0; k < bytes; ++k) text += char(value >> 8 * (little_endian ? k : bytes - 1 - k));
  return text;
}

std::string little(std::uint32_t value, int bytes) {
  return number(value, bytes, true);
}

std::string big(std::uint32_t value) {
  return number(value, 4, false);
}

std::string noise(Random& random, int bytes) {
  std::string text;
  for (int k = 0; k < bytes; ++k) text += char(random.below(256));
  return text;
}

/// An EXIF segment's data, with a tag before the orientation.
std::string exif(int orientation, bool little_endian) {
  const auto n = [&](std::uint32_t value, int bytes) { return number(value, bytes, little_endian); };
  const auto entry = [&](std::uint32_t tag, std::uint32_t value) {
    constexpr std::uint32_t short_type = 3;
    return n(tag, 2) + n(short_type, 2) + n(1, 4) + n(value, 2) + n(0, 2);
  };
  return std::string("Exif\0\0", 6) + (little_endian ? "II" : "MM") + n(42, 2) + n(8, 4) + n(2, 2) + entry(0x0100, 7) +
         entry(0x0112, std::uint32_t(orientation)) + n(0, 4);
}

/// A zlib stream that stores.
std::string stored(const std::string& bytes) {
  std::uint32_t a = 1, b = 0;
  for (const unsigned char byte : bytes) a = (a + byte) % 65521, b = (b + a) % 65521;
  return "\x78\x01\x01" + little(std::uint32_t(bytes.size()), 2) + little(~std::uint32_t(bytes.size()), 2) + bytes +
         big(b << 16 | a);
}

std::string png_chunk(const std::string& name, const std::string& data) {
  std::uint32_t crc = ~0u;
  for (const unsigned char byte : name + data) {
    crc ^= byte;
    for (int k = 0; k < 8; ++k) crc = crc & 1 ? crc >> 1 ^ 0xEDB88320u : crc >> 1;
  }
  return big(std::uint32_t(data.size())) + name + data + big(~crc);
}

}  // namespace

std::string jpeg(const Image& image, const JpegKind& kind) {
  jpeg_compress_struct info = {};
  jpeg_error_mgr errors;
  info.err = jpeg_std_error(&errors);
  jpeg_create_compress(&info);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&info, &bytes, &size);
  info.image_width = JDIMENSION(image.width), info.image_height = JDIMENSION(image.height);
  info.input_components = kind.channels;
  info.in_color_space = kind.channels == 1 ? JCS_GRAYSCALE : kind.channels == 3 ? JCS_RGB : JCS_CMYK;
  jpeg_set_defaults(&info);
  jpeg_set_quality(&info, 95, TRUE);
  if (kind.progressive) jpeg_simple_progression(&info);
  jpeg_start_compress(&info, TRUE);
  if (kind.orientation != 0) {
    const std::string data = exif(kind.orientation, kind.little_endian);
    jpeg_write_marker(&info, JPEG_APP0 + 1, reinterpret_cast<const JOCTET*>(data.data()), unsigned(data.size()));
  }
  std::vector<unsigned char> row(std::size_t(image.width) * kind.channels);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < kind.channels; ++c)
        row[std::size_t(x) * kind.channels + c] =
            c == 3 ? 255 : image.rgb[std::size_t(3) * (std::size_t(y) * image.width + x) + c];
    unsigned char* start = row.data();
    jpeg_write_scanlines(&info, &start, 1);
  }
  jpeg_finish_compress(&info);
  jpeg_destroy_compress(&info);
  std::string text(reinterpret_cast<const char*>(bytes), size);
  std::free(bytes);
  return text;
}

std::string png(Random& random, int width, int height, int color_type, int depth) {
  constexpr std::array<int, 7> channels{1, 0, 3, 1, 2, 0, 4};
  std::string rows, palette;
  const int row_bytes = (width * channels[std::size_t(color_type)] * depth + 7) / 8;
  constexpr int filters = 5;
  for (int y = 0; y < height; ++y) rows += char(y % filters) + noise(random, row_bytes);
  if (color_type == 3)
    palette = png_chunk("PLTE", noise(random, 3 << depth)) + png_chunk("tRNS", noise(random, 1 << depth));
  const std::string header = number(std::uint32_t(width), 4, false) + number(std::uint32_t(height), 4, false) +
                             char(depth) + char(color_type) + std::string(3, '\0');
  return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) + palette + png_chunk("IDAT", stored(rows)) +
         png_chunk("IEND", "");
}

std::string tga(Random& random, int width, int height, int type, int bits) {
  const bool palette = type % 8 == 1, packed = type >= 8;
  constexpr int colors = 256;
  std::string text = std::string(1, '\0') + char(palette) + char(type) + little(0, 2) +
                     little(palette ? colors : 0, 2) + char(palette ? 24 : 0) + little(0, 4) +
                     little(std::uint32_t(width), 2) + little(std::uint32_t(height), 2) + char(bits) + '\0';
  if (palette) text += noise(random, 3 * colors);
  if (!packed) return text + noise(random, width * height * bits / 8);
  for (int left = width * height; left > 0;) {
    const int count = std::min(left, 1 + random.below(9));
    const bool run = random.below(2) == 0;
    text += char((run ? 0x80 : 0) | (count - 1)) + noise(random, (run ? 1 : count) * bits / 8);
    left -= count;
  }
  return text;
}

std::string bmp(Random& random, int width, int height, int bits) {
  const int colors = bits <= 8 ? 1 << bits : 0, row_bytes = (width * bits + 31) / 32 * 4;
  const std::uint32_t begin = 54 + 4 * std::uint32_t(colors), size = std::uint32_t(row_bytes * height);
  return "BM" + little(begin + size, 4) + little(0, 4) + little(begin, 4) + little(40, 4) +
         little(std::uint32_t(width), 4) + little(std::uint32_t(height), 4) + little(1, 2) +
         little(std::uint32_t(bits), 2) + little(0, 4) + little(size, 4) + little(2835, 4) + little(2835, 4) +
         little(std::uint32_t(colors), 4) + little(0, 4) + noise(random, 4 * colors) + noise(random, int(size));
}

std::vector<std::string> pictures_of_all_kinds(int side) {
  Random random(17);
  std::vector<std::string> all;
  Image image{side + 3, side, {}};
  const std::string values = noise(random, image.width * image.height * 3);
  image.rgb.assign(values.begin(), values.end());
  for (const bool progressive : {false, true})
    for (const int channels : {1, 3, 4}) all.push_back(jpeg(image, {progressive, channels, channels + 2, progressive}));
  for (const auto& [color_type, depth] : {std::pair{0, 1}, {0, 8}, {0, 16}, {2, 8}, {3, 4}, {4, 8}, {6, 8}, {6, 16}})
    all.push_back(png(random, side + 1, side, color_type, depth));
  for (const auto& [type, bits] : {std::pair{1, 8}, {2, 16}, {2, 24}, {2, 32}, {3, 8}, {9, 8}, {10, 24}, {11, 8}})
    all.push_back(tga(random, side + 1, side, type, bits));
  for (const int bits : {1, 4, 8, 16, 24, 32}) all.push_back(bmp(random, side + 1, side, bits));
  return all;
}

}  // namespace tyglab::test
