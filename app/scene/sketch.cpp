#include "app/scene/sketch.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>
#include <variant>

#include "app/render/camera.h"
#include "core/model/notation.h"
#include "core/model/preset.h"
#include "core/simulation.h"

namespace tyglab {
namespace {

constexpr glm::vec2 picture{SceneSketch::aspect, 1};
constexpr int most_side = 32, most_quads = 24;  // particles that move, and quads that are drawn, along a side
constexpr double seconds = 0.8;                 // after the start a scene shows what it is about
constexpr double settles = 4;                   // s, in which a cloth that only hangs comes nearly to rest
constexpr int most_steps = 4000, at_once = 10;

/// With fewer particles, each of which stands for more of the cloth: as far as its constants allow.
Preset coarse(Preset preset) {
  preset.engine = EngineKind::cpu;
  preset.precision = Precision::float_;
  const int side = std::max(preset.rows, preset.columns);
  return side > most_side ? nearest_allowed(with_resolution(preset, double(most_side - 1) / (side - 1))) : preset;
}

/// A zigzag from where the spring is held to the weight.
SceneSketch weight_sketch() {
  constexpr int turns = 9;
  constexpr glm::vec2 from{0.5f, 0.08f}, to{0.5f, 0.6f};
  SceneSketch sketch;
  sketch.line.push_back(from);
  for (int n = 0; n < turns; ++n)
    sketch.line.push_back(
        {0.5f + (n % 2 == 0 ? 0.05f : -0.05f), from.y + (to.y - from.y) * float(n + 1) / (turns + 1)});
  sketch.line.push_back(to);
  sketch.balls.push_back({to + glm::vec2(0, 0.1f), 0.1f, 0});
  return sketch;
}

/// At equal distances, at most as many as are drawn; the last always.
std::vector<int> drawn_along(int count) {
  const int step = std::max(1, (count - 1 + most_quads - 1) / most_quads);
  std::vector<int> drawn;
  for (int k = 0; k < count - 1; k += step) drawn.push_back(k);
  drawn.push_back(count - 1);
  return drawn;
}

struct Grid {
  std::vector<int> rows, columns;
  std::vector<glm::dvec3> x;
  const glm::dvec3& at(std::size_t r, std::size_t c) const { return x[r * columns.size() + c]; }
};

/// How much the light from over the viewer's shoulder falls on either side of the cloth at a corner.
float light_at(const Grid& grid, std::size_t r, std::size_t c, const glm::dvec3& toward_light) {
  const auto before = [](std::size_t k) { return k > 0 ? k - 1 : k; };
  const glm::dvec3 down = grid.at(std::min(r + 1, grid.rows.size() - 1), c) - grid.at(before(r), c);
  const glm::dvec3 right = grid.at(r, std::min(c + 1, grid.columns.size() - 1)) - grid.at(r, before(c));
  const glm::dvec3 normal = glm::cross(down, right);
  const double length = glm::length(normal);
  return length > 0 ? float(std::abs(glm::dot(normal, toward_light)) / length) : 1;
}

SceneSketch projected(const Simulation& simulation, const Grid& grid) {
  constexpr glm::vec2 filled{0.84f, 0.8f};
  Camera camera = scene_camera(simulation.preset(), SceneSketch::aspect);
  std::vector<glm::vec3> seen(grid.x.begin(), grid.x.end());
  for (const Body& body : simulation.preset().bodies)
    if (body.shape == Body::Shape::sphere)
      for (const double side : {-1.0, 1.0}) seen.push_back(body.c + side * body.r * glm::dvec3(camera.up()));
  camera.frame(seen, SceneSketch::aspect, filled);
  const Projector project(camera, picture);
  const glm::dvec3 light = glm::normalize(glm::dvec3(camera.right()) * -0.5 + glm::dvec3(camera.up()) * 0.6 -
                                          glm::dvec3(camera.forward()) * 0.8);
  SceneSketch sketch;
  for (std::size_t r = 0; r < grid.rows.size(); ++r)
    for (std::size_t c = 0; c < grid.columns.size(); ++c)
      sketch.corners.push_back({project(grid.at(r, c)).value_or(glm::vec2(0)) / picture, light_at(grid, r, c, light)});
  const std::size_t width = grid.columns.size();
  std::vector<std::pair<double, std::array<std::uint16_t, 3>>> parts;
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
    const double depth = project.depth(grid.x[a]) + project.depth(grid.x[b]) + project.depth(grid.x[c]);
    parts.push_back({depth / 3, {std::uint16_t(a), std::uint16_t(b), std::uint16_t(c)}});
  };
  for (std::size_t r = 0; r + 1 < grid.rows.size(); ++r)
    for (std::size_t c = 0; c + 1 < width; ++c) {
      const std::size_t a = r * width + c;
      add(a, a + width, a + 1), add(a + 1, a + width, a + width + 1);
    }
  std::stable_sort(parts.begin(), parts.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  for (const auto& [depth, triangle] : parts) sketch.triangles.push_back(triangle);
  for (const Body& body : simulation.preset().bodies) {
    if (body.shape != Body::Shape::sphere) continue;
    const auto middle = project(body.c), side = project(body.c + body.r * glm::dvec3(camera.right()));
    if (!middle || !side) continue;
    const double depth = project.depth(body.c);
    const auto nearer = std::find_if(parts.begin(), parts.end(), [&](const auto& part) { return part.first < depth; });
    sketch.balls.push_back({*middle / picture, glm::length(*side - *middle), std::size_t(nearer - parts.begin())});
  }
  return sketch;
}

Grid read_grid(const Simulation& simulation) {
  const Lattice& lattice = simulation.lattice();
  const PositionView x = simulation.positions();
  Grid grid{drawn_along(lattice.rows), drawn_along(lattice.columns), {}};
  for (const int i : grid.rows)
    for (const int j : grid.columns) grid.x.push_back(x.at(i, j));
  return grid;
}

}  // namespace

SceneSketch sketch_of(const Preset& preset, const Stop& stop) {
  if (preset.kind == Kind::one_weight) return weight_sketch();
  Simulation simulation(coarse(preset));
  simulation.stop_when(stop);
  Grid grid = read_grid(simulation);
  const bool hangs = preset.pins.mode != Pins::Mode::none && preset.bodies.empty() && preset.F_max == 0;
  for (int steps = 0; steps < most_steps && simulation.time() < (hangs ? settles : seconds); steps += at_once) {
    simulation.advance(at_once);
    if (stop() || simulation.divergence()) break;  // of one that diverges the last whole look is shown
    grid = read_grid(simulation);
  }
  return projected(simulation, grid);
}

SceneSketch sketch_at_start(const Preset& preset) {
  if (preset.kind == Kind::one_weight) return weight_sketch();
  const Simulation simulation(coarse(preset));
  return projected(simulation, read_grid(simulation));
}

namespace {

/// Empty where not even the start can be had.
SceneSketch first_sketch(const Preset& preset) {
  try {
    return sketch_at_start(preset);
  } catch (const std::exception&) {
    return {};
  }
}

}  // namespace

const SceneSketch& SceneSketches::of(const Preset& preset) {
  auto found = std::find_if(all_.begin(), all_.end(), [&](const Made& made) { return made.preset == preset; });
  if (found == all_.end()) found = all_.insert(all_.end(), {preset, first_sketch(preset)});
  found->asked = frame_;
  return found->sketch;
}

bool SceneSketches::moved(const Preset& preset) const {
  return std::any_of(all_.begin(), all_.end(), [&](const Made& made) { return made.moved && made.preset == preset; });
}

/// What is looked at now, in its order; then what was.
SceneSketches::Made* SceneSketches::next() {
  Made* best = nullptr;
  for (Made& made : all_)
    if (!made.moved && (best == nullptr || made.asked > best->asked)) best = &made;
  return best;
}

bool SceneSketches::poll() {
  if (work_.ready()) {
    auto outcome = work_.take();
    Made& made = *std::exchange(making_, nullptr);
    made.moved = true;
    if (auto* sketch = std::get_if<SceneSketch>(&outcome)) made.sketch = std::move(*sketch);
  }
  if (!work_.busy() && (making_ = next()) != nullptr)
    work_.start(Priority::below_frames, [preset = making_->preset](const JobControl& control) {
      return sketch_of(preset, [&] { return control.cancelled(); });
    });
  ++frame_;
  return work_.busy();
}

}  // namespace tyglab
