#include "app/scene/sketch.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <limits>
#include <utility>
#include <variant>

#include "app/render/camera.h"
#include "app/render/solid_mesh.h"
#include "core/forces/contact.h"
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

/// Distance of the farthest point of a body from its center in a direction, both in its frame, m.
double reach_along(const Body& body, const glm::dvec3& n) {
  switch (body.shape) {
    case Body::Shape::box:
      return glm::dot(glm::abs(n), body.size) / 2;
    case Body::Shape::cylinder:
      return body.r * std::hypot(n.x, n.z) + body.length / 2 * std::abs(n.y);
    case Body::Shape::capsule:
      return body.r + body.length / 2 * std::abs(n.y);
    default:
      return body.r;
  }
}

/// A body as the sketch sees it.
class Solid {
 public:
  Solid(const Body& body, const glm::dvec3& eye) : body_(body) {
    const PlacedBody at = placed(body);
    for (int k = 0; k < 3; ++k) axes_[k] = {at.axes[3 * k], at.axes[3 * k + 1], at.axes[3 * k + 2]};
    // Directions spread over a sphere, and those of flat faces.
    constexpr int around = 160;
    for (int k = 0; k < 3; ++k)
      for (const double side : {-1.0, 1.0}) add(side * glm::dvec3(k == 0, k == 1, k == 2), eye);
    for (int k = 0; k < around; ++k) {
      const double y = 1 - (2 * k + 1.0) / around, across = std::sqrt(1 - y * y), angle = 2.399963 * k;
      add({across * std::cos(angle), y, across * std::sin(angle)}, eye);
    }
  }

  const Body& body() const { return body_; }
  /// Whether the body cannot hide a point outside: a plane that touches the body has it and the eye on its other side.
  /// What lies closer to the body than `margin` may be a little inside.
  bool before(const glm::dvec3& x, double margin) const {
    return std::any_of(toward_eye_.begin(), toward_eye_.end(),
                       [&](const Tangent& one) { return glm::dot(one.n, x - body_.c) > one.reach - margin; });
  }
  /// Its surface, in the world.
  SolidGeometry mesh() const {
    SolidGeometry mesh = unit_mesh();
    for (SolidVertex& vertex : mesh.vertices) {
      vertex.point = glm::vec3(body_.c + axes_ * glm::dvec3(vertex.point));
      vertex.normal = glm::vec3(axes_ * glm::dvec3(vertex.normal));
    }
    return mesh;
  }

 private:
  struct Tangent {
    glm::dvec3 n;
    double reach;
  };
  void add(const glm::dvec3& n, const glm::dvec3& eye) {
    const Tangent one{axes_ * n, reach_along(body_, n)};
    if (glm::dot(one.n, eye - body_.c) > one.reach) toward_eye_.push_back(one);
  }
  SolidGeometry unit_mesh() const {
    constexpr int meridians = 24, parallels = 11;
    const float r = float(body_.r), half = float(body_.length / 2);
    if (body_.shape == Body::Shape::box) return box_geometry(glm::vec3(0), glm::vec3(body_.size / 2.0));
    const bool round = body_.shape == Body::Shape::capsule;
    SolidGeometry mesh = round ? sphere_geometry(meridians, parallels) : cylinder_geometry(meridians);
    for (SolidVertex& vertex : mesh.vertices)
      vertex.point = round ? r * vertex.point + glm::vec3(0, vertex.point.y > 0 ? half : -half, 0)
                           : glm::vec3(r, half, r) * vertex.point;
    return mesh;
  }

  Body body_;
  glm::dmat3 axes_{1};
  std::vector<Tangent> toward_eye_;
};

/// Draws the farthest parts first.
class Sketching {
 public:
  Sketching(const Simulation& simulation, const Grid& grid)
      : grid_(grid), L_(simulation.preset().L), camera_(framed(simulation, grid)), project_(camera_, picture) {
    for (std::size_t r = 0; r < grid.rows.size(); ++r)
      for (std::size_t c = 0; c < grid.columns.size(); ++c)
        sketch_.corners.push_back(
            {project_(grid.at(r, c)).value_or(glm::vec2(0)) / picture, light_at(grid, r, c, toward_light())});
    sort_cloth();
    std::vector<Body> bodies = simulation.bodies();
    std::stable_sort(bodies.begin(), bodies.end(),
                     [&](const Body& a, const Body& b) { return project_.depth(a.c) > project_.depth(b.c); });
    for (const Body& body : bodies)
      if (body.shape == Body::Shape::plane) add_slope(body);
    std::size_t drawn = 0;
    for (const Body& body : bodies)
      if (body.shape != Body::Shape::plane) drawn = add_body(body, drawn);
    add_cloth(drawn, parts_.size());
  }
  SceneSketch take() { return std::move(sketch_); }

 private:
  struct Part {
    double depth;
    glm::dvec3 middle;
    std::array<std::uint16_t, 3> corners;
  };

  static Camera framed(const Simulation& simulation, const Grid& grid) {
    constexpr glm::vec2 filled{0.84f, 0.8f};
    Camera camera = scene_camera(simulation.preset(), SceneSketch::aspect);
    std::vector<glm::vec3> seen(grid.x.begin(), grid.x.end());
    Bounds cloth;
    for (const glm::vec3& x : seen) cloth.add(x);
    for (const Body& body : simulation.bodies()) {
      if (body.shape == Body::Shape::sphere) {
        for (const double side : {-1.0, 1.0}) seen.push_back(body.c + side * body.r * glm::dvec3(camera.up()));
      } else if (const auto box = body_bounds(body, cloth)) {
        for (int k = 0; k < 8; ++k)
          seen.emplace_back(k & 1 ? box->hi.x : box->lo.x, k & 2 ? box->hi.y : box->lo.y,
                            k & 4 ? box->hi.z : box->lo.z);
      }
    }
    camera.frame(seen, SceneSketch::aspect, filled);
    return camera;
  }

  glm::dvec3 toward_light() const {
    return glm::normalize(glm::dvec3(camera_.right()) * -0.5 + glm::dvec3(camera_.up()) * 0.6 -
                          glm::dvec3(camera_.forward()) * 0.8);
  }

  void sort_cloth() {
    const std::size_t width = grid_.columns.size();
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
      const glm::dvec3 middle = (grid_.x[a] + grid_.x[b] + grid_.x[c]) / 3.0;
      parts_.push_back({project_.depth(middle), middle, {std::uint16_t(a), std::uint16_t(b), std::uint16_t(c)}});
    };
    for (std::size_t r = 0; r + 1 < grid_.rows.size(); ++r)
      for (std::size_t c = 0; c + 1 < width; ++c) {
        const std::size_t a = r * width + c;
        add(a, a + width, a + 1), add(a + 1, a + width, a + width + 1);
      }
    std::stable_sort(parts_.begin(), parts_.end(), [](const Part& a, const Part& b) { return a.depth > b.depth; });
  }

  void add_cloth(std::size_t from, std::size_t to) {
    for (; from < to; ++from) sketch_.triangles.push_back(parts_[from].corners);
  }

  /// With the cloth behind it that is not drawn yet; returns how much is drawn.
  std::size_t add_body(const Body& body, std::size_t drawn) {
    const Solid solid(body, glm::dvec3(camera_.eye()));
    const double margin = 0.5 * L_ + 0.02 * body.r;
    const auto begin = parts_.begin() + std::ptrdiff_t(drawn);
    const auto end = std::stable_partition(begin, parts_.end(),
                                           [&](const Part& part) { return !solid.before(part.middle, margin); });
    const auto behind = std::size_t(end - parts_.begin());
    add_cloth(drawn, behind);
    if (body.shape != Body::Shape::sphere) {
      add_solid(solid);
    } else if (const auto middle = project_(body.c), side = project_(body.c + body.r * glm::dvec3(camera_.right()));
               middle && side) {
      sketch_.balls.push_back({*middle / picture, glm::length(*side - *middle), sketch_.triangles.size()});
    }
    return behind;
  }

  void add_solid(const Solid& solid) {
    const SolidGeometry mesh = solid.mesh();
    const std::size_t first = sketch_.corners.size();
    std::vector<SceneSketch::Corner> corners;
    for (const SolidVertex& vertex : mesh.vertices) {
      const auto at = project_(glm::dvec3(vertex.point));
      if (!at) return;
      corners.push_back(
          {*at / picture, float(std::max(0.0, glm::dot(glm::dvec3(vertex.normal), toward_light()))), false});
    }
    if (first + corners.size() > std::numeric_limits<std::uint16_t>::max()) return;
    sketch_.corners.insert(sketch_.corners.end(), corners.begin(), corners.end());
    for (std::size_t n = 0; n < mesh.indices.size(); n += 3) {
      const auto at = [&](std::size_t k) -> const SolidVertex& { return mesh.vertices[mesh.indices[n + k]]; };
      const glm::vec3 out = at(0).normal + at(1).normal + at(2).normal;
      if (glm::dot(out, camera_.eye() - at(0).point) <= 0) continue;
      const auto corner = [&](std::size_t k) { return std::uint16_t(first + mesh.indices[n + k]); };
      sketch_.triangles.push_back({corner(0), corner(1), corner(2)});
    }
  }

  /// The part of a tilted plane that is below the cloth; a level one is the ground, which is not drawn.
  void add_slope(const Body& body) {
    if (body.turn == glm::dvec3(0)) return;
    const PlacedBody at = placed(body);
    const glm::dvec3 x(at.axes[0], at.axes[1], at.axes[2]), n(at.axes[3], at.axes[4], at.axes[5]),
        z(at.axes[6], at.axes[7], at.axes[8]);
    Bounds cloth;
    for (const glm::dvec3& place : grid_.x) cloth.add(glm::vec3(place));
    const glm::dvec3 center = glm::dvec3(cloth.lo + cloth.hi) / 2.0, c(at.c[0], at.c[1], at.c[2]);
    const double half = 0.6 * glm::length(cloth.hi - cloth.lo);
    const glm::dvec3 middle = center - glm::dot(center - c, n) * n;
    const std::size_t first = sketch_.corners.size();
    for (const auto& [a, b] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
      const auto corner = project_(middle + half * (double(a) * x + double(b) * z));
      if (!corner) return sketch_.corners.resize(first);
      sketch_.corners.push_back({*corner / picture, float(std::abs(glm::dot(n, toward_light()))), false});
    }
    const auto corner = [&](std::size_t k) { return std::uint16_t(first + k); };
    sketch_.triangles.push_back({corner(0), corner(1), corner(2)});
    sketch_.triangles.push_back({corner(0), corner(2), corner(3)});
  }

  const Grid& grid_;
  double L_;
  Camera camera_;
  Projector project_;
  std::vector<Part> parts_;  ///< of the cloth, the farthest first; what is drawn stays where it is
  SceneSketch sketch_;
};

SceneSketch projected(const Simulation& simulation, const Grid& grid) {
  return Sketching(simulation, grid).take();
}

Grid read_grid(const Simulation& simulation) {
  const Lattice lattice = simulation.lattice().sites();
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
