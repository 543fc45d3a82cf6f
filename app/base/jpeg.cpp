#include "app/base/image.h"

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdint>
#include <cstdio>  // which libjpeg's header needs

#include <jpeglib.h>

#include <jerror.h>

namespace tyglab {
namespace {

// A progressive picture is held as coefficients while it is decoded, and each scan goes over all of them.
constexpr long most_memory = 256L << 20;
constexpr double most_scanned_pixels = 1e9;
constexpr int most_reduction = 8;  // of libjpeg's scaled decoding

/// libjpeg's way to say that something is wrong: it must not return. Its frames are C, so no exception goes through.
struct Errors {
  jpeg_error_mgr manager;
  std::jmp_buf back;
  std::array<char, JMSG_LENGTH_MAX> text;
};

[[noreturn]] void give_up(j_common_ptr info) {
  auto* errors = reinterpret_cast<Errors*>(info->err);
  errors->manager.format_message(info, errors->text.data());
  std::longjmp(errors->back, 1);
}

/// Oddities are let pass, as every viewer does; missing or broken data is an error.
void judge_warning(j_common_ptr info, int level) {
  constexpr std::array<int, 4> damage{JWRN_JPEG_EOF, JWRN_HIT_MARKER, JWRN_HUFF_BAD_CODE, JWRN_MUST_RESYNC};
  if (level < 0 && std::find(damage.begin(), damage.end(), info->err->msg_code) != damage.end()) give_up(info);
}

/// A small file may ask for any number of scans over a large picture.
void limit_scans(j_common_ptr info) {
  const auto* picture = reinterpret_cast<j_decompress_ptr>(info);
  const double pixels = double(picture->image_width) * picture->image_height;
  if (picture->input_scan_number * pixels > most_scanned_pixels && picture->input_scan_number > 1)
    ERREXIT(info, JERR_BAD_PROGRESSION);
}

/// libjpeg's decoder and its memory.
class Decoder {
 public:
  Decoder() {
    info_.err = jpeg_std_error(&errors_.manager);
    errors_.manager.error_exit = give_up;
    errors_.manager.emit_message = judge_warning;
    guarded([this] { jpeg_create_decompress(&info_); });
    info_.mem->max_memory_to_use = most_memory;
    progress_.progress_monitor = limit_scans;
    info_.progress = &progress_;
  }
  ~Decoder() { jpeg_destroy_decompress(&info_); }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

  jpeg_decompress_struct& info() { return info_; }

  /// Calls libjpeg. `work` must have no locals that are to be destroyed. Throws DecodeError.
  template <class Work>
  void guarded(const Work& work) {
    if (setjmp(errors_.back) != 0) throw DecodeError(errors_.text.data());
    work();
  }

 private:
  jpeg_decompress_struct info_ = {};
  jpeg_progress_mgr progress_ = {};
  Errors errors_ = {};
};

/// Begins with the picture's size and markers; chooses colors and scale.
void read_header(Decoder& decoder, std::span<const unsigned char> bytes, int largest_side) {
  jpeg_decompress_struct& info = decoder.info();
  decoder.guarded([&] {
    jpeg_mem_src(&info, bytes.data(), static_cast<unsigned long>(bytes.size()));
    constexpr unsigned whole = 0xFFFF;
    jpeg_save_markers(&info, JPEG_APP0 + 1, whole);
    jpeg_read_header(&info, TRUE);
  });
  const auto longest = int(std::max(info.image_width, info.image_height));
  if (longest > most_reduction * largest_side)
    throw ImageTooLarge(int(info.image_width), int(info.image_height), most_reduction * largest_side);
  info.scale_denom = most_reduction;
  info.scale_num = unsigned(std::clamp(most_reduction * largest_side / longest, 1, most_reduction));
  const bool inks = info.jpeg_color_space == JCS_CMYK || info.jpeg_color_space == JCS_YCCK;
  info.out_color_space = inks ? JCS_CMYK : JCS_RGB;
  decoder.guarded([&] { jpeg_calc_output_dimensions(&info); });
}

/// Inks laid over white paper. Adobe writes them inverted.
void inks_to_rgb(const unsigned char* inks, std::uint8_t* rgb, bool inverted) {
  const auto light = [&](int ink) { return inverted ? inks[ink] : 255 - inks[ink]; };
  for (int c = 0; c < 3; ++c) rgb[c] = std::uint8_t((light(c) * light(3) + 127) / 255);
}

int orientation_of(const jpeg_decompress_struct& info) {
  for (const jpeg_marker_struct* marker = info.marker_list; marker != nullptr; marker = marker->next) {
    const int said = exif_orientation({marker->data, marker->data_length});
    if (said != 1) return said;
  }
  return 1;
}

/// Numbers of a TIFF block, whose first bytes say in which order theirs are.
class Tiff {
 public:
  explicit Tiff(std::span<const unsigned char> bytes)
      : bytes_(bytes), little_(bytes.size() >= 2 && bytes[0] == 'I' && bytes[1] == 'I') {}

  /// 0 beyond the end.
  std::uint32_t number(std::size_t at, std::size_t size) const {
    if (at > bytes_.size() || size > bytes_.size() - at) return 0;
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < size; ++k) value = value << 8 | bytes_[at + (little_ ? size - 1 - k : k)];
    return value;
  }

 private:
  std::span<const unsigned char> bytes_;
  bool little_;
};

}  // namespace

bool is_jpeg(std::span<const unsigned char> bytes) {
  return bytes.size() > 2 && bytes[0] == 0xFF && bytes[1] == 0xD8 && bytes[2] == 0xFF;
}

int exif_orientation(std::span<const unsigned char> exif) {
  constexpr std::array<unsigned char, 6> name{'E', 'x', 'i', 'f', 0, 0};
  if (exif.size() < name.size() || !std::equal(name.begin(), name.end(), exif.begin())) return 1;
  const Tiff tiff(exif.subspan(name.size()));
  constexpr std::size_t first_folder_at = 4, entry_size = 12, value_in_entry = 8;
  constexpr std::uint32_t orientation_tag = 0x0112;
  const std::size_t folder = tiff.number(first_folder_at, 4), entries = tiff.number(folder, 2);
  for (std::size_t n = 0; n < entries; ++n) {
    const std::size_t entry = folder + 2 + entry_size * n;
    if (tiff.number(entry, 2) != orientation_tag) continue;
    const std::uint32_t said = tiff.number(entry + value_in_entry, 2);
    return said >= 1 && said <= 8 ? int(said) : 1;
  }
  return 1;
}

Image upright(Image image, int orientation) {
  if (orientation == 1) return image;
  const bool turned = orientation >= 5;
  const bool from_right = orientation == 2 || orientation == 3 || orientation >= 7;
  const bool from_below = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
  Image result{turned ? image.height : image.width, turned ? image.width : image.height, {}};
  result.rgb.reserve(image.rgb.size());
  for (int y = 0; y < result.height; ++y) {
    for (int x = 0; x < result.width; ++x) {
      const int across = turned ? y : x, down = turned ? x : y;
      const int column = from_right ? image.width - 1 - across : across;
      const int row = from_below ? image.height - 1 - down : down;
      const auto pixel = image.rgb.begin() + 3 * (std::ptrdiff_t(row) * image.width + column);
      result.rgb.insert(result.rgb.end(), pixel, pixel + 3);
    }
  }
  return result;
}

Image decode_jpeg(std::span<const unsigned char> bytes, int largest_side) {
  Decoder decoder;
  jpeg_decompress_struct& info = decoder.info();
  read_header(decoder, bytes, largest_side);
  Image image{int(info.output_width), int(info.output_height), {}};
  image.rgb.resize(std::size_t(image.width) * image.height * 3);
  const bool inks = info.out_color_space == JCS_CMYK;
  std::vector<unsigned char> inked(inks ? std::size_t(image.width) * 4 : 0);
  decoder.guarded([&] {
    jpeg_start_decompress(&info);
    while (info.output_scanline < info.output_height) {
      std::uint8_t* const rgb = image.rgb.data() + std::size_t(info.output_scanline) * image.width * 3;
      unsigned char* row = inks ? inked.data() : rgb;
      jpeg_read_scanlines(&info, &row, 1);
      if (!inks) continue;
      for (int x = 0; x < image.width; ++x)
        inks_to_rgb(row + std::ptrdiff_t(4) * x, rgb + std::ptrdiff_t(3) * x, info.saw_Adobe_marker != 0);
    }
  });
  return upright(std::move(image), orientation_of(info));
}

}  // namespace tyglab
