// Two pictures of one cloth: as its engine and OpenGL share it, and from plain copies.
#pragma once

#include <doctest/doctest.h>

#include "app/platform/platform.h"
#include "app/render/cloth_renderer.h"

namespace tyglab::test {

class PicturePair {
 public:
  /// Both pictures are the same, and bytes were copied for the second; says how many for the first.
  std::size_t copied_for(Simulation& simulation, int mode) {
    options_.mode = mode;
    sharing_.lend_memory(simulation);
    sharing_.update(simulation, options_);
    const Image shared = draw(sharing_, simulation);
    copying_.update({simulation.positions(),
                     simulation.lattice(),
                     simulation.tears(),
                     simulation.preset(),
                     [&](int i, int j) { return simulation.pinned(i, j); },
                     {}},
                    options_, true);
    const Image copied = draw(copying_, simulation);
    CHECK(shared.rgb == copied.rgb);
    CHECK(copying_.take_work().copied > 0);
    const RenderWork work = sharing_.take_work();
    vertex_path_ = work.vertex_path;
    return work.copied;
  }
  /// Draws the first alone; how many bytes that copied.
  std::size_t copied_alone(Simulation& simulation, int mode) {
    options_.mode = mode;
    sharing_.update(simulation, options_);
    draw(sharing_, simulation);
    return sharing_.take_work().copied;
  }
  const Image& picture() const { return picture_; }
  VertexPath vertex_path() const { return vertex_path_; }
  ClothRenderer& sharing() { return sharing_; }
  ViewOptions& options() { return options_; }
  /// Lends the simulation a sibling's memory, draws it, and lets the sibling go. How many bytes that copied.
  std::size_t copied_by_a_sibling(Simulation& simulation) {
    ClothRenderer sibling(sharing_);
    sibling.lend_memory(simulation);
    sibling.update(simulation, options_);
    draw(sibling, simulation);
    return sibling.take_work().copied;
  }

 private:
  const Image& draw(ClothRenderer& renderer, Simulation& simulation) {
    constexpr int width = 320, height = 240;
    renderer.draw(scene_camera(simulation.preset(), float(width) / height), options_, width, height);
    return picture_ = renderer.pixels();
  }
  HeadlessContext context_;
  ClothRenderer sharing_, copying_;
  ViewOptions options_;
  Image picture_;
  VertexPath vertex_path_ = VertexPath::copied;
};

/// Another lattice, a cut, another view, method, precision and engine, one after the other: what is drawn is right all
/// along, and it comes by `path` without a copy, but of the CPU engine. Ends as it began, with an OpenCL engine.
inline void check_pictures_of_changes(PicturePair& stage, Simulation& simulation, VertexPath path) {
  const auto check_shared = [&](int mode) {
    CHECK(stage.copied_for(simulation, mode) == 0);
    CHECK(stage.vertex_path() == path);
  };
  const auto change = [&](auto what) {
    Preset next = simulation.preset();
    what(next);
    simulation.apply(edit::Change{next});
    simulation.advance(20);
  };
  simulation.advance(20);
  check_shared(1);
  change([](Preset& p) { p.rows = 40, p.columns = 9; });
  check_shared(2);
  CHECK(stage.copied_for(simulation, 1) == 0);  // another view of what has not moved
  simulation.apply(edit::Cut{{{10, 4}, {10, 5}}});
  simulation.advance(20);
  check_shared(3);
  change([](Preset& p) { p.integrator = "velocity_verlet"; });
  check_shared(5);
  change([](Preset& p) { p.precision = Precision::double_; });
  check_shared(1);
  change([](Preset& p) { p.engine = EngineKind::cpu; });
  CHECK(stage.copied_for(simulation, 1) > 0);
  CHECK(stage.vertex_path() == VertexPath::copied);
  change([](Preset& p) { p.engine = EngineKind::opencl; });
  check_shared(1);
}

}  // namespace tyglab::test
