#include "app/render/cloth_mesh.h"

#include <algorithm>

namespace tyglab {
namespace {

using List = ClothMesh::List;

/// Whether a view draws that list.
bool needs(const ViewOptions& options, List list) {
  switch (list) {
    case List::triangles:
    case List::frayed:
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

/// Whether its vertices find their positions in a texture themselves.
bool of_texels(List list) {
  return list != List::triangles && list != List::particles && list != List::pins;
}

}  // namespace

void ClothMesh::update(const ClothScene& scene, const ViewOptions& options, bool moved, bool topology_changed,
                       RenderWork& work) {
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
    take_copies(scene.tears);
  }
  glBindVertexArray(array_.id());
  const bool needs_normals = options.lit() && (moved || !normals_ready_);
  floats_ = {view.rows, view.columns, view.stride / 3, view.f[0], scene.lattice.size() - scene.tears.particles()};
  if (scene.writer)
    have_written(scene, moved, needs_normals, work);
  else
    take(scene, moved, needs_normals, work);
  work.moved |= moved;
  work.vertex_path = vertex_path_;
  normals_ready_ = needs_normals || (normals_ready_ && !moved);
  const Stopwatch watch(work.index_lists);
  bool texels = false;
  for (int list = 0; list < int(List::count); ++list) {
    if (!needs(options, List(list))) continue;
    prepare(List(list), scene);
    texels |= of_texels(List(list)) && lists_[std::size_t(list)].count > 0;
  }
  if (texels && !position_texels_ready_) {
    position_texels_.take(position_source_, floats_.size());
    position_texels_ready_ = true;
  }
  if (options.lit() && lists_[int(List::frayed)].count > 0 && !normal_texels_ready_) {
    normal_texels_.take(normal_source_, floats_.size());
    normal_texels_ready_ = true;
  }
  glBindVertexArray(0);
}

/// The sites of copies, at which they have their place in the texture.
void ClothMesh::take_copies(const Tears& tears) {
  std::vector<std::uint32_t> sites;
  for (int n = lattice_.sites().size(); n < tears.particles(); ++n) {
    const Pins::Site site = tears.site(n);
    sites.push_back(std::uint32_t(site.j)), sites.push_back(std::uint32_t(site.i));
  }
  if (sites.empty()) sites.assign(2, 0);  // a shader must have some
  copy_sites_.take(sites.data(), sites.size() / 2);
}

/// Positions from the engine's memory, where they lie or by a copy.
void ClothMesh::take(const ClothScene& scene, bool moved, bool normals, RenderWork& work) {
  take_positions(scene.positions, moved, work);
  if (moved) {
    written_.free();
    const auto lent = lent_.show(floats_.data);
    vertex_path_ = lent ? VertexPath::shared_memory : VertexPath::copied;
    set_positions(lent ? *lent : copied(position_buffer_, floats_.data, work));
  }
  if (normals) set_normals(make_normals(scene, work));
}

void ClothMesh::take_positions(const PositionView& view, bool moved, RenderWork& work) {
  if (view.f[0] == nullptr) {
    converted_.resize(floats_.size());
    if (moved) {
      std::transform(view.d[0], view.d[0] + converted_.size(), converted_.begin(), [](double v) { return float(v); });
      work.copied += converted_.size() * sizeof(float);
    }
    floats_.data = converted_.data();
  }
  if (moved) bounds_ = finite_bounds(floats_);
}

/// Positions, and normals if asked for, as the engine's device writes them into buffers of their own.
void ClothMesh::have_written(const ClothScene& scene, bool moved, bool normals, RenderWork& work) {
  if (!moved && !normals) return;
  if (vertex_path_ != VertexPath::shared_buffer) beside_tears_.reset();  // the device has not been informed of them
  if (normals && !beside_tears_) {
    beside_tears_ = particles_beside_tears(lattice_, stride_, scene.tears);
    std::vector<TornSite> torn;
    for (const std::uint32_t index : *beside_tears_) {
      const int i = int(index) / stride_, j = int(index) % stride_;
      torn.push_back({std::uint32_t(i * lattice_.columns + j), whole_triangles(lattice_, scene.tears, i, j)});
    }
    written_.set_tears(std::move(torn));
  }
  const Stopwatch watch(work.upload);
  bounds_ = written_.write(*scene.writer->engine->vertex_sharing(), {scene.writer->sites, normals}, work.read);
  lent_.show(nullptr);
  mapped_normals_.free();
  vertex_path_ = VertexPath::shared_buffer;
  set_positions(written_.positions());
  if (normals) set_normals(written_.normals());
}

/// Computes them where they are drawn, or else copies them there.
VertexSource ClothMesh::make_normals(const ClothScene& scene, RenderWork& work) {
  float* in_place =
      vertex_path_ == VertexPath::shared_memory ? mapped_normals_.next(floats_.size() * sizeof(float)) : nullptr;
  if (in_place == nullptr) mapped_normals_.free(), normals_.resize(floats_.size());
  {
    const Stopwatch watch(work.normals);
    if (!beside_tears_) beside_tears_ = particles_beside_tears(lattice_, stride_, scene.tears);
    compute_normals(floats_, scene.tears, *beside_tears_, in_place != nullptr ? in_place : normals_.data());
  }
  return in_place != nullptr ? mapped_normals_.source() : copied(normal_buffer_, normals_.data(), work);
}

std::string ClothMesh::problem() const {
  for (const std::string* problem : {&written_.problem(), &lent_.problem(), &mapped_normals_.problem()})
    if (!problem->empty()) return *problem;
  return {};
}

void ClothMesh::drawn() {
  lent_.drawn(), mapped_normals_.drawn();
}

std::size_t ClothMesh::bytes() const {
  std::size_t total = (converted_.capacity() + normals_.capacity()) * sizeof(float);
  for (const gl::Buffer* buffer : {&position_buffer_, &normal_buffer_}) total += std::size_t(buffer->bytes());
  for (const IndexList& list : lists_)
    total += std::size_t(list.buffer.bytes()) + (list.texels ? list.texels->bytes() : 0);
  return total + mapped_normals_.bytes() + written_.bytes() + position_texels_.bytes() + normal_texels_.bytes() +
         copy_sites_.bytes();
}

/// Copies a vector of every particle.
VertexSource ClothMesh::copied(gl::Buffer& to, const float* data, RenderWork& work) const {
  const Stopwatch watch(work.upload);
  to.write(GL_ARRAY_BUFFER, data, floats_.size() * sizeof(float));
  work.copied += floats_.size() * sizeof(float);
  return {to.id(), 0};
}

void ClothMesh::set_positions(const VertexSource& source) {
  set_attributes(0, source);
  position_source_ = source;
  position_texels_ready_ = false;
}

void ClothMesh::set_normals(const VertexSource& source) {
  set_attributes(3, source);
  normal_source_ = source;
  normal_texels_ready_ = false;
}

/// Names the components of a vector of every particle `first` to `first` + 2 for the shaders.
void ClothMesh::set_attributes(GLuint first, const VertexSource& source) const {
  glBindBuffer(GL_ARRAY_BUFFER, source.buffer);
  for (GLuint c = 0; c < 3; ++c) {
    const std::size_t offset = source.offset + c * std::size_t(floats_.component) * sizeof(float);
    glVertexAttribPointer(first + c, 1, GL_FLOAT, GL_FALSE, 0, reinterpret_cast<const void*>(offset));
    glEnableVertexAttribArray(first + c);
  }
}

void ClothMesh::prepare(List list, const ClothScene& scene) {
  IndexList& target = lists_[int(list)];
  if (target.ready) return;
  Indices indices;
  switch (list) {
    case List::triangles:
      indices = triangle_indices(lattice_, stride_, scene.tears);
      break;
    case List::frayed:
      if (longest_edge_ == 0) indices = frayed_indices(lattice_, stride_, scene.tears);
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
      indices = particle_indices(lattice_, stride_,
                                 [&](int i, int j) { return i * lattice_.columns + j < scene.tears.particles(); });
      break;
    case List::pins:
      if (scene.pinned) indices = particle_indices(lattice_, stride_, scene.pinned);
      break;
    case List::count:
      break;
  }
  if (longest_edge_ > 0 && (of_texels(list) || list == List::triangles))
    remove_long(indices, list == List::triangles ? 3 : 2, floats_, longest_edge_);
  if (of_texels(list)) {
    if (!target.texels) target.texels.emplace(TexelArray::Of::index_pairs);
    target.texels->take(indices.data(), indices.size() / 2);
  } else {
    target.buffer.write(GL_ELEMENT_ARRAY_BUFFER, indices);
  }
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

void ClothMesh::draw_lines(List list, int positions_unit, int lines_unit) const {
  draw_pieces(list, 2, positions_unit, lines_unit);
}

void ClothMesh::draw_frayed(int positions_unit, int normals_unit, int pieces_unit) const {
  normal_texels_.bind(normals_unit);
  draw_pieces(List::frayed, 4, positions_unit, pieces_unit);
}

/// Two triangles for each piece of so many indices.
void ClothMesh::draw_pieces(List list, int indices, int positions_unit, int indices_unit) const {
  const IndexList& source = lists_[int(list)];
  if (source.count == 0) return;
  position_texels_.bind(positions_unit);
  source.texels->bind(indices_unit);
  glBindVertexArray(no_attributes_.id());
  glDrawArrays(GL_TRIANGLES, 0, 6 * (source.count / indices));
  glBindVertexArray(0);
}

void ClothMesh::draw_particle(int i, int j) const {
  if (!lattice_.contains(i, j) || stride_ == 0) return;
  glBindVertexArray(array_.id());
  glDrawArrays(GL_POINTS, i * stride_ + j, 1);
  glBindVertexArray(0);
}

}  // namespace tyglab
