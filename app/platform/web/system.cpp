
#include <emscripten.h>
#include <glad/gl.h>
#include <utility>

#include "app/platform/gl/dialect.h"
#include "app/platform/platform.h"
#include "app/render/gl_objects.h"
#include "core/io/output_file.h"

namespace tyglab {

GlContext current_gl_context(void (*(*)(const char* name))()) {
  return {};
}

const char* shader_version() {
  return "#version 300 es";
}

const char* shader_preamble() {
  return "precision highp float;\nprecision highp int;\nprecision highp sampler2D;\n"
         "precision highp sampler2DShadow;\nprecision highp usampler2D;\n";
}

void enable_smooth_edges_and_point_sizes() {}

bool drawing_can_be_timed() {
  return false;
}

std::vector<std::uint8_t> read_pixels(int width, int height) {
  std::vector<std::uint8_t> rgba(std::size_t(4) * width * height), rgb(std::size_t(3) * width * height);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c)
        rgb[3 * (std::size_t(height - 1 - y) * width + x) + c] = rgba[4 * (std::size_t(y) * width + x) + c];
  return rgb;
}

HeadlessContext::HeadlessContext() {
  throw GraphicsError("This edition cannot draw images without a window; open the page, or use the desktop edition");
}

HeadlessContext::~HeadlessContext() = default;

namespace {

std::unique_ptr<FrameLoop>& present_loop() {
  static std::unique_ptr<FrameLoop> loop;
  return loop;
}

void one_frame() {
  if (present_loop()->run_frame()) return;
  emscripten_cancel_main_loop();
  present_loop()->finish();
}

}  // namespace

int run_frame_loop(std::unique_ptr<FrameLoop> loop) {
  present_loop() = std::move(loop);
  emscripten_set_main_loop(one_frame, 0, false);
  return 0;
}

void lower_own_priority() {}

}  // namespace tyglab

// Called by app/platform/web/library.js.
extern "C" {
EMSCRIPTEN_KEEPALIVE void tyglab_on_leave() {
  if (tyglab::present_loop()) tyglab::present_loop()->leave();
}

/// The canvas comes into sight or leaves it: unseen frames are not made.
EMSCRIPTEN_KEEPALIVE void tyglab_on_sight(int seen) {
  seen != 0 ? emscripten_resume_main_loop() : emscripten_pause_main_loop();
}
}

// Of app/platform/web/library.js.
extern "C" {
int tyglab_clipboard_took();
void tyglab_hand_out(const char* file);
void tyglab_ask_for_file(const char* endings);
int tyglab_keep_files(const char* folder);
int tyglab_page_address(char* text, int bytes);
void tyglab_show_in_address(const char* link, const char* lab, int step, int further);
}

namespace tyglab {

bool files_are_handed_out() {
  return true;
}

void hand_out(const std::filesystem::path& file) {
  tyglab_hand_out(file.c_str());
}

void ask_for_file(const std::string& endings) {
  tyglab_ask_for_file(endings.c_str());
}

void keep_files(const std::filesystem::path& folder) {
  if (tyglab_keep_files(folder.c_str()) == 0)
    throw OutputError("The browser stores no data for this site: its storage is full or blocked");
}

bool clipboard_took() {
  return tyglab_clipboard_took() != 0;
}

std::string page_address() {
  constexpr int most = 4096;
  std::string text(most, '\0');
  text.resize(std::size_t(tyglab_page_address(text.data(), most)));
  return text;
}

void show_in_address(const std::string& link, const std::string& lab, int step, bool further) {
  tyglab_show_in_address(link.c_str(), lab.c_str(), step, further ? 1 : 0);
}

}  // namespace tyglab
