// Pictures in and out.
#include <doctest/doctest.h>

#include "app/render/image.h"
#include "core/io/files.h"
#include "tests/support/files.h"
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

TEST_CASE("broken pictures of any kind are refused or read, never followed") {
  const test::TemporaryFolder folder;
  write_png(folder / "whole.png", noise(24, 16));
  const std::string whole = test::read_file(folder / "whole.png");
  test::Random random(6);
  for (int n = 0; n < 300; ++n) {
    std::string text = whole;
    for (int k = 1 + random.below(6); k > 0; --k) {
      text[std::size_t(random.below(int(text.size())))] = char(random.below(256));
    }
    test::write_file(folder / "broken.png", text);
    const std::string error = error_of(folder / "broken.png");
    CHECK((error.empty() || error.find("broken.png") != std::string::npos));
  }
}

}  // namespace tyglab::image_test
