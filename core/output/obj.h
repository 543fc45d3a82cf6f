// OBJ: the cloth as a mesh for other programs (2.4.5), one file per frame.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/cloth/lattice.h"
#include "core/cloth/state.h"

namespace tyglab {

/// What a frame's file says of itself in its comments.
struct ObjFrame {
  std::string name;           ///< of the preset
  int frame = 0;              ///< number of the frame, the first is 0
  double t = 0;               ///< s
  double fps = 25;            ///< frames a second of simulated time; 0: it is no frame of a sequence
  std::string material = {};  ///< name of the file with the cloth's material, beside it; empty: it has none
};

/// Unit vertex normals over i·columns + j: the normals of a particle's whole triangles, weighted by their areas. A
/// particle in no whole triangle (or only in triangles without area) has (0, 0, 1).
std::vector<glm::dvec3> vertex_normals(const Tears& tears, const VectorField<double>& x);

/// The mesh as text: v, vt and vn of every particle in row order, every whole triangle as f v/vt/vn, counter-clockwise
/// seen from the front, and every whole stretch spring without a whole triangle as l v v. Positions in m.
std::string obj_text(const Tears& tears, const VectorField<double>& x, const ObjFrame& frame);

/// The file of the material, with an image beside it; empty: without one.
std::string material_text(const std::string& image);

/// Writes it, whole or not at all. Throws OutputError.
void write_obj(const std::filesystem::path& file, const Tears& tears, const VectorField<double>& x,
               const ObjFrame& frame);

/// "PREFIX_0042.EXTENSION": the name of one file of a sequence of `count` frames, padded with zeros to the width of
/// the last number and to at least four digits, so that names sort as frames do.
std::string frame_name(std::string_view prefix, std::int64_t frame, std::int64_t count, std::string_view extension);
/// Whether a frame of such a sequence can be called that, however many it has.
bool is_frame_name(std::string_view name, std::string_view prefix, std::string_view extension);

}  // namespace tyglab
