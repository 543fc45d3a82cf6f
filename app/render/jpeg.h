// JPEG pictures, decoded by libjpeg-turbo.
#pragma once

#include <span>
#include <stdexcept>
#include <string>

#include "app/render/image.h"

namespace tyglab {

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
