// Small pictures of presets, a moment after their start, as triangles for Dear ImGui. They are made in the background
// from any preset, so no image files are needed.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <list>
#include <vector>

#include "app/studies/job.h"
#include "core/model/preset.h"

namespace tyglab {

/// Places are parts of the picture's width and height, from its upper left corner.
struct SceneSketch {
  static constexpr float aspect = 1.6f;  ///< width to height
  struct Corner {
    glm::vec2 at;
    float light;        ///< 0 to 1
    bool cloth = true;  ///< or of a body
  };
  struct Ball {
    glm::vec2 at;
    float radius;        ///< part of the height
    std::size_t behind;  ///< triangles that are drawn before it
  };
  std::vector<Corner> corners;                          ///< of the cloth and of bodies other than spheres
  std::vector<std::array<std::uint16_t, 3>> triangles;  ///< the farthest first
  std::vector<Ball> balls;
  std::vector<glm::vec2> line;  ///< of a spring with its weight at the end
};

template <class Visit>
void visit_parts(Visit&& visit, SceneSketch& sketch) {
  auto& [corners, triangles, balls, line] = sketch;
  visit(corners, triangles, balls, line);
}

/// Runs the preset for a moment on the CPU, coarsened where it is large; where it diverges, until then. Throws
/// EngineError, std::bad_alloc.
SceneSketch sketch_of(const Preset& preset, const Stop& stop);

/// The preset at its start, available at once. Throws EngineError, std::bad_alloc.
SceneSketch sketch_at_start(const Preset& preset);

/// The requested sketches of presets, made one by one: first those that are visible.
class SceneSketches {
 public:
  /// The sketch of a preset: its start, until the moved one is ready.
  const SceneSketch& of(const Preset& preset);
  bool moved(const Preset& preset) const;  ///< what it gives for that preset is no longer how it starts
  /// To be called once per frame: takes finished sketches and continues; returns whether there are more to come.
  bool poll();

 private:
  struct Made {
    Preset preset;
    SceneSketch sketch;
    bool moved = false;
    std::uint64_t asked = 0;  ///< the frame in which it was last asked for
  };
  Made* next();

  std::list<Made> all_;  ///< in the order in which they were first asked for; what is handed out stays where it is
  Made* making_ = nullptr;
  std::uint64_t frame_ = 1;
  Job<SceneSketch> work_;
};

}  // namespace tyglab
