
#include "app/render/render_target.h"

#include <algorithm>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <string>

#include "app/platform/gl/dialect.h"

namespace tyglab {
namespace {

void check_complete(int width, int height) {
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return;
  throw GraphicsError("An image of " + std::to_string(width) + " x " + std::to_string(height) +
                      " pixels cannot be drawn with this graphics driver. Choose a smaller size.");
}

}  // namespace

void RenderTarget::begin(int width, int height, int samples) {
  if (!parts_ || width != width_ || height != height_ || samples != samples_) {
    width_ = width, height_ = height, samples_ = samples;
    make();
  }
  glBindFramebuffer(GL_FRAMEBUFFER, parts_->drawn.id());
  glViewport(0, 0, width_, height_);
}

void RenderTarget::make() {
  parts_.reset();
  GLint most_samples = 1, largest = 1;
  glGetIntegerv(GL_MAX_SAMPLES, &most_samples);
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
  if (width_ < 1 || height_ < 1 || width_ > largest || height_ > largest) {
    const std::string size = std::to_string(width_) + " x " + std::to_string(height_);
    width_ = height_ = 0;
    throw GraphicsError("An image of " + size + " pixels cannot be drawn; each side may be 1 to " +
                        std::to_string(largest) + ".");
  }
  const int samples = samples_ > 1 ? std::min(samples_, int(most_samples)) : 0;
  parts_.emplace();
  glBindTexture(GL_TEXTURE_2D, parts_->resolved.id());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width_, height_, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glBindTexture(GL_TEXTURE_2D, 0);
  glBindFramebuffer(GL_FRAMEBUFFER, parts_->resolving.id());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, parts_->resolved.id(), 0);
  check_complete(width_, height_);

  glBindFramebuffer(GL_FRAMEBUFFER, parts_->drawn.id());
  glBindRenderbuffer(GL_RENDERBUFFER, parts_->color.id());
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_RGBA8, width_, height_);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, parts_->color.id());
  glBindRenderbuffer(GL_RENDERBUFFER, parts_->depth.id());
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_DEPTH_COMPONENT24, width_, height_);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, parts_->depth.id());
  glBindRenderbuffer(GL_RENDERBUFFER, 0);
  check_complete(width_, height_);
}

void RenderTarget::resolve() {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, parts_->drawn.id());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, parts_->resolving.id());
  glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

Image RenderTarget::pixels() const {
  if (!parts_) return {};
  GLint bound = 0;
  glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &bound);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, parts_->resolving.id());
  Image image{width_, height_, read_pixels(width_, height_)};
  glBindFramebuffer(GL_READ_FRAMEBUFFER, GLuint(bound));
  return image;
}

ShadowMap::ShadowMap() {
  glBindTexture(GL_TEXTURE_2D, depth_.id());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, size, size, 0, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  glBindTexture(GL_TEXTURE_2D, 0);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.id(), 0);
  glDrawBuffer(GL_NONE);
  glReadBuffer(GL_NONE);
  const bool complete = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  if (!complete) throw GraphicsError("This graphics driver cannot draw a shadow map. A newer Mesa may fix it.");
}

glm::mat4 ShadowMap::fit(const Bounds& box, glm::vec3 to_light) {
  const glm::mat4 turn = glm::lookAt(glm::vec3(0), -to_light, glm::vec3(0, 0, -1));
  Bounds seen;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec3 p(corner & 1 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y,
                      corner & 4 ? box.hi.z : box.lo.z);
    seen.add(glm::vec3(turn * glm::vec4(p, 1)));
  }
  const glm::vec3 margin = 0.02f * (seen.hi - seen.lo) + 1e-6f;
  const glm::vec3 lo = seen.lo - margin, hi = seen.hi + margin;
  const glm::mat4 clip = glm::ortho(lo.x, hi.x, lo.y, hi.y, -hi.z, -lo.z);
  const glm::mat4 to_unit = glm::scale(glm::translate(glm::mat4(1), glm::vec3(0.5f)), glm::vec3(0.5f));
  return to_unit * clip * turn;
}

void ShadowMap::begin() {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  glViewport(0, 0, size, size);
  glClear(GL_DEPTH_BUFFER_BIT);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(1.5f, 2.0f);
}

void ShadowMap::end() {
  glDisable(GL_POLYGON_OFFSET_FILL);
}

void ShadowMap::bind(int unit) const {
  glActiveTexture(GLenum(GL_TEXTURE0 + unit));
  glBindTexture(GL_TEXTURE_2D, depth_.id());
}

}  // namespace tyglab
