// The five views of 2.4, drawn without a window and counted in pixels.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <set>
#include <span>
#include <vector>

#include "app/platform/platform.h"
#include "app/render/cloth_mesh.h"
#include "app/render/cloth_renderer.h"
#include "app/render/field_colors.h"
#include "tests/support/files.h"
#include "tests/support/places.h"
#include "tests/support/scenes.h"

namespace tyglab::renderer_test {

constexpr int width = 320, height = 240;

/// Draws a scene from the front, without ground and shadows, so that every pixel is the cloth's or the background's.
class Stage {
 public:
  Stage() {
    options_.ground = options_.shadows = false;
    options_.samples = 1;
    // A camera of the test's own: it must not move with the cloth.
    camera_.yaw = camera_.pitch = 0;
    camera_.target = {0, 0.9f, 0};
    camera_.distance = 0.6f;
  }
  Image draw(Simulation& simulation, int mode, bool bending = false, std::span<const Ghost> ghosts = {}) {
    options_.mode = mode;
    options_.bending = bending;
    renderer_.update(simulation, options_);
    renderer_.draw(camera_, options_, width, height, ghosts);
    return renderer_.pixels();
  }
  ClothRenderer& renderer() { return renderer_; }
  ViewOptions& options() { return options_; }
  Camera& camera() { return camera_; }

 private:
  HeadlessContext context_;
  ClothRenderer renderer_;
  ViewOptions options_;
  Camera camera_;
};

/// Pixels that clearly differ: by more than that in one of their colors.
int difference(const Image& a, const Image& b, int threshold = 12) {
  REQUIRE(a.rgb.size() == b.rgb.size());
  int count = 0;
  for (std::size_t p = 0; p < a.rgb.size(); p += 3) {
    int most = 0;
    for (std::size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(int(a.rgb[p + c]) - int(b.rgb[p + c])));
    count += most > threshold ? 1 : 0;
  }
  return count;
}

/// A hanging cloth in the middle of the picture.
Preset hanging() {
  Preset preset = test::quiet_cloth(9, 9);
  preset.pins.mode = Pins::Mode::none;
  preset.x_0 = {0, 1.02, 0};
  return preset;
}

/// The same picture without the cloth: it is far behind the camera.
Preset away() {
  Preset preset = hanging();
  preset.x_0 = {0, 0, 500};
  return preset;
}

TEST_CASE("another cloth is drawn over the first as lines of its own color") {
  Stage stage;
  Preset apart = hanging();
  apart.x_0.x += 0.05;
  Simulation simulation(hanging()), copy(apart);
  const Image alone = stage.draw(simulation, 1);
  for (const glm::vec3 color : {glm::vec3(1, 0, 0), glm::vec3(0, 0, 1)}) {
    ClothRenderer its(stage.renderer());
    ViewOptions lines = stage.options();
    lines.mode = 4;
    its.update(copy, lines);
    const Ghost ghost{&its, color};
    const Image both = stage.draw(simulation, 1, false, {&ghost, 1});
    const int changed = difference(alone, both);
    CHECK(changed > 500);
    CHECK(changed < width * height / 4);  // lines, not faces
    int of_that_color = 0;
    for (std::size_t p = 0; p < both.rgb.size(); p += 3) {
      const glm::ivec3 now(both.rgb[p], both.rgb[p + 1], both.rgb[p + 2]);
      const int wanted = color.x > 0 ? now.x : now.z, other = color.x > 0 ? now.z : now.x;
      of_that_color += wanted > 180 && other < 90 && now.y < 90 ? 1 : 0;
    }
    CHECK(of_that_color > changed / 2);
  }
}

TEST_CASE("views 1 to 5 show what they should") {
  Stage stage;
  Simulation simulation(hanging()), nothing(away());
  const Image empty = stage.draw(nothing, 1);
  int drawn[6] = {};
  Image images[6];
  for (int mode = 1; mode <= 5; ++mode) {
    images[mode] = stage.draw(simulation, mode);
    drawn[mode] = difference(images[mode], empty);
    CHECK(images[mode].width == width);
    CHECK(images[mode].height == height);
  }
  // The cloth covers 0.24 m of the 0.385 m that the picture is high, so about 150 pixels square.
  CHECK(drawn[1] > 140 * 140);
  CHECK(drawn[1] < 165 * 165);
  CHECK(difference(images[1], images[3]) == 0);  // nothing is torn
  for (const int lines : {2, 4, 5}) {
    CAPTURE(lines);
    CHECK(drawn[lines] > 300);
    CHECK(drawn[lines] < drawn[1]);
  }
  CHECK(drawn[5] < drawn[2]);
  CHECK(drawn[5] < drawn[4]);
  for (const auto& [a, b] : {std::pair{1, 2}, {1, 4}, {1, 5}, {2, 4}, {2, 5}, {4, 5}}) {
    CHECK(difference(images[a], images[b]) > 200);
  }
}

TEST_CASE("torn triangles are not drawn in view 1, and are threads in view 3; a torn spring is no line in view 2") {
  Stage stage;
  Simulation simulation(hanging()), nothing(away());
  const Image empty = stage.draw(nothing, 1);
  int before[6] = {}, after[6] = {};
  for (int mode = 1; mode <= 4; ++mode) before[mode] = difference(stage.draw(simulation, mode), empty);
  std::vector<Pins::Site> row;
  for (int j = 0; j < 9; ++j) row.push_back({4, j});
  simulation.apply(edit::Cut{row});
  stage.options().longest_edge = 10;  // draws no threads at the edges
  // One of eight rows of quads is gone.
  const int triangles = difference(stage.draw(simulation, 1), empty);
  CHECK(triangles == doctest::Approx(before[1] * 7 / 8.0).epsilon(0.03));
  stage.options().longest_edge = 0;
  for (int mode = 1; mode <= 4; ++mode) after[mode] = difference(stage.draw(simulation, mode), empty);
  CHECK(after[1] > triangles + before[1] / 8 / 5);  // the edges are frayed,
  CHECK(after[1] < triangles + before[1] / 8 / 2);  // and the cut is seen
  stage.renderer().set_color_map(map_colors({}, 16));
  stage.renderer().set_values(std::vector<float>(81, 1.0f), 9, 9);
  stage.options().colored = ValueRange{};
  CHECK(difference(stage.draw(simulation, 1), empty) == doctest::Approx(after[1]).epsilon(0.03));
  CHECK(after[2] < before[2]);
  CHECK(after[4] < before[4]);
  CHECK(after[3] <= after[1] + 400);  // the springs along the edges of the cut are whole, and lie on them
  CHECK(after[3] >= after[1]);
}

TEST_CASE("a torn edge has threads, and is closed along the other diagonal of a quad") {
  constexpr int stride = 10;
  constexpr std::uint32_t upper_left = 0, upper_right = 1, lower_left = 10, lower_right = 11;
  const Lattice quad{2, 2};
  Tears tears(quad);
  CHECK(frayed_indices(quad, stride, tears).empty());
  tears.tear(0, 0, 0);  // the upper edge
  const Indices triangle{upper_right, lower_left, lower_right, upper_right},
      its_threads{lower_left, upper_right, lower_right, upper_left},
      threads{upper_left, lower_right, lower_left, upper_right};
  Indices expected = triangle;
  for (const Indices& more : {its_threads, threads}) expected.insert(expected.end(), more.begin(), more.end());
  CHECK(frayed_indices(quad, stride, tears) == expected);
  Tears crossing(quad);
  crossing.tear(2, 0, 0);  // the diagonal alone: the hole stays open
  CHECK(frayed_indices(quad, stride, crossing).empty());
  // Around that hole, in a cloth with neighbors on all sides, threads of the four edges end.
  const Lattice cloth{4, 4};
  Tears hole(cloth);
  hole.tear(2, 1, 1);
  const Indices round = frayed_indices(cloth, stride, hole);
  CHECK(round.size() == 4 * 4);
  for (std::size_t k = 0; k < round.size(); k += 4) CHECK(round[k] != round[k + 3]);
}

TEST_CASE("threads end along both sides of a cut through a cloth that parts") {
  constexpr int stride = 10;
  auto mesh = std::make_shared<Mesh>(Lattice{3, 3});
  CHECK(mesh->part(1, Mesh::down_right) == 9);
  CHECK(mesh->part(4, Mesh::up_right | Mesh::down_right) == 10);
  // The edge from (0, 1) to (1, 1) is open, the next one at its upper end.
  const Indices found = frayed_indices({5, 3, 2}, stride, Tears({5, 3, 2}, mesh));
  REQUIRE(found.size() == 4 * 4);
  std::set<std::vector<std::uint32_t>> ends;
  for (std::size_t k = 0; k < found.size(); k += 4) {
    const auto sorted = std::minmax(found[k], found[k + 1]);
    ends.insert({sorted.first, sorted.second});
    // On this side and beyond are different columns.
    CHECK(std::abs(int(found[k + 2] % stride) - int(found[k + 3] % stride)) == 2);
  }
  CHECK(ends == std::set<std::vector<std::uint32_t>>{{1, 11}, {30, 31}, {11, 21}, {21, 31}});
}

TEST_CASE("the back of a cloth has a tint of its own, whatever its texture") {
  Stage stage;
  Simulation simulation(hanging());
  // The part of each color in what is in the middle of the picture.
  const auto tint = [&](float yaw) {
    stage.camera().yaw = yaw;
    const Image picture = stage.draw(simulation, 1);
    glm::vec3 sum(0);
    for (int y = height / 4; y < height * 3 / 4; ++y)
      for (int x = width * 3 / 8; x < width * 5 / 8; ++x)
        for (int c = 0; c < 3; ++c) sum[c] += float(picture.rgb[std::size_t(3 * (y * width + x) + c)]);
    return sum / (sum.x + sum.y + sum.z);
  };
  for (const char* texture : {"linen", "denim", "flag", "rubber"}) {
    CAPTURE(texture);
    REQUIRE_FALSE(stage.renderer().set_texture(std::string(test::source_dir) + "/textures/" + texture + ".png"));
    const glm::vec3 front = tint(0), back = tint(3.14f);
    CHECK(glm::length(front - back) > 0.04f);
  }
}

TEST_CASE("a cloth finer than the picture is drawn from a part of its rows and columns") {
  CHECK(drawn_every({32, 32}, 600, 600) == 1);
  CHECK(drawn_every({4096, 4096}, 600, 600) == 6);
  CHECK(drawn_every({4096, 1}, 10, 10) >= 5);
  Stage stage;
  Preset preset = hanging();
  preset.rows = preset.columns = 62;
  preset.L *= 8.0 / 61;
  Simulation simulation(preset);
  for (const bool cut : {false, true}) {
    std::vector<Pins::Site> row;
    for (int j = 0; j < 62; ++j) row.push_back({30, j});
    if (cut) simulation.apply(edit::Cut{row});
    stage.options().every = 1;
    const Image whole = stage.draw(simulation, 1);
    stage.options().every = 3;
    const Image part = stage.draw(simulation, 1);
    // A cut is as wide as a drawn quad.
    CHECK(difference(whole, part) < (cut ? 2200 : 400));
  }
  stage.options().every = 1;
  Simulation untorn(preset);
  CHECK(difference(stage.draw(untorn, 1), stage.draw(simulation, 1)) > 100);
}

TEST_CASE("a solver in double and one in float give the same picture, whatever their rows are padded to") {
  Stage stage;
  for (const int columns : {9, 17, 32, 33}) {
    Preset preset = test::cloth(9, columns);
    preset.x_0 = {0, 1.02, 0};
    Image images[2];
    for (const int every : {1, 2}) {
      stage.options().every = every;
      for (const int k : {0, 1}) {
        preset.precision = k == 0 ? Precision::float_ : Precision::double_;
        Simulation simulation(preset);
        simulation.advance(20);
        images[k] = stage.draw(simulation, 1);
      }
      CHECK(difference(images[0], images[1]) < 20);
    }
  }
}

TEST_CASE("nothing is uploaded where nothing moved, and normals are made for lit views alone") {
  Stage stage;
  Simulation simulation(hanging());
  stage.draw(simulation, 4);
  RenderWork work = stage.renderer().take_work();
  CHECK(work.upload.wall_s > 0);
  CHECK(work.index_lists.wall_s > 0);
  CHECK(work.normals.wall_s == 0);
  stage.draw(simulation, 1);  // the light is new, the places are not
  CHECK(stage.renderer().take_work().normals.wall_s > 0);
  const std::size_t bytes = stage.renderer().bytes();
  CHECK(bytes > 0);
  stage.draw(simulation, 1);
  CHECK(stage.renderer().take_work().normals.wall_s == 0);
  simulation.advance(1);
  stage.draw(simulation, 5);
  work = stage.renderer().take_work();
  CHECK(work.normals.wall_s == 0);
  // Three floats a particle for positions and for normals, in padded rows, once on either side; positions once more for
  // lines; and index lists.
  CHECK(bytes < std::size_t(9 * 48 * 4 * 5 + 4 * (6 * 8 * 8 + 2 * 12 * 81 + 4 * 81)));
}

TEST_CASE("triangles and lines with a long edge can be left out") {
  const float row[] = {0, 1, 9, 0, 0, 0, 0, 0, 0};
  const FloatRows line{1, 3, 3, row};
  Indices lines{0, 1, 1, 2, 0, 1}, triangles{0, 1, 2, 0, 1, 1};
  remove_long(lines, 2, line, 2);
  CHECK(lines == Indices{0, 1, 0, 1});
  remove_long(triangles, 3, line, 2);
  CHECK(triangles == Indices{0, 1, 1});
}

TEST_CASE("bending springs can be drawn in view 2") {
  Stage stage;
  Preset preset = hanging();
  preset.k_b = 5;
  Simulation simulation(preset);
  const Image without = stage.draw(simulation, 2), with = stage.draw(simulation, 2, true);
  CHECK(difference(without, with) > 100);
}

TEST_CASE("a picture follows the cloth, and shows the same twice") {
  Stage stage;
  Preset preset = test::cloth(9, 9);
  preset.x_0 = {0, 1.02, 0};
  Simulation simulation(preset);
  const Image first = stage.draw(simulation, 1);
  CHECK(difference(first, stage.draw(simulation, 1)) == 0);
  simulation.advance(100);
  CHECK(difference(first, stage.draw(simulation, 1)) > 100);
}

TEST_CASE("a texture shows, and a bad file gives a message and keeps the old one") {
  const test::TemporaryFolder folder;
  Stage stage;
  Simulation simulation(hanging());
  const Image plain = stage.draw(simulation, 1);
  CHECK_FALSE(stage.renderer().set_texture(std::string(test::source_dir) + "/textures/uv_grid.png").has_value());
  const Image grid = stage.draw(simulation, 1);
  CHECK(difference(plain, grid) > 1000);
  test::write_file(folder / "bad.png", "no picture");
  for (const auto& file : {folder / "bad.png", folder / "missing.png"}) {
    const auto problem = stage.renderer().set_texture(file);
    REQUIRE(problem.has_value());
    CHECK(problem->find(file.filename().string()) != std::string::npos);
    CHECK(difference(grid, stage.draw(simulation, 1)) == 0);
  }
}

TEST_CASE("a plane is a disc with shadows, darker where the cloth is near it; a bare grid is faint and hides nothing") {
  const HeadlessContext context;
  ClothRenderer renderer;
  ViewOptions options;
  options.samples = 1;
  Camera camera;
  const auto draw = [&](Simulation& simulation, bool ground, int mode, glm::vec3 target, float distance,
                        float pitch = 0.5f) {
    options.ground = ground, options.mode = mode;
    camera.yaw = 0, camera.pitch = pitch, camera.target = target, camera.distance = distance;
    renderer.update(simulation, options);
    renderer.draw(camera, options, width, height);
    return renderer.pixels();
  };
  Preset flat = hanging();
  flat.tilt_deg = 0, flat.x_0 = {0, 0.6, 0};
  Simulation in_the_air(flat);
  const glm::vec3 middle(0, 0.4f, 0);
  const Image empty = draw(in_the_air, false, 1, middle, 2.5f), grid = draw(in_the_air, true, 1, middle, 2.5f);
  int largest = 0;
  for (std::size_t p = 0; p < grid.rgb.size(); ++p) largest = std::max(largest, std::abs(grid.rgb[p] - empty.rgb[p]));
  CHECK(largest > 3);
  CHECK(largest < 24);  // of 255: faint lines, no shadow
  // Brightness of a place of the plane in the shadow of a cloth that is that high above it, and of one in the light.
  flat.bodies.resize(1);
  flat.bodies[0].shape = Body::Shape::plane;
  flat.bodies[0].y = 0.2;
  const auto brightness = [&](double above, double in_shadow) {
    Preset preset = flat;
    preset.x_0.y = 0.2 + above;
    Simulation simulation(preset);
    const double edge = 4 * preset.L;
    const glm::dvec3 at(edge + in_shadow * above * 0.66 / 0.86, 0.2, edge - above * 0.60 / 0.86);
    const Image image = draw(simulation, true, 1, glm::vec3(at), 0.4f);
    const auto pixel = camera.project(at, {width, height});
    REQUIRE(pixel.has_value());
    const std::uint8_t* rgb = image.rgb.data() + 3 * (int(pixel->y) * width + int(pixel->x));
    return rgb[0] + rgb[1] + rgb[2];
  };
  const int lit = brightness(0.06, 2), far = brightness(0.06, 0.6), near = brightness(0.008, 0.6);
  CHECK(far < 0.75 * lit);
  CHECK(near < 0.9 * far);
  Simulation over_plane(flat);
  CHECK(difference(draw(over_plane, true, 1, middle, 1), draw(over_plane, false, 1, middle, 1)) > width * height / 5);
  // A cloth that has fallen below the grid is still seen, as lines too.
  Preset falls = flat;
  falls.bodies.clear(), falls.g = 9.82;
  Simulation fallen(falls);
  fallen.advance(int(0.6 / falls.dt));
  for (const int mode : {1, 2, 4, 5}) {
    CAPTURE(mode);
    const glm::vec3 there(fallen.position(4, 4));
    CHECK(there.y < -1);
    const Image through_grid = draw(fallen, true, mode, there, 3, 1.2f),
                alone = draw(fallen, false, mode, there, 3, 1.2f);
    CHECK(camera.eye().y > 0.5f);                     // above the grid
    CHECK(difference(through_grid, alone, 30) < 20);  // more than a line of the grid
  }
}

TEST_CASE("the line where a mass on a spring comes to rest is drawn only where it is wanted") {
  Stage stage;
  Simulation simulation(test::one_weight());
  const Preset& p = simulation.preset();
  const double sag = p.m * p.g / p.k;
  stage.camera().target = p.x_0 - glm::dvec3(0, sag, 0);
  stage.camera().distance = float(3 * std::max(sag, std::abs(p.offset)));
  stage.options().samples = 4;  // the line is thinner than a pixel
  const Image with = stage.draw(simulation, 1);
  stage.options().equilibrium = false;
  CHECK(difference(with, stage.draw(simulation, 1)) > 20);
}

TEST_CASE("threads, single quads, one weight, bodies and diverged cloths are drawn without trouble") {
  Stage stage;
  std::vector<Preset> presets = {test::cloth(2, 1), test::cloth(3, 1), test::cloth(2, 2), test::one_weight()};
  presets.push_back(test::cloth(40, 3));
  presets.back().bodies.resize(2);
  presets.back().bodies[1].shape = Body::Shape::plane;
  presets.push_back(test::cloth(6, 6, "euler"));
  presets.back().dt = 0.05;
  for (const Preset& preset : presets) {
    Simulation simulation(preset);
    for (int mode = 1; mode <= 5; ++mode) {
      simulation.advance(20);
      CHECK(stage.draw(simulation, mode).rgb.size() == std::size_t(width) * height * 3);
    }
  }
}

}  // namespace tyglab::renderer_test
