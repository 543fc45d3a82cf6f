#include "app/render/render_target.h"

#include <algorithm>
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

}  // namespace tyglab
