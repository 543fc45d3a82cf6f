// The picture on the cloth.
#pragma once

#include <filesystem>

#include "app/viewport/gl_objects.h"

namespace tyglab {

class ClothTexture {
 public:
  /// A plain light grey.
  ClothTexture();
  /// Reads a picture, with smaller copies of itself against shimmering. Throws std::runtime_error with a sentence and
  /// keeps the old one.
  void load(const std::filesystem::path& file);
  /// Binds it to a texture unit.
  void bind(int unit) const;

 private:
  gl::Texture texture_;
};

}  // namespace tyglab
