#include "app/base/image.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <glm/common.hpp>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/io/output_file.h"

namespace tyglab {
namespace {

constexpr int largest_side = 4096;
// The largest that a picture of that size needs, 16 bits in each of four channels and a byte a row, with what inflating
// it takes beyond. A small PNG can hold any number of bytes more; stb_image would take memory for all of them.
constexpr std::size_t largest_block = (std::size_t(8) * largest_side + 1) * largest_side + (1 << 20);

/// Zeros, so that what a file cut short leaves out is black, and no old content of the memory.
void* decoder_memory(std::size_t bytes) {
  return bytes <= largest_block ? std::calloc(bytes, 1) : nullptr;
}

void* more_decoder_memory(void* block, std::size_t bytes) {
  return bytes <= largest_block ? std::realloc(block, bytes) : nullptr;
}

/// What the encoder of PNG takes, tens of thousands of blocks, which never looks whether it was given them:
/// std::bad_alloc is thrown past it, and all is given back then too.
class EncoderMemory {
 public:
  EncoderMemory() { present_ = this; }
  ~EncoderMemory() {
    while (first_ != nullptr) give_back(first_ + 1);
    present_ = nullptr;
  }
  EncoderMemory(const EncoderMemory&) = delete;
  EncoderMemory& operator=(const EncoderMemory&) = delete;

  static void* take(std::size_t bytes) {
    Block*& first = present_->first_;
    auto* const block = new (::operator new(sizeof(Block) + bytes)) Block{first, nullptr};
    if (first != nullptr) first->before = block;
    return (first = block) + 1;
  }
  static void* more(void* block, std::size_t old_bytes, std::size_t bytes) {
    void* const larger = take(bytes);
    if (block != nullptr) std::memcpy(larger, block, std::min(old_bytes, bytes));
    give_back(block);
    return larger;
  }
  static void give_back(void* memory) {
    if (memory == nullptr) return;
    Block* const block = static_cast<Block*>(memory) - 1;
    if (block->after != nullptr) block->after->before = block->before;
    (block->before != nullptr ? block->before->after : present_->first_) = block->after;
    ::operator delete(block);
  }

 private:
  /// Stands before what is taken.
  struct alignas(std::max_align_t) Block {
    Block *after, *before;
  };
  static thread_local EncoderMemory* present_;
  Block* first_ = nullptr;
};
thread_local EncoderMemory* EncoderMemory::present_ = nullptr;

}  // namespace
}  // namespace tyglab

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wunused-function"
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_NO_JPEG  // that of Debian 12 writes out of bounds: image.h
#define STBI_ONLY_PNG
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_MALLOC(size) tyglab::decoder_memory(size)
#define STBI_REALLOC(block, size) tyglab::more_decoder_memory(block, size)
#define STBI_FREE(block) std::free(block)
#define STBI_NO_STDIO
#include <stb_image.h>
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#define STBIW_MALLOC(size) tyglab::EncoderMemory::take(size)
#define STBIW_REALLOC_SIZED(block, old_size, size) tyglab::EncoderMemory::more(block, old_size, size)
#define STBIW_FREE(block) tyglab::EncoderMemory::give_back(block)
#include <stb_image_write.h>
#pragma GCC diagnostic pop

namespace tyglab {
namespace {

constexpr std::uintmax_t largest_file = 64 << 20;

// To find the best of five filters for each row takes twice as long, and makes no smaller a file. Set before any thread
// is there.
[[maybe_unused]] const int filter_of_rows = stbi_write_force_png_filter = 1;

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

/// What cannot hold its pixels is cut short, and is refused before memory is taken for them.
bool holds_its_pixels(std::span<const unsigned char> bytes, double pixels) {
  // The best that deflate does is 1032 to 1, on pixels of one bit; TGA's runs are of 128 pixels in two bytes.
  const bool png = bytes.size() > 1 && bytes[0] == 0x89 && bytes[1] == 'P';
  return pixels <= double(bytes.size()) * (png ? 8 * 1032 : 64);
}

/// What stb_image means by its abbreviations ("outofdata"), as far as it matters to who has the file.
const char* why_not_decoded() {
  const std::string_view reason = stbi_failure_reason();
  if (reason == "unknown image type") return "it is neither PNG, JPEG, BMP nor TGA";
  if (reason == "outofmem") return "it unpacks to more than its size in pixels";
  return "it is damaged or cut short";
}

/// PNG, BMP and TGA.
Image decode_others(std::span<const unsigned char> bytes) {
  const int length = int(bytes.size());
  int width = 0, height = 0, channels = 0;
  if (stbi_info_from_memory(bytes.data(), length, &width, &height, &channels) == 0)
    throw DecodeError(why_not_decoded());
  if (width < 1 || height < 1) throw DecodeError("it has no pixels");
  if (width > largest_side || height > largest_side) throw ImageTooLarge(width, height, largest_side);
  if (!holds_its_pixels(bytes, double(width) * height)) throw DecodeError("it is cut short");
  using Pixels = std::unique_ptr<unsigned char, decltype(&stbi_image_free)>;
  const Pixels pixels(stbi_load_from_memory(bytes.data(), length, &width, &height, &channels, 4), &stbi_image_free);
  if (pixels == nullptr) throw DecodeError(why_not_decoded());
  return {width, height, without_alpha(pixels.get(), std::size_t(width) * height)};
}

}  // namespace

ImageTooLarge::ImageTooLarge(int its_width, int its_height, int allowed_side)
    : std::runtime_error("too large"), width(its_width), height(its_height), largest_side(allowed_side) {}

std::filesystem::path write_png(const std::filesystem::path& file, const Image& image, Reach reach) {
  std::string bytes;
  const auto append = [](void* to, void* data, int size) {
    static_cast<std::string*>(to)->append(static_cast<const char*>(data), std::size_t(size));
  };
  const EncoderMemory memory;
  if (stbi_write_png_to_func(append, &bytes, image.width, image.height, 3, image.rgb.data(), image.width * 3) == 0) {
    throw OutputError("The image " + file.string() + " could not be encoded. Is there enough memory?");
  }
  return write_output(file, bytes, reach);
}

std::string packed(std::string_view bytes) {
  constexpr int quality = 8;
  const EncoderMemory memory;
  std::string copy(bytes);  // the encoder takes no constant ones
  int size = 0;
  const unsigned char* block =
      stbi_zlib_compress(reinterpret_cast<unsigned char*>(copy.data()), int(copy.size()), &size, quality);
  return {reinterpret_cast<const char*>(block), std::size_t(size)};
}

std::optional<std::string> unpacked(std::string_view bytes, std::size_t most) {
  std::string text(most, 0);
  const int size = stbi_zlib_decode_buffer(text.data(), int(most), bytes.data(), int(bytes.size()));
  if (size < 0) return std::nullopt;
  text.resize(std::size_t(size));
  return text;
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
  return decode_image(read_all(file), file.string());
}

Image decode_image(std::span<const unsigned char> bytes, const std::string& name) {
  try {
    return is_jpeg(bytes) ? decode_jpeg(bytes, largest_side) : decode_others(bytes);
  } catch (const ImageTooLarge& error) {
    throw std::runtime_error(name + " is " + std::to_string(error.width) + " x " + std::to_string(error.height) +
                             " pixels; at most " + std::to_string(error.largest_side) +
                             " a side are allowed. Make it smaller" +
                             (is_jpeg(bytes) ? "." : ", or save it as a JPEG, which is scaled down while it is read."));
  } catch (const DecodeError& error) {
    throw std::runtime_error(name + " is not an image that can be read (" + error.what() +
                             "). Use an undamaged PNG, JPEG, BMP or TGA.");
  }
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
