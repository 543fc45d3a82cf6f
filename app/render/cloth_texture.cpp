#include "app/render/cloth_texture.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>

namespace tyglab {
namespace {

// GL_EXT_texture_filter_anisotropic, which is in every driver but no part of OpenGL before 4.6.
constexpr GLenum texture_max_anisotropy = 0x84FE, max_texture_max_anisotropy = 0x84FF;
constexpr float wanted_anisotropy = 8;

bool has_extension(const char* name) {
  GLint count = 0;
  glGetIntegerv(GL_NUM_EXTENSIONS, &count);
  for (GLuint k = 0; k < GLuint(count); ++k) {
    if (std::strcmp(reinterpret_cast<const char*>(glGetStringi(GL_EXTENSIONS, k)), name) == 0) return true;
  }
  return false;
}

/// Mesa without a GPU: there the sharper look of slanting cloth costs as much as all the rest of it.
bool drawn_in_software() {
  const auto* renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return renderer != nullptr && (std::strstr(renderer, "llvmpipe") || std::strstr(renderer, "softpipe"));
}

ClothTexture::Driver ask_driver() {
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  GLfloat most = 1;
  if (!drawn_in_software() && has_extension("GL_EXT_texture_filter_anisotropic"))
    glGetFloatv(max_texture_max_anisotropy, &most);
  return {std::min(most, wanted_anisotropy), largest};
}

void filter(float anisotropy) {
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  if (anisotropy > 1) glTexParameterf(GL_TEXTURE_2D, texture_max_anisotropy, anisotropy);
}

gl::Texture upload(const std::vector<Image>& sizes, float anisotropy) {
  gl::Texture texture;
  glBindTexture(GL_TEXTURE_2D, texture.id());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  for (std::size_t level = 0; level < sizes.size(); ++level)
    glTexImage2D(GL_TEXTURE_2D, GLint(level), GL_RGB8, sizes[level].width, sizes[level].height, 0, GL_RGB,
                 GL_UNSIGNED_BYTE, sizes[level].rgb.data());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  filter(anisotropy);
  glBindTexture(GL_TEXTURE_2D, 0);
  return texture;
}

}  // namespace

ClothPicture read_picture(const std::filesystem::path& file) {
  return {file, halvings(read_image(file))};
}

ClothTexture::ClothTexture() : driver_(ask_driver()), texture_(upload({{1, 1, {200, 204, 212}}}, driver_.anisotropy)) {}

void ClothTexture::take(const ClothPicture& picture) {
  const Image& image = picture.sizes.front();
  const int largest = driver_.largest;
  if (image.width > largest || image.height > largest) {
    throw std::runtime_error(picture.file.string() + " has more than the " + std::to_string(largest) +
                             " pixels a side that this graphics driver supports. Make it smaller.");
  }
  texture_ = upload(picture.sizes, driver_.anisotropy);
}

void ClothTexture::bind(int unit) const {
  glActiveTexture(GLenum(GL_TEXTURE0 + unit));
  glBindTexture(GL_TEXTURE_2D, texture_.id());
}

}  // namespace tyglab
