#include "core/output/obj.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/io/output_file.h"
#include "core/io/terminal.h"

namespace tyglab {
namespace {

/// Whether a whole stretch spring is a thread of its own: no whole triangle has it as an edge or, of a diagonal that
/// crosses its quad's other one, shares its quad.
bool is_lone(const Tears& tears, int direction, int i, int j) {
  const Direction& to = directions[std::size_t(direction)];
  const int first_i = std::min(i, i + to.di), first_j = std::min(j, j + to.dj);
  const bool diagonal = to.di != 0 && to.dj != 0;
  const auto has_edge = [&](const auto& corners, int qi, int qj) {
    const auto is_corner = [&](int pi, int pj) {
      return std::any_of(corners.begin(), corners.end(),
                         [&](const Corner& corner) { return qi + corner.di == pi && qj + corner.dj == pj; });
    };
    return is_corner(i, j) && is_corner(i + to.di, j + to.dj);
  };
  const Lattice& lattice = tears.lattice();
  for (int qi = first_i - (to.di == 0 ? 1 : 0); qi <= first_i; ++qi)
    for (int qj = first_j - (to.dj == 0 ? 1 : 0); qj <= first_j; ++qj) {
      if (qi < 0 || qj < 0 || qi + 1 >= lattice.rows || qj + 1 >= lattice.columns) continue;
      for (int which = 0; which < 2; ++which)
        if (tears.triangle_whole(qi, qj, which) && (diagonal || has_edge(quad_triangles[(qi + qj) & 1][which], qi, qj)))
          return false;
    }
  return true;
}

/// Calls visit(p0, p1) for every thread that is part of no whole triangle.
template <class Visit>
void for_lone_threads(const Tears& tears, Visit visit) {
  const Lattice& lattice = tears.lattice();
  if ((tears.untorn() || tears.mesh() != nullptr) && lattice.columns > 1) return;
  for (int i = 0; i < lattice.rows; ++i)
    for (int j = 0; j < lattice.columns; ++j)
      for (int d = 0; d < stretch_directions; ++d) {
        const int to_i = i + directions[d].di, to_j = j + directions[d].dj;
        if (!lattice.contains(to_i, to_j) || !tears.whole(d, i, j) || !is_lone(tears, d, i, j)) continue;
        visit(std::size_t(i) * lattice.columns + j, std::size_t(to_i) * lattice.columns + to_j);
      }
}

void append_line(std::string& text, std::string_view keyword, std::initializer_list<double> values) {
  constexpr int digits = 9;  // every float comes back exactly, and programs that read OBJ hold floats
  text += keyword;
  for (const double value : values) {
    text += ' ';
    append_number(text, value, digits);
  }
  text += '\n';
}

/// A comment ends with its line, so a name must not hold line breaks.
std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' '; }, ' ');
  return text;
}

}  // namespace

std::vector<glm::dvec3> vertex_normals(const Tears& tears, const VectorField<double>& x) {
  std::vector<glm::dvec3> normals(std::size_t(tears.particles()), glm::dvec3(0));
  const auto at = [&](int p) { return glm::dvec3(x.x[std::size_t(p)], x.y[std::size_t(p)], x.z[std::size_t(p)]); };
  for_each_triangle(tears, [&](int a, int b, int c, int, int, int) {
    // The cross product is along the normal and as long as twice the area: the weight comes by itself.
    const glm::dvec3 weighted = glm::cross(at(b) - at(a), at(c) - at(a));
    for (const int p : {a, b, c}) normals[std::size_t(p)] += weighted;
  });
  for (glm::dvec3& normal : normals) {
    const double length = std::hypot(normal.x, normal.y, normal.z);
    normal = length > 0 && std::isfinite(length) ? normal / length : glm::dvec3(0, 0, 1);
  }
  return normals;
}

std::string obj_text(const Tears& tears, const VectorField<double>& x, const ObjFrame& frame) {
  const Lattice sites = tears.lattice().sites();
  const bool in_sequence = frame.fps > 0;
  std::string text = "# Tyglab: " + one_line(frame.name) + "\n# ";
  if (in_sequence) text += "frame " + std::to_string(frame.frame) + ", ";
  text += "t = ";
  append_number(text, frame.t, 9);
  text += " s";
  if (in_sequence) {
    text += ", frame rate ";
    append_number(text, frame.fps, 9);
    text += " frames per second";
  }
  text += '\n';
  if (!frame.material.empty()) text += "mtllib " + frame.material + '\n';
  text += "o cloth\n";

  for (std::size_t p = 0; p < std::size_t(tears.particles()); ++p) {
    for (const double value : {x.x[p], x.y[p], x.z[p]}) float_coordinate(value);
    append_line(text, "v", {x.x[p], x.y[p], x.z[p]});
  }
  for (int p = 0; p < tears.particles(); ++p) {
    const Pins::Site at = tears.site(p);
    append_line(text, "vt",
                {sites.columns > 1 ? double(at.j) / (sites.columns - 1) : 0.0, 1 - double(at.i) / (sites.rows - 1)});
  }
  for (const glm::dvec3& n : vertex_normals(tears, x)) append_line(text, "vn", {n.x, n.y, n.z});
  if (!frame.material.empty()) text += "usemtl cloth\n";
  for_each_triangle(tears, [&](int a, int b, int c, int, int, int) {
    text += 'f';
    for (const int p : {a, b, c}) {
      const std::string number = std::to_string(p + 1);
      text += ' ' + number + '/' + number + '/' + number;
    }
    text += '\n';
  });
  for_lone_threads(tears, [&](std::size_t a, std::size_t b) {
    text += "l " + std::to_string(a + 1) + ' ' + std::to_string(b + 1) + '\n';
  });
  return text;
}

std::string material_text(const std::string& image) {
  return "# Tyglab\nnewmtl cloth\nKd 1 1 1\n" + (image.empty() ? "" : "map_Kd " + image + '\n');
}

void write_obj(const std::filesystem::path& file, const Tears& tears, const VectorField<double>& x,
               const ObjFrame& frame) {
  write_atomically(file, obj_text(tears, x, frame));
}

std::string frame_name(std::string_view prefix, std::int64_t frame, std::int64_t count, std::string_view extension) {
  const std::size_t width = std::max<std::size_t>(4, std::to_string(std::max<std::int64_t>(count - 1, 0)).size());
  std::string number = std::to_string(frame);
  number.insert(0, width - std::min(width, number.size()), '0');
  return std::string(prefix) + '_' + number + '.' + std::string(extension);
}

bool is_frame_name(std::string_view name, std::string_view prefix, std::string_view extension) {
  const std::string begin = std::string(prefix) + '_', end = '.' + std::string(extension);
  if (name.size() <= begin.size() + end.size() || !name.starts_with(begin) || !name.ends_with(end)) return false;
  name = name.substr(begin.size(), name.size() - begin.size() - end.size());
  return name.find_first_not_of("0123456789") == std::string_view::npos;
}

}  // namespace tyglab
