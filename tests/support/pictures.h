// Small valid pictures of every format that is read, as the bytes of their files.
#pragma once

#include <string>
#include <vector>

#include "app/base/image.h"
#include "tests/support/scenes.h"

namespace tyglab::test {

struct JpegKind {
  bool progressive = false;
  int channels = 3;     ///< 1: gray, 3: color, 4: inks, as Adobe writes them
  int orientation = 0;  ///< of its EXIF segment; 0: it has none
  bool little_endian = true;
};
std::string jpeg(const Image& image, const JpegKind& kind);

/// Noise in a PNG of that color type (0 gray, 2 RGB, 3 palette, 4 gray and alpha, 6 RGBA) and bits a channel.
std::string png(Random& random, int width, int height, int color_type, int depth);

/// Noise in a TGA: type 1 (palette), 2 (colors), 3 (gray), and 8 more where its runs are packed.
std::string tga(Random& random, int width, int height, int type, int bits);

/// Noise in a BMP of that many bits a pixel: 1, 4, 8 (palette), 16, 24, 32.
std::string bmp(Random& random, int width, int height, int bits);

/// One of each, of `side` pixels or a few more.
std::vector<std::string> pictures_of_all_kinds(int side);

}  // namespace tyglab::test
