// Pictures in and out.
#include <doctest/doctest.h>

#include "app/base/image.h"
#include "core/io/output_file.h"
#include "tests/support/files.h"
#include "tests/support/pictures.h"
#include "tests/support/scenes.h"

namespace tyglab::image_test {

Image noise(int width, int height) {
  test::Random random(5);
  Image image{width, height, {}};
  for (int n = 0; n < width * height * 3; ++n) image.rgb.push_back(std::uint8_t(random.below(256)));
  return image;
}

/// What read_image says of a wrong file; empty if it takes it.
std::string error_of(const std::filesystem::path& file) {
  try {
    read_image(file);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return {};
}

TEST_CASE("a PNG is read back pixel for pixel") {
  const test::TemporaryFolder folder;
  for (const auto& [width, height] : {std::pair{1, 1}, {17, 9}, {64, 48}}) {
    const Image image = noise(width, height);
    write_png(folder / "a.png", image);
    const Image again = read_image(folder / "a.png");
    CHECK(again.width == width);
    CHECK(again.height == height);
    CHECK(again.rgb == image.rgb);
  }
}

TEST_CASE("rows go from the top: an uncompressed TGA and BMP show which way is up") {
  const test::TemporaryFolder folder;
  // 1 x 2 pixels, bottom row first: blue below, red above.
  const std::string tga("\0\0\2\0\0\0\0\0\0\0\0\0\1\0\2\0\30\0\xff\0\0\0\0\xff", 24);
  test::write_file(folder / "a.tga", tga);
  const Image image = read_image(folder / "a.tga");
  REQUIRE(image.rgb.size() == 6);
  CHECK(image.rgb == std::vector<std::uint8_t>{255, 0, 0, 0, 0, 255});
}

TEST_CASE("a picture that cannot be read or written is an error with its name") {
  const test::TemporaryFolder folder;
  test::write_file(folder / "empty.png", "");
  test::write_file(folder / "text.png", "no picture at all");
  write_png(folder / "whole.png", noise(40, 40));
  const std::string whole = test::read_file(folder / "whole.png");
  test::write_file(folder / "half.png", whole.substr(0, whole.size() / 2));
  // Its header promises 65535 x 65535 pixels.
  test::write_file(folder / "huge.tga", std::string("\0\0\2\0\0\0\0\0\0\0\0\0\xff\xff\xff\xff\30\0", 18));
  for (const char* name : {"empty.png", "text.png", "half.png", "huge.tga", "missing.png"}) {
    CHECK(error_of(folder / name).find(name) != std::string::npos);
  }
  CHECK_FALSE(error_of(folder.path()).empty());
  CHECK_THROWS_AS(write_png(folder / "missing" / "a.png", noise(2, 2)), OutputError);
}

/// Its color at the middle of a quarter: of the upper left one for (0, 0).
std::string quarter(const Image& image, int right, int below) {
  const int x = (1 + 2 * right) * image.width / 4, y = (1 + 2 * below) * image.height / 4;
  const std::uint8_t* rgb = image.rgb.data() + std::size_t(3) * (std::size_t(y) * image.width + x);
  constexpr int half = 128;
  const bool r = rgb[0] > half, g = rgb[1] > half, b = rgb[2] > half;
  return r && g ? "yellow" : r ? "red" : g ? "green" : b ? "blue" : "black";
}

/// Red and green above, blue and yellow below.
Image four_quarters(int width, int height) {
  Image image{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const bool right = 2 * x >= width, below = 2 * y >= height;
      image.rgb.insert(image.rgb.end(), {std::uint8_t(right == below ? 255 : 0), std::uint8_t(right ? 255 : 0),
                                         std::uint8_t(below && !right ? 255 : 0)});
      if (below && !right) image.rgb[image.rgb.size() - 3] = 0;
    }
  return image;
}

TEST_CASE("a JPEG stands as its EXIF orientation says") {
  // Where the first row's first and last quarter come to be: "the 0th row is the visual right-hand side, the 0th column
  // the visual top" for 6, and so on (Exif 2.3, tag 274).
  struct Case {
    int orientation, first_right, first_below, last_right, last_below;
  };
  constexpr Case cases[] = {{0, 0, 0, 1, 0}, {1, 0, 0, 1, 0}, {2, 1, 0, 0, 0}, {3, 1, 1, 0, 1}, {4, 0, 1, 1, 1},
                            {5, 0, 0, 0, 1}, {6, 1, 0, 1, 1}, {7, 1, 1, 1, 0}, {8, 0, 1, 0, 0}};
  const test::TemporaryFolder folder;
  for (const Case& c : cases)
    for (const bool little_endian : {true, false})
      for (const bool progressive : {true, false}) {
        CAPTURE(c.orientation);
        test::write_file(folder / "a.jpg",
                         test::jpeg(four_quarters(64, 32), {progressive, 3, c.orientation, little_endian}));
        const Image image = read_image(folder / "a.jpg");
        CHECK(image.width == (c.orientation >= 5 ? 32 : 64));
        CHECK(quarter(image, c.first_right, c.first_below) == "red");
        CHECK(quarter(image, c.last_right, c.last_below) == "green");
        CHECK(quarter(image, 1 - c.last_right, 1 - c.last_below) == "blue");
      }
}

TEST_CASE("a JPEG of inks or of gray is read in color") {
  const test::TemporaryFolder folder;
  test::write_file(folder / "inks.jpg", test::jpeg(four_quarters(32, 32), {false, 4, 0, true}));
  CHECK(quarter(read_image(folder / "inks.jpg"), 0, 0) == "red");
  CHECK(quarter(read_image(folder / "inks.jpg"), 1, 1) == "yellow");
  test::write_file(folder / "gray.jpg", test::jpeg({8, 8, std::vector<std::uint8_t>(192, 200)}, {false, 1, 0, true}));
  CHECK(read_image(folder / "gray.jpg").rgb == std::vector<std::uint8_t>(192, 200));
}

TEST_CASE("pictures are limited before they are decoded: a large JPEG is scaled down, others are refused by name") {
  const test::TemporaryFolder folder;
  test::write_file(folder / "large.jpg", test::jpeg(four_quarters(6000, 600), {false, 3, 6, true}));
  const Image scaled = read_image(folder / "large.jpg");
  CHECK(scaled.height == 3750);  // 5/8, the most that keeps to 4096
  CHECK(scaled.width == 375);
  CHECK(quarter(scaled, 1, 0) == "red");
  test::write_file(folder / "wide.jpg", test::jpeg({40000, 1, std::vector<std::uint8_t>(120000, 9)}, {}));
  CHECK(error_of(folder / "wide.jpg").find("wide.jpg is 40000 x 1 pixels; at most 32768") != std::string::npos);
  // 4097 pixels, all of them there.
  test::Random random(3);
  test::write_file(folder / "wide.png", test::png(random, 4097, 1, 0, 8));
  test::write_file(folder / "high.tga", test::tga(random, 1, 4097, 2, 24));
  test::write_file(folder / "wide.bmp", test::bmp(random, 4097, 1, 24));
  for (const char* name : {"wide.png", "high.tga", "wide.bmp"}) {
    const std::string error = error_of(folder / name);
    CAPTURE(error);
    CHECK(error.find(std::string(name) + " is ") != std::string::npos);
    CHECK(error.find("4097") != std::string::npos);
    CHECK(error.find("at most 4096") != std::string::npos);
  }
}

TEST_CASE("a picture cut short, or holding far more than its pixels, is refused before it costs memory") {
  const test::TemporaryFolder folder;
  // 4096 x 4096 pixels promised by 18 bytes.
  test::write_file(folder / "empty.tga", std::string("\0\0\2\0\0\0\0\0\0\0\0\0\0\x10\0\x10\30\0", 18));
  CHECK(error_of(folder / "empty.tga").find("cut short") != std::string::npos);
  test::write_file(folder / "whole.jpg", test::jpeg(noise(64, 64), {}));
  const std::string whole = test::read_file(folder / "whole.jpg");
  test::write_file(folder / "half.jpg", whole.substr(0, whole.size() / 2));
  CHECK_FALSE(error_of(folder / "half.jpg").empty());
  // An 8 x 8 PNG whose stream unpacks to 256 MB: runs of 258 zeros in codes of two bits.
  std::string zeros = "\x78\x01";
  unsigned bits = 0, count = 0;
  const auto put = [&](unsigned value, unsigned length) {
    for (unsigned k = 0; k < length; ++k) {
      bits |= (value >> k & 1) << count;
      if (++count == 8) zeros += char(bits), bits = count = 0;
    }
  };
  put(3, 3);           // a last block, with the fixed codes
  put(0b00001100, 8);  // a literal 0 (code 00110000, its first bit first)
  for (int n = 0; n < 1'040'000; ++n) put(0b10100011, 8), put(0, 5);  // 258 of distance 1 (code 11000101)
  put(0, 7), put(0, 8);                                               // its end
  std::string png = test::png(*std::make_unique<test::Random>(1), 8, 8, 0, 8);
  const std::size_t at = png.find("IDAT");
  const auto size = std::uint32_t(zeros.size());
  png = png.substr(0, at - 4) + char(size >> 24) + char(size >> 16) + char(size >> 8) + char(size) + "IDAT" + zeros;
  test::write_file(folder / "bomb.png", png + std::string(8, '\0') + "IEND" + std::string(4, '\0'));
  const std::string error = error_of(folder / "bomb.png");
  CAPTURE(error);
  CHECK(error.find("unpacks to more") != std::string::npos);
}

}  // namespace tyglab::image_test
