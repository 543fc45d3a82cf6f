// Pictures in memory and in files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/output_file.h"

namespace tyglab {

/// 8-bit sRGB, three bytes a pixel, rows from the top, no padding.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

/// Writes a PNG (write_output). Returns where it is. Throws OutputError.
std::filesystem::path write_png(const std::filesystem::path& file, const Image& image, Reach reach = Reach::whole);

/// The part between two corners, in pixels from the upper left one, limited to the picture.
Image cropped(const Image& image, glm::ivec2 lo, glm::ivec2 hi);

/// A picture with more pixels a side than are allowed.
struct ImageTooLarge : std::runtime_error {
  ImageTooLarge(int its_width, int its_height, int allowed_side);
  int width, height, largest_side;
};

/// Reads PNG, JPEG, BMP or TGA; transparency is laid over white, and a JPEG stands as its EXIF orientation says. At
/// most 64 MB as a file and 4096 pixels a side, plenty for a cloth; a JPEG may have 32768 and is scaled down while it
/// is read. Throws std::runtime_error with a sentence that names the file and the fix.
Image read_image(const std::filesystem::path& file);
/// Decodes the content of a file; `name` names it in errors.
Image decode_image(std::span<const unsigned char> bytes, const std::string& name);

/// A picture, then its halves down to one pixel, each pixel the mean of four: against shimmering where it is drawn
/// small.
std::vector<Image> halvings(Image image);

// Bytes as zlib packs them.

/// Throws std::bad_alloc.
std::string packed(std::string_view bytes);
/// What was packed, at most that many bytes; none where it is damaged or has more.
std::optional<std::string> unpacked(std::string_view bytes, std::size_t most);

// JPEG pictures, decoded by libjpeg-turbo.

/// A picture that cannot be decoded. `what()` says why, as part of a sentence.
class DecodeError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

bool is_jpeg(std::span<const unsigned char> bytes);

/// Decodes a JPEG picture upright, as its EXIF orientation says. One with more than `largest_side` pixels a side is
/// scaled down while it is decoded, by 8 at most. Throws DecodeError; ImageTooLarge if 8 is not enough.
Image decode_jpeg(std::span<const unsigned char> bytes, int largest_side);

/// The orientation that the data of an EXIF segment ("Exif\0\0" and a TIFF block) says, 1 to 8; 1 (upright) where it
/// says none.
int exif_orientation(std::span<const unsigned char> exif);

/// The picture turned and mirrored so that it stands upright, by its EXIF orientation.
Image upright(Image image, int orientation);

}  // namespace tyglab
