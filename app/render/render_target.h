// The target of a frame: a multisampled picture with depth, and the plain texture into which it is resolved.
#pragma once

#include <glm/mat4x4.hpp>
#include <optional>

#include "app/base/image.h"
#include "app/render/camera.h"
#include "app/render/gl_objects.h"

namespace tyglab {

class RenderTarget {
 public:
  /// Binds it for drawing, made again where size or samples differ from last time. Throws GraphicsError.
  void begin(int width, int height, int samples);
  /// Resolves what was drawn into texture().
  void resolve();
  GLuint texture() const { return parts_ ? parts_->resolved.id() : 0; }
  Image pixels() const;

 private:
  struct Parts {
    gl::Framebuffer drawn, resolving;
    gl::Renderbuffer color, depth;
    gl::Texture resolved;
  };
  void make();
  std::optional<Parts> parts_;
  int width_ = 0, height_ = 0, samples_ = 0;
};

/// The framebuffers and the viewport in use, put back when this ends, by an exception too.
class SavedTarget {
 public:
  SavedTarget() {
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw_);
    glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read_);
    glGetIntegerv(GL_VIEWPORT, viewport_);
  }
  ~SavedTarget() {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, GLuint(draw_));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, GLuint(read_));
    glViewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
  }
  SavedTarget(const SavedTarget&) = delete;
  SavedTarget& operator=(const SavedTarget&) = delete;

 private:
  GLint draw_ = 0, read_ = 0, viewport_[4] = {};
};

// The shadow of the key light: a depth picture from the direction of the light that fits the scene closely.

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
