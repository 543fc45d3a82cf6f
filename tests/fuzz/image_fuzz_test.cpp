// Whatever the decoders are given, they answer with a picture of allowed size or with a std::runtime_error; nothing
// else. Run under AddressSanitizer, which sees what they touch. The generator is seeded: the message holds the number
// of the input.
#include <doctest/doctest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "app/base/image.h"
#include "tests/support/files.h"
#include "tests/support/pictures.h"
#include "tests/support/places.h"

namespace tyglab::image_fuzz_test {

constexpr int largest_side = 4096;
constexpr int mutants_of_each = 1500;

std::span<const unsigned char> bytes_of(const std::string& text) {
  return {reinterpret_cast<const unsigned char*>(text.data()), text.size()};
}

/// Whether it is a picture, which then is whole.
bool decodes(const std::string& text) {
  try {
    const Image image = decode_image(bytes_of(text), "the picture");
    REQUIRE(image.width >= 1);
    REQUIRE(image.height >= 1);
    REQUIRE(image.width <= largest_side);
    REQUIRE(image.height <= largest_side);
    REQUIRE(image.rgb.size() == std::size_t(3) * image.width * image.height);
    return true;
  } catch (const std::runtime_error& error) {
    REQUIRE(std::string(error.what()).starts_with("the picture is"));
    return false;
  }
}

/// Bytes changed, swapped, doubled, left out: more at the beginning, where headers and tables are.
std::string mutated(std::string text, test::Random& random) {
  for (int changes = 1 + random.below(4); changes > 0; --changes) {
    const int size = int(text.size());
    if (size < 4) return text;
    const std::size_t at = std::size_t(random.below(random.below(3) == 0 ? size : 1 + std::min(size - 1, 64)));
    const std::size_t length = std::min(std::size_t(1 + random.below(16)), text.size() - at);
    switch (random.below(6)) {
      case 0:
        text[at] = char(random.below(256));
        break;
      case 1:
        text[at] = char(text[at] ^ 1 << random.below(8));
        break;
      case 2:
        text[at] = random.below(2) == 0 ? '\0' : '\xff';
        break;
      case 3:
        text.erase(at, length);
        break;
      case 4:
        text.insert(at, text.substr(std::size_t(random.below(size - 1)), length));
        break;
      default:
        text.resize(std::size_t(random.below(size)));
    }
  }
  return text;
}

TEST_CASE("pictures of every kind are read") {
  for (const int side : {1, 8, 21}) {
    const std::vector<std::string> pictures = test::pictures_of_all_kinds(side);
    for (std::size_t n = 0; n < pictures.size(); ++n) {
      CAPTURE(side);
      CAPTURE(n);
      CHECK(decodes(pictures[n]));
    }
  }
}

TEST_CASE("mutants of pictures are read or refused") {
  test::Random random(101);
  const std::vector<std::string> pictures = test::pictures_of_all_kinds(12);
  int read = 0, refused = 0;
  for (std::size_t n = 0; n < pictures.size(); ++n) {
    for (int mutant = 0; mutant < mutants_of_each; ++mutant) {
      CAPTURE(n);
      CAPTURE(mutant);
      ++(decodes(mutated(pictures[n], random)) ? read : refused);
    }
  }
  // Both ways are gone.
  CHECK(read > 500);
  CHECK(refused > 500);
}

TEST_CASE("JPEGs that wrote out of bounds in stb_image, and their mutants, are read or refused") {
  test::Random random(102);
  for (const char* name : {"j37.jpg", "j50.jpg"}) {
    const std::string picture =
        test::read_file(std::filesystem::path(std::string(test::source_dir) + "/tests/fuzz/pictures") / name);
    decodes(picture);
    for (int mutant = 0; mutant < 4 * mutants_of_each; ++mutant) {
      CAPTURE(mutant);
      decodes(mutated(picture, random));
    }
  }
}

TEST_CASE("an EXIF segment says an orientation or none, however broken") {
  test::Random random(103);
  const std::string picture = test::jpeg({8, 8, std::vector<std::uint8_t>(192, 90)}, {false, 3, 6, true});
  const std::string segment = picture.substr(picture.find("Exif"), 44);
  CHECK(exif_orientation(bytes_of(segment)) == 6);
  for (int mutant = 0; mutant < 20000; ++mutant) {
    CAPTURE(mutant);
    // A block of exactly its size, so that the sanitizer sees every byte read beyond.
    const std::string text = mutated(segment, random);
    const std::vector<unsigned char> bytes(text.begin(), text.end());
    const int orientation = exif_orientation(bytes);
    REQUIRE(orientation >= 1);
    REQUIRE(orientation <= 8);
  }
}

}  // namespace tyglab::image_fuzz_test
