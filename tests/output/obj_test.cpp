// OBJ files, read back by tinyobjloader and by assimp.
#include <doctest/doctest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <iterator>
#include <memory>
#include <sstream>

#include "core/output/obj.h"
#include "tests/support/files.h"
#include "tests/support/places.h"
#include "tests/support/scenes.h"

#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

namespace tyglab::obj_test {

/// A cloth in motion, cut a little, and one particle without any triangle.
std::unique_ptr<Simulation> cloth_with_cuts(int rows, int columns) {
  Preset preset = test::cloth(rows, columns);
  preset.W = {0, 0, 0.004};
  auto simulation = std::make_unique<Simulation>(preset);
  simulation->advance(150);
  if (rows > 4 && columns > 4) simulation->apply(edit::Cut{{{2, 2}, {3, 3}, {rows - 1, 0}, {rows - 1, 1}}});
  return simulation;
}

int whole_triangles(const Tears& tears) {
  int count = 0;
  for (int i = 0; i + 1 < tears.lattice().rows; ++i) {
    for (int j = 0; j + 1 < tears.lattice().columns; ++j) {
      for (int which = 0; which < 2; ++which) count += tears.triangle_whole(i, j, which) ? 1 : 0;
    }
  }
  return count;
}

tinyobj::ObjReader read_obj(const std::filesystem::path& file) {
  tinyobj::ObjReader reader;
  tinyobj::ObjReaderConfig config;
  config.triangulate = false;
  REQUIRE_MESSAGE(reader.ParseFromFile(file.string(), config), reader.Error());
  CHECK(reader.Warning() == "");
  return reader;
}

glm::dvec3 vector_at(const std::vector<tinyobj::real_t>& values, int n) {
  return {values[3 * n], values[3 * n + 1], values[3 * n + 2]};
}

TEST_CASE("tinyobjloader reads back every particle, normal, texture coordinate and whole triangle") {
  for (const auto& [rows, columns] : {std::pair{9, 7}, {2, 2}, {3, 4}}) {
    const test::TemporaryFolder folder;
    const auto owned = cloth_with_cuts(rows, columns);
    Simulation& simulation = *owned;
    const VectorField<double> x = simulation.read().x;
    write_obj(folder / "cloth.obj", simulation.tears(), x, {"A cloth", 3, 0.15, 25});
    const auto reader = read_obj(folder / "cloth.obj");
    const auto& attributes = reader.GetAttrib();
    const std::size_t count = std::size_t(rows) * columns;
    REQUIRE(attributes.vertices.size() == 3 * count);
    REQUIRE(attributes.normals.size() == 3 * count);
    REQUIRE(attributes.texcoords.size() == 2 * count);
    for (int p = 0; p < int(count); ++p) {
      CHECK(glm::length(vector_at(attributes.vertices, p) - glm::dvec3(x.x[p], x.y[p], x.z[p])) < 1e-6);
      CHECK(glm::length(vector_at(attributes.normals, p)) == doctest::Approx(1).epsilon(1e-6));
      const int i = p / columns, j = p % columns;
      CHECK(attributes.texcoords[2 * p] == doctest::Approx(double(j) / (columns - 1)).epsilon(1e-6));
      CHECK(attributes.texcoords[2 * p + 1] == doctest::Approx(1 - double(i) / (rows - 1)).epsilon(1e-6));
    }
    REQUIRE(reader.GetShapes().size() == 1);
    const auto& mesh = reader.GetShapes()[0].mesh;
    CHECK(int(mesh.num_face_vertices.size()) == whole_triangles(simulation.tears()));
    if (rows == 9) CHECK(int(mesh.num_face_vertices.size()) < 2 * (rows - 1) * (columns - 1));
    for (std::size_t f = 0; f < mesh.num_face_vertices.size(); ++f) {
      REQUIRE(int(mesh.num_face_vertices[f]) == 3);
      glm::dvec3 corner[3];
      glm::dvec3 normals(0);
      int index[3];
      for (int c = 0; c < 3; ++c) {
        const auto& at = mesh.indices[3 * f + std::size_t(c)];
        CHECK(at.vertex_index == at.normal_index);
        CHECK(at.vertex_index == at.texcoord_index);
        index[c] = at.vertex_index;
        corner[c] = vector_at(attributes.vertices, at.vertex_index);
        normals += vector_at(attributes.normals, at.normal_index);
      }
      const glm::dvec3 N = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
      // Smooth normals on a gently moving cloth lean the way of their triangles.
      CHECK(glm::dot(N, normals) > 0);
      // Counter-clockwise from the front: (row, column) of the corners turn the same way in every triangle.
      const auto row = [&](int c) { return index[c] / columns; };
      const auto column = [&](int c) { return index[c] % columns; };
      const int turn = (row(1) - row(0)) * (column(2) - column(0)) - (column(1) - column(0)) * (row(2) - row(0));
      CHECK(turn == 1);
    }
  }
}

TEST_CASE("the front of a hanging cloth faces +z, as its normals do") {
  Simulation simulation(test::quiet_cloth(5, 6));
  const auto normals = vertex_normals(simulation.tears(), simulation.read().x);
  for (const glm::dvec3& N : normals) CHECK(glm::length(N - glm::dvec3(0, 0, 1)) < 1e-12);
  // From behind, the other way round.
  Preset turned = test::quiet_cloth(5, 6);
  turned.tilt_deg = 0;
  Simulation flat(turned);
  for (const glm::dvec3& N : vertex_normals(flat.tears(), flat.read().x)) {
    CHECK(glm::length(N - glm::dvec3(0, 1, 0)) < 1e-12);
  }
}

TEST_CASE("a vertex in no whole triangle has the normal (0, 0, 1)") {
  Preset preset = test::quiet_cloth(4, 4);
  preset.tilt_deg = 0;
  Simulation simulation(preset);
  simulation.apply(edit::Cut{{{1, 0}, {1, 1}, {1, 2}, {1, 3}}});
  const auto normals = vertex_normals(simulation.tears(), simulation.read().x);
  for (int j = 0; j < 4; ++j) CHECK(normals[j] == glm::dvec3(0, 0, 1));
  for (int j = 4; j < 16; ++j) CHECK(normals[j] == glm::dvec3(0, 1, 0));
  // A thread has no triangles at all.
  const test::TemporaryFolder folder;
  Simulation thread(test::cloth(5, 1));
  write_obj(folder / "thread.obj", thread.tears(), thread.read().x, {"Thread", 0, 0, 25});
  const std::string text = test::read_file(folder / "thread.obj");
  CHECK(text.find("\nf ") == text.npos);
  CHECK(text.ends_with("\nl 1 2\nl 2 3\nl 3 4\nl 4 5\n"));
  for (const std::string& line : test::lines(text)) {
    if (line.starts_with("vt ")) CHECK(line.starts_with("vt 0 "));
    if (line.starts_with("vn ")) CHECK(line == "vn 0 0 1");
  }
}

/// What assimp makes of an OBJ file, as the lines of a PLY file: header, vertices with normals, faces.
struct Ply {
  std::vector<std::vector<double>> vertices;  ///< x y z nx ny nz s t
  std::vector<std::vector<int>> faces;        ///< a count and corners; of a line there are two
};

Ply read_with_assimp(const test::TemporaryFolder& folder, const std::filesystem::path& obj) {
  const auto outcome = test::run(folder.path(), {test::assimp, "export", obj.string(), "mesh.ply"});
  REQUIRE_MESSAGE(outcome.code == 0, outcome.out);
  Ply ply;
  bool body = false;
  std::size_t vertices = 0;
  for (const std::string& line : test::lines(test::read_file(folder / "mesh.ply"))) {
    std::istringstream in(line);
    if (line.starts_with("element vertex ")) vertices = std::stoul(line.substr(15));
    if (body && ply.vertices.size() < vertices) {
      ply.vertices.emplace_back(std::istream_iterator<double>(in), std::istream_iterator<double>());
    } else if (body) {
      ply.faces.emplace_back(std::istream_iterator<int>(in), std::istream_iterator<int>());
    }
    body = body || line == "end_header";
  }
  return ply;
}

TEST_CASE("assimp reads every triangle with unit normals on its front side") {
  const test::TemporaryFolder folder;
  const auto owned = cloth_with_cuts(9, 7);
  Simulation& simulation = *owned;
  write_obj(folder / "cloth.obj", simulation.tears(), simulation.read().x, {"A cloth", 0, 0, 25});
  Ply ply = read_with_assimp(folder, folder / "cloth.obj");
  std::erase_if(ply.faces, [](const auto& face) { return face.size() == 3; });
  CHECK(int(ply.faces.size()) == whole_triangles(simulation.tears()));
  CHECK(ply.vertices.size() >= 60);  // all but those in no whole triangle, or one for every corner
  for (const auto& face : ply.faces) {
    REQUIRE(face.size() == 4);
    glm::dvec3 corner[3], normals(0);
    for (int c = 0; c < 3; ++c) {
      const auto& v = ply.vertices.at(std::size_t(face[std::size_t(c) + 1]));
      REQUIRE(v.size() == 8);
      corner[c] = {v[0], v[1], v[2]};
      const glm::dvec3 normal(v[3], v[4], v[5]);
      CHECK(glm::length(normal) == doctest::Approx(1).epsilon(1e-5));
      normals += normal;
    }
    CHECK(glm::dot(glm::cross(corner[1] - corner[0], corner[2] - corner[0]), normals) > 0);
  }
}

TEST_CASE("threads in no whole triangle are lines, which assimp and tinyobjloader read") {
  const test::TemporaryFolder folder;
  // The two lowest rows of a sheet of three columns lose their outer triangles' springs: some threads stay.
  Simulation simulation(test::quiet_cloth(4, 3));
  simulation.apply(edit::CutSprings{{{2, 2, 0}, {3, 2, 1}, {2, 2, 1}, {3, 2, 2}}});
  write_obj(folder / "cloth.obj", simulation.tears(), simulation.read().x, {"Torn", 0, 0, 25});
  std::vector<std::string> threads;
  for (const std::string& line : test::lines(test::read_file(folder / "cloth.obj")))
    if (line.starts_with("l ")) threads.push_back(line);
  // Rows 2 and 3 are numbered 7 8 9 and 10 11 12: what is left between them are the threads downward and along row 3.
  CHECK(threads == std::vector<std::string>{"l 7 10", "l 8 11", "l 9 12", "l 10 11", "l 11 12"});
  const auto reader = read_obj(folder / "cloth.obj");
  CHECK(reader.GetShapes()[0].lines.num_line_vertices.size() == threads.size());
  Simulation thread(test::cloth(5, 1));
  write_obj(folder / "thread.obj", thread.tears(), thread.read().x, {"Thread", 0, 0, 25});
  for (const auto& [name, count] : {std::pair{"cloth.obj", threads.size()}, {"thread.obj", std::size_t(4)}}) {
    const Ply ply = read_with_assimp(folder, folder / name);
    CHECK(std::size_t(std::count_if(ply.faces.begin(), ply.faces.end(),
                                    [](const auto& face) { return face.size() == 3; })) == count);
  }
}

TEST_CASE("a material with its image is read by tinyobjloader") {
  const test::TemporaryFolder folder;
  Simulation simulation(test::quiet_cloth(3, 3));
  test::write_file(folder / "cloth.mtl", material_text("cloth.png"));
  write_obj(folder / "cloth.obj", simulation.tears(), simulation.read().x, {"A cloth", 0, 0, 25, "cloth.mtl"});
  const auto reader = read_obj(folder / "cloth.obj");
  REQUIRE(reader.GetMaterials().size() == 1);
  CHECK(reader.GetMaterials()[0].diffuse_texname == "cloth.png");
  for (const int material : reader.GetShapes()[0].mesh.material_ids) CHECK(material == 0);
  CHECK(material_text("").find("map_Kd") == std::string::npos);
}

TEST_CASE("the comments tell frame, time and frame rate, whatever the preset is called") {
  Simulation simulation(test::quiet_cloth(3, 3));
  const std::string text = obj_text(simulation.tears(), simulation.read().x, {"Evil\nv 9 9 9\r\nname", 12, 0.5, 30});
  int vertices = 0;
  for (const std::string& line : test::lines(text)) vertices += line.starts_with("v ") ? 1 : 0;
  CHECK(vertices == 9);
  for (const char* part : {"frame 12", "0.5 s", "30"}) CHECK(text.find(part) != text.npos);
  const std::string alone = obj_text(simulation.tears(), simulation.read().x, {.name = "alone", .t = 0.5, .fps = 0});
  CHECK(alone.starts_with("# Tyglab: alone\n# t = 0.5 s\no cloth\nv "));
}

TEST_CASE("the files of a sequence sort as its frames do") {
  CHECK(frame_name("denim", 42, 100, "obj") == "denim_0042.obj");
  CHECK(frame_name("denim", 0, 1, "png") == "denim_0000.png");
  CHECK(frame_name("denim", 42, 123456, "obj") == "denim_000042.obj");
  CHECK(is_frame_name(frame_name("denim", 42, 100, "obj"), "denim", "obj"));
  for (const char* other :
       {"denim_.obj", "denim_00a2.obj", "denim_0042.png", "denim_0042.obj.incomplete", "flag_0042.obj"})
    CHECK_FALSE(is_frame_name(other, "denim", "obj"));
  CHECK(frame_name("denim", 9, 10001, "obj") < frame_name("denim", 10000, 10001, "obj"));
}

}  // namespace tyglab::obj_test
