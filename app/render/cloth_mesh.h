// The cloth's buffers: positions, either written by the engine's device, or where the engine stores them, or copied
// from its arrays; normals for lit views; and index lists.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <optional>

#include "app/render/camera.h"
#include "app/render/cloth_renderer.h"
#include "app/render/cloth_topology.h"
#include "app/render/gl_objects.h"
#include "app/render/texel_array.h"
#include "app/render/vertex_memory.h"
#include "app/render/vertex_normals.h"
#include "app/render/written_vertices.h"

namespace tyglab {

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
