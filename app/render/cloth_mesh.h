// The cloth's buffers: positions, either written by the engine's device, or where the engine stores them, or copied
// from its arrays; normals for lit views; and index lists.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

#include "app/render/camera.h"
#include "app/render/cloth_renderer.h"
#include "app/render/field_colors.h"
#include "app/render/gl_objects.h"
#include "app/render/vertex_memory.h"
#include "app/render/written_vertices.h"
#include "core/cloth/lattice.h"
#include "core/cloth/state.h"

// Normals for smooth shading, and the bounding box, of a cloth's vertices.

namespace tyglab {

/// A vector of every particle as the solver lays it out and the buffers hold it: row after row, each as its x, its y
/// and its z. Component c of particle (i, j) stands at i·stride() + j + c·component.
struct FloatRows {
  int rows = 0, columns = 0;
  int component = 0;  ///< from a row's x to its y and from its y to its z
  const float* data = nullptr;
  int absent = 0;  ///< at the end there are no particles (PositionView)
  int stride() const { return 3 * component; }
  std::size_t size() const { return std::size_t(rows) * std::size_t(stride()); }
  const float* row(int i, int c) const { return data + std::size_t(i) * stride() + std::size_t(c) * component; }
};

/// Of the eight triangles in the four quads round particle (i, j) those that are whole and have it as a corner: bit
/// ((row − i + 1)·2 + column − j + 1)·2 + which, by the quad's upper left corner and its triangle (quad_triangles).
std::uint32_t whole_triangles(const Lattice& lattice, const Tears& tears, int i, int j);

/// Normals on the front side, not of unit length: the cross product of the differences to the neighbors down and along
/// the row. Those of `beside_tears` are the sum over their whole triangles instead, so that the other side of a tear
/// does not count; without a whole triangle (0, 0, 1). `normals` are laid out as the positions are, and only written.
void compute_normals(const FloatRows& positions, const Tears& tears, std::span<const std::uint32_t> beside_tears,
                     float* normals);

/// The box of all finite components of particles.
Bounds finite_bounds(const FloatRows& positions);

// Connections between particles in a view: lists of vertex indices, where particle (i, j) is vertex i·stride + j.

using Indices = std::vector<std::uint32_t>;

/// Three indices for each whole triangle, counter-clockwise seen from the front.
Indices triangle_indices(const Lattice& lattice, int stride, const Tears& tears);
/// Two indices for each whole spring of the directions `first` to `last` (lattice.h), `last` not included.
Indices spring_indices(const Lattice& lattice, int stride, const Tears& tears, int first, int last);
/// Two indices for each edge of a whole triangle, each edge once.
Indices outline_indices(const Lattice& lattice, int stride, const Tears& tears);
/// Two indices for each whole stretch spring in a quad that has lost a triangle.
Indices connection_indices(const Lattice& lattice, int stride, const Tears& tears);
/// What closes the edges of a torn cloth, four indices a piece. A quad that has lost triangles shows one of its other
/// diagonal, if that is whole and its counterpart is not: a, b, c, a, counter-clockwise seen from the front. Beyond
/// each edge (a, b) of what is shown, threads end where a triangle is missing: c is the corner on this side, d the one
/// beyond. So they do on both sides of the cuts of a cloth that has parted.
Indices frayed_indices(const Lattice& lattice, int stride, const Tears& tears);
/// An index for each particle for which `wanted` holds.
Indices particle_indices(const Lattice& lattice, int stride, const std::function<bool(int, int)>& wanted);
/// Takes out what has an edge longer than `longest` m or not finite; `corners` indices stand for each triangle or line.
void remove_long(Indices& indices, int corners, const FloatRows& positions, float longest);
/// Particles, each once, that are a corner of a triangle that is not whole.
std::vector<std::uint32_t> particles_beside_tears(const Lattice& lattice, int stride, const Tears& tears);

class ClothMesh {
 public:
  /// `loans`: of the window.
  explicit ClothMesh(std::shared_ptr<PositionLoans> loans) : lent_(std::move(loans)) {}

  /// The index lists, each made when a view first needs it and thrown away with the topology.
  enum class List { triangles, frayed, straight, diagonal, bending, outlines, connections, particles, pins, count };

  /// Lends an engine memory to keep its positions in, so that they need not be copied.
  void lend(Engine& engine) { lent_.lend(engine); }
  /// Whether the engine's device can write the buffers itself: scenes may then have it as their writer.
  bool can_be_written(const Engine& engine) const { return written_.can(engine); }
  /// It could not after all, for that reason; nothing is written any more.
  void copy_from_now_on(const std::string& why) { written_.fail(why); }
  /// Why OpenGL must be given copies here, a part of a sentence; empty: for no reason of its own.
  std::string problem() const;
  /// Uploads positions if `moved` and whatever else this view lacks.
  void update(const ClothScene& scene, const ViewOptions& options, bool moved, bool topology_changed, RenderWork& work);
  /// Draws a list of triangles or particles that update() was asked for: GL_TRIANGLES or GL_POINTS.
  void draw(List list, GLenum primitive) const;
  /// Draws a list of lines with a program (lines.vert) in use that finds positions and lines in those texture units.
  void draw_lines(List list, int positions_unit, int lines_unit) const;
  /// Draws the edges of tears with a program (fray.vert) in use, likewise.
  void draw_frayed(int positions_unit, int normals_unit, int pieces_unit) const;
  /// Draws one particle as a point.
  void draw_particle(int i, int j) const;
  /// All that is drawn of this picture has been.
  void drawn();

  const Bounds& bounds() const { return bounds_; }
  int stride() const { return stride_; }
  /// Of all buffers here but lent ones, on either side of the bus.
  std::size_t bytes() const;
  const Lattice& lattice() const { return lattice_; }
  /// Binds the sites of copies, their column and row, to a texture unit.
  void bind_copy_sites(int unit) const { copy_sites_.bind(unit); }

 private:
  struct IndexList {
    gl::Buffer buffer;
    std::optional<TexelArray> texels;  ///< in its place, of what finds its positions itself
    GLsizei count = 0;
    bool ready = false;
  };
  void take(const ClothScene& scene, bool moved, bool normals, RenderWork& work);
  void take_positions(const PositionView& positions, bool moved, RenderWork& work);
  void have_written(const ClothScene& scene, bool moved, bool normals, RenderWork& work);
  VertexSource make_normals(const ClothScene& scene, RenderWork& work);
  void take_copies(const Tears& tears);
  void prepare(List list, const ClothScene& scene);
  void draw_pieces(List list, int indices, int positions_unit, int indices_unit) const;
  VertexSource copied(gl::Buffer& to, const float* data, RenderWork& work) const;
  void set_positions(const VertexSource& source);
  void set_normals(const VertexSource& source);
  void set_attributes(GLuint first, const VertexSource& source) const;

  gl::VertexArray array_, no_attributes_;
  gl::Buffer position_buffer_, normal_buffer_;  ///< of what is copied
  LentPositions lent_;
  MappedNormals mapped_normals_;
  WrittenVertices written_;
  VertexSource position_source_, normal_source_;  ///< of what is drawn
  TexelArray position_texels_{TexelArray::Of::floats}, normal_texels_{TexelArray::Of::floats};
  VertexPath vertex_path_ = VertexPath::copied;
  TexelArray copy_sites_{TexelArray::Of::index_pairs};
  std::array<IndexList, int(List::count)> lists_;
  std::vector<float> converted_;  ///< of a solver in double
  FloatRows floats_;              ///< valid during update() alone; without data where they are written
  std::vector<float> normals_;
  std::optional<std::vector<std::uint32_t>> beside_tears_;
  bool normals_ready_ = false, position_texels_ready_ = false, normal_texels_ready_ = false;
  float longest_edge_ = 0;
  Lattice lattice_;
  int stride_ = 0;
  Bounds bounds_;
};

}  // namespace tyglab
