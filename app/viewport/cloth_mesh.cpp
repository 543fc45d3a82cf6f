#include "app/viewport/cloth_mesh.h"

#include <algorithm>
#include <cmath>

namespace tyglab {
namespace {

using List = ClothMesh::List;

/// Whether a view draws that list.
bool needs(const ViewOptions& options, List list) {
  switch (list) {
    case List::triangles:
      return options.lit();
    case List::straight:
    case List::diagonal:
      return options.mode == 2;
    case List::bending:
      return options.mode == 2 && options.bending;
    case List::connections:
      return options.mode == 3;
    case List::outlines:
      return options.mode == 4;
    case List::particles:
      return options.mode == 5;
    case List::pins:
      return true;
    case List::count:
      break;
  }
  return false;
}

/// Finite range of one component.
void range(const FloatPositions& p, const float* component, float& lo, float& hi) {
  for (int i = 0; i < p.rows; ++i) {
    const float* row = component + std::size_t(i) * p.stride;
    for (int j = 0; j < p.columns; ++j) {
      if (!std::isfinite(row[j])) continue;
      lo = std::min(lo, row[j]);
      hi = std::max(hi, row[j]);
    }
  }
}

}  // namespace

void ClothMesh::update(const ClothScene& scene, const ViewOptions& options, bool moved, bool topology_changed) {
  const PositionView& view = scene.positions;
  if (view.stride != stride_ || scene.lattice != lattice_) moved = topology_changed = true;
  // Which edges are too long depends on where the particles are. A diverged cloth stands still, so it happens seldom.
  if (options.longest_edge > 0 || options.longest_edge != longest_edge_) moved = topology_changed = true;
  longest_edge_ = options.longest_edge;
  lattice_ = scene.lattice;
  stride_ = view.stride;
  if (topology_changed) {
    for (IndexList& list : lists_) list.ready = false;
    beside_tears_.reset();
    normals_ready_ = false;
  }
  glBindVertexArray(array_.id());
  const bool needs_normals = options.lit() && (moved || !normals_ready_);
  if (moved || needs_normals) upload_positions(view);
  if (needs_normals) upload_normals(scene);
  if (moved && !needs_normals) normals_ready_ = false;
  for (int list = 0; list < int(List::count); ++list) {
    if (needs(options, List(list))) prepare(List(list), scene);
  }
  glBindVertexArray(0);
}

void ClothMesh::upload_positions(const PositionView& view) {
  const std::size_t count = std::size_t(view.rows) * view.stride;
  floats_ = {view.rows, view.columns, view.stride, view.f[0], view.f[1], view.f[2]};
  if (view.f[0] == nullptr) {
    for (int c = 0; c < 3; ++c) {
      converted_[c].resize(count);
      std::transform(view.d[c], view.d[c] + count, converted_[c].begin(), [](double v) { return float(v); });
    }
    floats_.x = converted_[0].data(), floats_.y = converted_[1].data(), floats_.z = converted_[2].data();
  }
  set_attribute(0, position_buffers_[0], floats_.x, count);
  set_attribute(1, position_buffers_[1], floats_.y, count);
  set_attribute(2, position_buffers_[2], floats_.z, count);
  bounds_ = {};
  range(floats_, floats_.x, bounds_.lo.x, bounds_.hi.x);
  range(floats_, floats_.y, bounds_.lo.y, bounds_.hi.y);
  range(floats_, floats_.z, bounds_.lo.z, bounds_.hi.z);
}

void ClothMesh::upload_normals(const ClothScene& scene) {
  if (!beside_tears_) beside_tears_ = particles_beside_tears(lattice_, stride_, scene.tears);
  compute_normals(floats_, scene.tears, *beside_tears_, normals_);
  set_attribute(3, normal_buffers_[0], normals_.x.data(), normals_.x.size());
  set_attribute(4, normal_buffers_[1], normals_.y.data(), normals_.y.size());
  set_attribute(5, normal_buffers_[2], normals_.z.data(), normals_.z.size());
  normals_ready_ = true;
}

void ClothMesh::set_attribute(GLuint attribute, gl::Buffer& buffer, const float* data, std::size_t count) {
  buffer.write(GL_ARRAY_BUFFER, data, count * sizeof(float));
  glVertexAttribPointer(attribute, 1, GL_FLOAT, GL_FALSE, 0, nullptr);
  glEnableVertexAttribArray(attribute);
}

void ClothMesh::prepare(List list, const ClothScene& scene) {
  IndexList& target = lists_[int(list)];
  if (target.ready) return;
  Indices indices;
  switch (list) {
    case List::triangles:
      indices = triangle_indices(lattice_, stride_, scene.tears);
      break;
    case List::straight:
      indices = spring_indices(lattice_, stride_, scene.tears, 0, 2);
      break;
    case List::diagonal:
      indices = spring_indices(lattice_, stride_, scene.tears, 2, stretch_directions);
      break;
    case List::bending:
      indices = spring_indices(lattice_, stride_, scene.tears, stretch_directions, int(directions.size()));
      break;
    case List::outlines:
      indices = outline_indices(lattice_, stride_, scene.tears);
      break;
    case List::connections:
      indices = connection_indices(lattice_, stride_, scene.tears);
      break;
    case List::particles:
      indices = particle_indices(lattice_, stride_, [](int, int) { return true; });
      break;
    case List::pins:
      if (scene.pinned) indices = particle_indices(lattice_, stride_, scene.pinned);
      break;
    case List::count:
      break;
  }
  if (longest_edge_ > 0 && list != List::particles && list != List::pins)
    remove_long(indices, list == List::triangles ? 3 : 2, floats_, longest_edge_);
  target.buffer.write(GL_ELEMENT_ARRAY_BUFFER, indices);
  target.count = GLsizei(indices.size());
  target.ready = true;
}

void ClothMesh::draw(List list, GLenum primitive) const {
  const IndexList& source = lists_[int(list)];
  if (source.count == 0) return;
  glBindVertexArray(array_.id());
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, source.buffer.id());
  glDrawElements(primitive, source.count, GL_UNSIGNED_INT, nullptr);
  glBindVertexArray(0);
}

void ClothMesh::draw_particle(int i, int j) const {
  if (!lattice_.contains(i, j) || stride_ == 0) return;
  glBindVertexArray(array_.id());
  glDrawArrays(GL_POINTS, i * stride_ + j, 1);
  glBindVertexArray(0);
}

}  // namespace tyglab
