// The texture of the cloth.
#pragma once

#include <filesystem>
#include <vector>

#include "app/base/image.h"
#include "app/render/gl_objects.h"

namespace tyglab {

/// A picture for the cloth, ready for the graphics card.
struct ClothPicture {
  std::filesystem::path file;
  std::vector<Image> sizes;  ///< halvings
};
/// Needs no graphics context, so it may be done beside the frames. Throws std::runtime_error with a sentence.
ClothPicture read_picture(const std::filesystem::path& file);

class ClothTexture {
 public:
  /// Limits of the driver. They are requested once: in a browser every answer waits until all earlier drawing is done.
  struct Driver {
    float anisotropy;  ///< of the filter; 1: none
    int largest;       ///< pixels a side
  };

  /// A plain light gray.
  ClothTexture();
  /// Takes a picture with its halvings (read_picture). Throws std::runtime_error with a sentence and keeps the old one.
  void take(const ClothPicture& picture);
  /// Binds it to a texture unit.
  void bind(int unit) const;

 private:
  Driver driver_;
  gl::Texture texture_;
};

}  // namespace tyglab
