#include "app/render/written_vertices.h"

#include <utility>

#include "app/render/cloth_mesh.h"

namespace tyglab {

void WrittenVertices::set_tears(std::vector<TornSite> torn) {
  torn_ = std::move(torn);
  if (vertices_) vertices_->set_tears(torn_);
}

Bounds WrittenVertices::write(VertexSharing& device, const VertexRequest& request, std::size_t& read) {
  const std::size_t bytes =
      3 * sizeof(float) * std::size_t(request.sites.rows()) * std::size_t(request.sites.columns());
  // By the letter, glFinish is what tells a device without cl_khr_gl_event that OpenGL has drawn.
  if (device.gl_sharing() == GlSharing::finished) glFinish();
  std::optional<VertexBox> box;
  if (vertices_ && bytes == bytes_) box = device.write(*vertices_, request);
  if (!box) box = write_new(device, request, bytes);
  if (!std::exchange(looked_, true)) look_at(*box, request.sites), read += bytes;
  return {box->lo, box->hi};
}

/// Into new buffers: the cloth has another size, or runs on another device or in another precision.
VertexBox WrittenVertices::write_new(VertexSharing& device, const VertexRequest& request, std::size_t bytes) {
  free();
  buffers_.emplace();
  for (const auto* buffer : {&buffers_->positions, &buffers_->normals}) {
    glBindBuffer(GL_ARRAY_BUFFER, buffer->id());
    glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(bytes), nullptr, GL_STREAM_COPY);
  }
  glFinish();  // they are there before the device looks for them
  vertices_ = device.share({buffers_->positions.id(), buffers_->normals.id(), bytes});
  bytes_ = bytes;
  vertices_->set_tears(torn_);
  const std::optional<VertexBox> box = device.write(*vertices_, request);
  if (!box) throw EngineError("The device cannot write to the buffers it was given");
  return *box;
}

void WrittenVertices::look_at(const VertexBox& box, const DrawnSites& sites) const {
  std::vector<float> seen(bytes_ / sizeof(float));
  glBindBuffer(GL_ARRAY_BUFFER, buffers_->positions.id());
  glGetBufferSubData(GL_ARRAY_BUFFER, 0, GLsizeiptr(bytes_), seen.data());
  const Bounds there = finite_bounds({sites.rows(), sites.columns(), sites.columns(), seen.data()});
  if (there.lo != box.lo || there.hi != box.hi)
    throw EngineError("OpenGL does not see what the device wrote into its buffer");
}

}  // namespace tyglab
