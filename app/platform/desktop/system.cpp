
#include <glad/gl.h>
#include <algorithm>
#include <cassert>

#include "app/platform/gl/dialect.h"
#include "app/platform/platform.h"

namespace tyglab {

bool files_are_handed_out() {
  return false;
}

void hand_out(const std::filesystem::path&) {}
void ask_for_file(const std::string&) {}
void keep_files(const std::filesystem::path&) {}

bool clipboard_took() {
  return true;
}

std::string page_address() {
  return {};
}

void show_in_address(const std::string&, const std::string&, int, bool) {}

const char* shader_version() {
  return "#version 330 core";
}

const char* shader_preamble() {
  return "";
}

void enable_smooth_edges_and_point_sizes() {
  glEnable(GL_MULTISAMPLE);
  glEnable(GL_PROGRAM_POINT_SIZE);
}

bool drawing_can_be_timed() {
  return true;
}

std::vector<std::uint8_t> read_pixels(int width, int height) {
  const std::ptrdiff_t row = 3 * std::ptrdiff_t(width);
  std::vector<std::uint8_t> rgb(std::size_t(row) * height);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, rgb.data());
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  for (int top = 0, bottom = height - 1; top < bottom; ++top, --bottom)
    std::swap_ranges(rgb.begin() + top * row, rgb.begin() + (top + 1) * row, rgb.begin() + bottom * row);
  return rgb;
}

int run_frame_loop(std::unique_ptr<FrameLoop> loop) {
  while (loop->run_frame()) {
  }
  return loop->finish();
}

bool works_in_copies() {
  return false;
}

struct Copy::Parts {};

Copy::Copy(std::function<void(const Report& report)>, Report) {
  assert(works_in_copies());
}

Copy::~Copy() = default;

}  // namespace tyglab
