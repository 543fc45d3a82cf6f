#include "app/render/image.h"

#include <algorithm>
#include <fstream>
#include <glm/common.hpp>
#include <stdexcept>
#include <string>

#include "core/io/destination.h"
#include "core/io/files.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wunused-function"
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_MAX_DIMENSIONS 8192
#define STBI_NO_STDIO
#include <stb_image.h>
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <stb_image_write.h>
#pragma GCC diagnostic pop

namespace tyglab {
namespace {

constexpr std::uintmax_t largest_file = 64 << 20;
constexpr int largest_side = STBI_MAX_DIMENSIONS;

std::vector<unsigned char> read_all(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) {
    throw std::runtime_error("There is no image " + file.string() + ". Check the name and the folder.");
  }
  if (!std::filesystem::is_regular_file(file, error)) {
    throw std::runtime_error(file.string() + " is not a file. Choose a PNG, JPEG, BMP or TGA image.");
  }
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error || size > largest_file) {
    throw std::runtime_error(file.string() +
                             " is larger than 64 MB. Save a smaller image; 2048 pixels a side is "
                             "plenty.");
  }
  std::vector<unsigned char> bytes(size);
  std::ifstream stream(file, std::ios::binary);
  if (!stream.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(size))) {
    throw std::runtime_error(file.string() + " cannot be read. Check its permissions.");
  }
  return bytes;
}

/// Lays four-channel pixels over white.
std::vector<std::uint8_t> without_alpha(const unsigned char* rgba, std::size_t pixels) {
  std::vector<std::uint8_t> rgb(pixels * 3);
  for (std::size_t p = 0; p < pixels; ++p) {
    const int alpha = rgba[4 * p + 3];
    for (std::size_t c = 0; c < 3; ++c) {
      rgb[3 * p + c] = std::uint8_t((rgba[4 * p + c] * alpha + 255 * (255 - alpha) + 127) / 255);
    }
  }
  return rgb;
}

}  // namespace

std::filesystem::path write_png(const std::filesystem::path& file, const Image& image, Reach reach) {
  std::string bytes;
  const auto append = [](void* to, void* data, int size) {
    static_cast<std::string*>(to)->append(static_cast<const char*>(data), std::size_t(size));
  };
  if (stbi_write_png_to_func(append, &bytes, image.width, image.height, 3, image.rgb.data(), image.width * 3) == 0) {
    throw OutputError("The image " + file.string() + " could not be encoded. Is there enough memory?");
  }
  return write_output(file, bytes, reach);
}

Image cropped(const Image& image, glm::ivec2 lo, glm::ivec2 hi) {
  lo = glm::max(lo, glm::ivec2(0)), hi = glm::min(hi, glm::ivec2(image.width, image.height));
  Image part{std::max(hi.x - lo.x, 0), std::max(hi.y - lo.y, 0), {}};
  for (int y = lo.y; y < hi.y; ++y) {
    const auto row = image.rgb.begin() + std::ptrdiff_t(3) * (std::ptrdiff_t(y) * image.width + lo.x);
    part.rgb.insert(part.rgb.end(), row, row + std::ptrdiff_t(3) * part.width);
  }
  return part;
}

Image read_image(const std::filesystem::path& file) {
  const std::vector<unsigned char> bytes = read_all(file);
  const int length = int(bytes.size());
  int width = 0, height = 0, channels = 0;
  if (stbi_info_from_memory(bytes.data(), length, &width, &height, &channels) == 0) {
    throw std::runtime_error(file.string() + " is not an image that can be read (" + stbi_failure_reason() +
                             "). Use PNG, JPEG, BMP or TGA, at most " + std::to_string(largest_side) +
                             " pixels a side.");
  }
  if (width > largest_side || height > largest_side) {
    throw std::runtime_error(file.string() + " is " + std::to_string(width) + " x " + std::to_string(height) +
                             " pixels; at most " + std::to_string(largest_side) +
                             " a side are allowed. Make it smaller.");
  }
  unsigned char* const pixels = stbi_load_from_memory(bytes.data(), length, &width, &height, &channels, 4);
  if (pixels == nullptr) {
    throw std::runtime_error(file.string() + " is damaged (" + stbi_failure_reason() +
                             "). Open it in an image editor and save it again.");
  }
  Image image{width, height, without_alpha(pixels, std::size_t(width) * height)};
  stbi_image_free(pixels);
  return image;
}

std::vector<Image> halvings(Image image) {
  std::vector<Image> list;
  list.push_back(std::move(image));
  while (list.back().width > 1 || list.back().height > 1) {
    const Image& whole = list.back();
    Image half{std::max(whole.width / 2, 1), std::max(whole.height / 2, 1), {}};
    half.rgb.resize(std::size_t(half.width) * half.height * 3);
    const std::size_t right = whole.width > 1 ? 3 : 0, below = whole.height > 1 ? std::size_t(whole.width) * 3 : 0;
    std::uint8_t* to = half.rgb.data();
    for (int y = 0; y < half.height; ++y) {
      const std::uint8_t* from = whole.rgb.data() + 2 * y * below;
      for (int x = 0; x < half.width; ++x, from += 2 * right)
        for (std::size_t c = 0; c < 3; ++c)
          *to++ = std::uint8_t((from[c] + from[c + right] + from[c + below] + from[c + right + below] + 2) / 4);
    }
    list.push_back(std::move(half));
  }
  return list;
}

}  // namespace tyglab
