// Buffers that a device shares with OpenGL as graphics cards do (cl_khr_gl_sharing), against a double of such a device:
// ctest runs this suite under the layer tests/support/gl_sharing_double.cpp, which makes one of any device and ends the
// program where it breaks a rule of the extension. No graphics card was there to run it on.
#include <dlfcn.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <string>

#include "app/render/cloth_mesh.h"
#include "app/render/written_vertices.h"
#include "core/engines/opencl/opencl_devices.h"
#include "tests/app/picture_pair.h"
#include "tests/support/gl_sharing_double.h"
#include "tests/support/scenes.h"
#include "tests/support/skip.h"

namespace tyglab::gl_sharing_test {

bool skipped_without_double() {
  static const bool there = opencl_offers_gl_sharing(0);
  if (!there) test::skip("no OpenCL device here looks as if it shared buffers with OpenGL");
  return !there;
}

/// What the double is to do; it looks anew in every call.
class Told {
 public:
  explicit Told(const char* words) { ::setenv("TYGLAB_GL_DOUBLE", words, 1); }
  ~Told() { ::unsetenv("TYGLAB_GL_DOUBLE"); }
  Told(const Told&) = delete;
  Told& operator=(const Told&) = delete;
};

test::GlDoubleCounts counts() {
  static const auto get = [] {
    void* const layer = ::dlopen(std::getenv("OPENCL_LAYERS"), RTLD_LAZY | RTLD_NOLOAD);
    return reinterpret_cast<decltype(&tyglab_gl_double_counts)>(::dlsym(layer, "tyglab_gl_double_counts"));
  }();
  return get();
}

Preset scene(Precision precision = Precision::float_, int rows = 24, int columns = 31) {
  Preset preset = test::cloth(rows, columns);
  preset.engine = EngineKind::opencl;
  preset.precision = precision;
  return preset;
}

/// How often OpenGL is waited for with glFinish while it lives.
class Finishes {
 public:
  Finishes() : own_(glad_glFinish) {
    count = 0, of_driver = own_;
    glad_glFinish = [] { ++count, of_driver(); };
  }
  ~Finishes() { glad_glFinish = own_; }
  Finishes(const Finishes&) = delete;
  Finishes& operator=(const Finishes&) = delete;
  static inline int count = 0;

 private:
  static inline PFNGLFINISHPROC of_driver = nullptr;
  PFNGLFINISHPROC own_;
};

TEST_SUITE("gl_sharing") {
  TEST_CASE("OpenGL draws from a buffer that the device writes, and no byte is copied") {
    if (skipped_without_double()) return;
    for (const char* words : {"", "no_events"})
      for (const Precision precision : {Precision::float_, Precision::double_}) {
        CAPTURE(words);
        CAPTURE(int(precision));
        const Told told(words);
        test::PicturePair stage;
        Simulation simulation(scene(precision));
        CHECK(stage.copied_for(simulation, 1) == 0);
        const Finishes finishes;
        Image last = stage.picture();
        for (const int steps : {1, 3, 60, 200}) {
          simulation.advance(steps);
          CHECK(stage.copied_for(simulation, 1) == 0);
          CHECK(stage.vertex_path() == VertexPath::shared_buffer);
          CHECK(stage.picture().rgb != last.rgb);
          last = stage.picture();
        }
        CHECK(Finishes::count == (std::string(words).empty() ? 0 : 4));
      }
  }

  TEST_CASE("over many frames nothing that grows with the cloth is read of the device") {
    if (skipped_without_double()) return;
    std::uint64_t read[2];
    for (const int large : {0, 1}) {
      test::PicturePair stage;
      Preset preset = scene(Precision::float_, large != 0 ? 96 : 12, 40);
      Simulation simulation(preset);
      stage.copied_alone(simulation, 1);
      const std::uint64_t before = counts().read, acquired = std::uint64_t(counts().acquired);
      const std::uint64_t copied = bytes_read(simulation.engine());
      for (int frame = 0; frame < 100; ++frame) {
        simulation.advance(3);
        CHECK(stage.copied_alone(simulation, 1) == 0);
      }
      read[large] = counts().read - before;
      CHECK(std::uint64_t(counts().acquired) - acquired == 100);
      CHECK(bytes_read(simulation.engine()) == copied);
    }
    // A box for each frame, and what steps report: 32 bytes each.
    for (const std::uint64_t bytes : read) CHECK(bytes < 100 * 24 + 2 * 300 * 32);
  }

  TEST_CASE("another lattice, a cut, another view, method, precision or engine: the picture is that of copies") {
    if (skipped_without_double()) return;
    test::PicturePair stage;
    Simulation simulation(scene());
    test::check_pictures_of_changes(stage, simulation, VertexPath::shared_buffer);
    CHECK(stage.copied_by_a_sibling(simulation) == 0);
    CHECK(stage.copied_for(simulation, 4) == 0);
    CHECK(counts().buffers == 2);
  }

  TEST_CASE("a cloth that tears, one that diverges, and one that is finer than the picture") {
    if (skipped_without_double()) return;
    test::PicturePair stage;
    Preset preset = scene();
    preset.F_max = 0.05;
    Simulation simulation(preset);
    stage.copied_for(simulation, 1);
    for (int frame = 0; frame < 40; ++frame) {
      simulation.advance(10);
      CHECK(stage.copied_for(simulation, 1) == 0);
    }
    CHECK(simulation.tears().torn_count() > 0);
    stage.options().every = 3;
    simulation.advance(1);
    CHECK(stage.copied_for(simulation, 1) == 0);
    stage.options().every = 1;
    preset = simulation.preset();
    preset.dt *= 20, preset.F_max = 0;
    simulation.apply(edit::Change{preset});
    simulation.advance(2000);
    REQUIRE(simulation.divergence());
    // Which edges of it are too long to be drawn is looked at in main memory, once.
    stage.options().longest_edge = 0.1f;
    CHECK(stage.copied_for(simulation, 1) > 0);
    stage.options().longest_edge = 0;
    simulation.apply(edit::Restart{});
    CHECK(stage.copied_for(simulation, 1) == 0);
  }

  TEST_CASE("normals on the device have the bits of those that the program computes") {
    if (skipped_without_double()) return;
    const HeadlessContext context;
    for (const Precision precision : {Precision::float_, Precision::double_})
      for (const bool torn : {false, true}) {
        CAPTURE(int(precision));
        CAPTURE(torn);
        Simulation simulation(scene(precision, 13, 18));
        if (torn)
          for (const edit::Cut& cut : {edit::Cut{{{5, 4}, {5, 5}, {1, 0}}}, edit::Cut{{{12, 17}, {8, 9}, {9, 9}}}})
            simulation.apply(cut);
        simulation.advance(150);
        const Lattice lattice = simulation.lattice();
        const std::vector<std::uint32_t> beside =
            particles_beside_tears(lattice, 3 * lattice.columns, simulation.tears());
        CHECK(beside.empty() == !torn);
        std::vector<TornSite> sites;
        for (const std::uint32_t at : beside) {
          const int i = int(at) / (3 * lattice.columns), j = int(at) % (3 * lattice.columns);
          sites.push_back({std::uint32_t(i * lattice.columns + j), whole_triangles(lattice, simulation.tears(), i, j)});
        }
        WrittenVertices vertices;
        vertices.set_tears(sites);
        std::size_t looked_at = 0;
        const Bounds box = vertices.write(*simulation.engine().vertex_sharing(), {{lattice, 1}, true}, looked_at);
        const auto content = [&](const VertexSource& source) {
          std::vector<float> numbers(3 * std::size_t(lattice.size()));
          glBindBuffer(GL_ARRAY_BUFFER, source.buffer);
          glGetBufferSubData(GL_ARRAY_BUFFER, 0, GLsizeiptr(numbers.size() * sizeof(float)), numbers.data());
          return numbers;
        };
        const std::vector<float> x = content(vertices.positions());
        const FloatRows rows{lattice.rows, lattice.columns, lattice.columns, x.data()};
        std::vector<float> normals(x.size());
        compute_normals(rows, simulation.tears(), beside, normals.data());
        CHECK(content(vertices.normals()) == normals);
        CHECK(finite_bounds(rows).lo == box.lo);
        CHECK(finite_bounds(rows).hi == box.hi);
        CHECK(glm::vec3(simulation.position(7, 11)) ==
              glm::vec3(rows.row(7, 0)[11], rows.row(7, 1)[11], rows.row(7, 2)[11]));
      }
  }

  TEST_CASE("where nothing can be shared positions are copied, and the device says why") {
    if (skipped_without_double()) return;
    const auto way_when = [](const char* words, std::string& problem) {
      const Told told(words);
      test::PicturePair stage;
      Simulation simulation(scene());
      for (int frame = 0; frame < 3; ++frame) {
        CHECK(stage.copied_for(simulation, 1) > 0);
        simulation.advance(10);
      }
      problem = opencl_gl_problem(0);
      return stage.vertex_path();
    };
    std::string problem;
    CHECK(way_when("refuse_context", problem) == VertexPath::copied);
    CHECK(problem.find("refuses a context shared with OpenGL") != std::string::npos);
    CHECK(way_when("other_device", problem) == VertexPath::copied);
    CHECK(problem == "OpenGL draws on another device");
    CHECK(way_when("loses_writes", problem) == VertexPath::copied);
    CHECK(problem.empty());
  }

  TEST_CASE("a device that was opened before there was an OpenGL context is opened anew with it") {
    if (skipped_without_double()) return;
    Simulation before(scene());
    test::PicturePair stage;
    CHECK(stage.copied_for(before, 1) > 0);
    CHECK(stage.vertex_path() == VertexPath::copied);
    Simulation after(scene());
    stage.copied_for(after, 1);
    CHECK(stage.vertex_path() == VertexPath::shared_buffer);
    // In another context nothing of the first could be drawn.
    int somewhere = 0;
    const GlContextInUse other({.context = &somewhere, .display = &somewhere});
    CHECK(after.engine().vertex_sharing()->gl_sharing() == GlSharing::none);
  }

  TEST_CASE("of one particle no more is read than stands near it") {
    if (skipped_without_double()) return;
    for (const Precision precision : {Precision::float_, Precision::double_}) {
      Simulation simulation(scene(precision, 60, 70));
      simulation.advance(40);
      const std::uint64_t before = bytes_read(simulation.engine());
      const std::array<std::pair<int, int>, 5> sites{{{0, 0}, {59, 69}, {30, 35}, {31, 36}, {59, 3}}};
      std::vector<glm::dvec3> near;
      for (const auto& [i, j] : sites) near.push_back(simulation.position(i, j));
      const ParticleReadout readout = simulation.particle(30, 35);
      CHECK(bytes_read(simulation.engine()) - before < 13 * 13 * 3 * 8 * 12);
      const State& whole = simulation.read();
      for (std::size_t n = 0; n < sites.size(); ++n) {
        const std::size_t p = std::size_t(sites[n].first) * 70 + std::size_t(sites[n].second);
        CHECK(near[n] == glm::dvec3(whole.x.x[p], whole.x.y[p], whole.x.z[p]));
      }
      const std::size_t p = 30 * 70 + 35;
      CHECK(readout.x == glm::dvec3(whole.x.x[p], whole.x.y[p], whole.x.z[p]));
      CHECK(glm::distance(readout.v, {whole.v.x[p], whole.v.y[p], whole.v.z[p]}) < 1e-5);
    }
  }

  TEST_CASE("nothing shared is left over, whatever goes first") {
    if (skipped_without_double()) return;
    {
      std::optional<test::PicturePair> stage(std::in_place);
      std::optional<Simulation> simulation(scene());
      stage->copied_for(*simulation, 1);
      CHECK(counts().contexts == 1);
      CHECK(counts().buffers == 2);
      simulation.reset();
      stage.reset();
      CHECK(counts().buffers == 0);
      CHECK(counts().contexts == 0);
      stage.emplace();
      simulation.emplace(scene());
      stage->copied_for(*simulation, 1);
      stage.reset();
      CHECK(counts().buffers == 0);
      simulation->advance(10);
    }
    CHECK(counts().contexts == 0);
  }
}

}  // namespace tyglab::gl_sharing_test
