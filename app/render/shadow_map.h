// The shadow of the key light: a depth picture from the direction of the light that fits the scene closely.
#pragma once

#include <glm/mat4x4.hpp>

#include "app/render/camera.h"
#include "app/render/gl_objects.h"

namespace tyglab {

class ShadowMap {
 public:
  static constexpr int size = 1024;  ///< texels a side

  ShadowMap();
  /// From world to 0..1 in each axis, for a box seen along the light.
  static glm::mat4 fit(const Bounds& box, glm::vec3 to_light);
  /// Binds it for drawing, cleared.
  void begin();
  /// Ends drawing; the framebuffer is left for the next one to bind.
  void end();
  /// Binds it to a texture unit, for a sampler2DShadow.
  void bind(int unit) const;

 private:
  gl::Texture depth_;
  gl::Framebuffer framebuffer_;
};

}  // namespace tyglab
