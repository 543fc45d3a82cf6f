// Draws a simulation: cloth (or a mass on a spring), bodies and ground, in the five views of 2.4. OpenGL 3.3 core.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/base/frame_costs.h"
#include "app/base/image.h"
#include "app/base/vertex_path.h"
#include "app/render/camera.h"
#include "app/render/cloth_texture.h"
#include "core/cloth/lattice.h"
#include "core/simulation.h"

namespace tyglab {

/// Colors of a theme, sRGB 0 to 1. The defaults are the dark theme's.
struct Palette {
  glm::vec3 background_top{0.169f, 0.188f, 0.231f};     // #2B303B
  glm::vec3 background_bottom{0.086f, 0.094f, 0.114f};  // #16181D
  glm::vec3 grid{0.357f, 0.404f, 0.478f};               // #5B677A
  glm::vec3 hem{0.043f, 0.063f, 0.110f};                // #0B101C
  glm::vec3 lines{0.337f, 0.706f, 0.914f};              // #56B4E9
  glm::vec3 bending{0.0f, 0.620f, 0.451f};              // #009E73, F_b's
  glm::vec3 points{0.902f, 0.910f, 0.925f};             // #E6E8EC
  glm::vec3 pins{0.902f, 0.624f, 0.0f};                 // #E69F00
  glm::vec3 highlight{1.0f, 1.0f, 1.0f};
  glm::vec3 body{0.565f, 0.584f, 0.624f};
  glm::vec3 plane{0.247f, 0.271f, 0.318f};  // #3F4551
  bool operator==(const Palette&) const = default;
};
/// The colors of the light themes.
inline constexpr Palette light_palette{.background_top = {0.914f, 0.929f, 0.949f},     // #E9EDF2
                                       .background_bottom = {0.761f, 0.796f, 0.843f},  // #C2CBD7
                                       .grid = {0.518f, 0.565f, 0.631f},               // #8490A1
                                       .hem = {0.043f, 0.063f, 0.110f},                // #0B101C
                                       .lines = {0.0f, 0.392f, 0.624f},                // #00649F
                                       .bending = {0.0f, 0.439f, 0.310f},              // #00704F, F_b's
                                       .points = {0.078f, 0.086f, 0.106f},             // #14161B
                                       .pins = {0.627f, 0.373f, 0.0f},                 // #A05F00
                                       .highlight = {0.0f, 0.0f, 0.0f},
                                       .body = {0.545f, 0.569f, 0.608f},
                                       .plane = {0.925f, 0.929f, 0.937f}};  // #ECEDEF

/// The values at the ends of the color map, and whether the colors between them follow the square root.
struct ValueRange {
  float lo = 0, hi = 1;
  bool root = false;
  bool operator==(const ValueRange&) const = default;
};

/// The look of a picture. Widths and sizes are in pixels of the target.
struct ViewOptions {
  int mode = 1;          ///< 1 triangles, 2 connections, 3 both, 4 outlines, 5 points
  bool bending = false;  ///< bending springs too, in view 2
  bool ground = true;
  bool equilibrium = true;  ///< of a mass on a spring: the line where it hangs at rest
  bool shadows = true;
  bool soft_shadows = true;  ///< with soft edges
  Palette palette;
  float line_width = 1.6f;  ///< the thickest; lines get thinner where they are dense
  float point_size = 9;     ///< the largest; points get smaller where they are dense
  std::optional<Pins::Site> highlighted;
  /// Triangles and lines with an edge longer than this are left out, m; 0: none is. Of a diverged cloth it leaves what
  /// still looks like cloth.
  float longest_edge = 0;
  int every = 1;    ///< draws every n-th of the rows and columns: cloth finer than the picture (drawn_every)
  int samples = 4;  ///< multisampling, 1: none
  /// The cloth has the colors of its particles' values (set_values), not its own.
  std::optional<ValueRange> colored;
  /// Whether the view shows surfaces of the cloth, which need normals and cast shadows.
  bool lit() const { return mode == 1 || mode == 3; }
  bool operator==(const ViewOptions&) const = default;
};

/// An engine whose device writes vertex buffers itself, and which particles it is to write.
struct VertexWriter {
  Engine* engine = nullptr;
  DrawnSites sites;
};

/// The drawn scene, independent of its source (Simulation, or a test).
struct ClothScene {
  PositionView positions;  ///< with a writer only its sizes

  const Lattice& lattice;
  const Tears& tears;
  Preset preset;                         ///< with its bodies where they are
  std::function<bool(int, int)> pinned;  ///< may be empty: none is
  std::optional<VertexWriter> writer = {};
};

/// The times of updates and drawings; 0: skipped.
struct RenderWork {
  Duration normals, upload;
  Duration index_lists;  ///< what a view draws of them: made again where it lacks some
  Duration shadow;       ///< a part of draw()
  bool moved = false;    ///< the cloth had moved
  VertexPath vertex_path = VertexPath::copied;
  /// Bytes of positions and normals that the program copied: 0 where OpenGL draws what the device wrote.
  std::size_t copied = 0;
  std::string why_copied;  ///< a part of a sentence; empty: they were not
  /// Bytes that others read of a device's arrays meanwhile (plots, rewinding, the sleep of a cloth at rest …), and the
  /// first look at what it has written.
  std::size_t read = 0;
};

class ClothRenderer;

/// Another cloth, drawn as lines over the picture of the first.
struct Ghost {
  const ClothRenderer* cloth = nullptr;  ///< updated with view 4
  glm::vec3 color{1};
};

class ClothRenderer {
 public:
  /// Needs a current OpenGL 3.3 context whose functions are loaded. Throws GraphicsError (with the compiler's log) and
  /// DataFileError.
  ClothRenderer();
  /// For a second cloth with the same picture: shares shaders and texture with the first.
  explicit ClothRenderer(const ClothRenderer& sibling);
  ~ClothRenderer();

  /// Takes a picture as the cloth's texture. A bad file gives a sentence about it, and the old texture stays.
  std::optional<std::string> set_texture(const std::filesystem::path& file);
  /// The same with a picture that has been read already.
  std::optional<std::string> set_texture(const ClothPicture& picture);

  /// Lends the simulation's engine memory of OpenGL's, if it can use it, so that its positions need not be copied. The
  /// engine steps no more once this renderer and its siblings are gone. Not while another thread reads the simulation.
  /// Graphics cards need none: update() has them write buffers of OpenGL where they can.
  void lend_memory(Simulation& simulation);
  /// Uploads what changed since the last call and what this view needs: nothing where nothing moved, normals only in
  /// lit views, index lists only after tears or a change of view.
  void update(Simulation& simulation, const ViewOptions& options);
  /// The same without a Simulation. `topology_changed`: lattice, tears or pins differ from last time.
  void update(const ClothScene& scene, const ViewOptions& options, bool topology_changed);

  /// The values that color this cloth: one per drawn particle, row by row. Not-a-number is gray.
  void set_values(std::span<const float> values, int rows, int columns);
  /// The colors from the smallest to the largest value, as bytes red, green, blue, opacity; siblings share them.
  void set_color_map(std::span<const std::uint32_t> colors);

  /// Draws into its own multisampled target of that size (pixels) and resolves it. Restores framebuffer and viewport.
  void draw(const Camera& camera, const ViewOptions& options, int width, int height,
            std::span<const Ghost> ghosts = {});

  /// The resolved RGBA8 texture, for ImGui::Image: its first row is the picture's bottom one (uv0 (0,1), uv1 (1,0)).
  unsigned texture_id() const;
  /// The time of the graphics card for the last drawing that it has reported, ms: a frame or two ago; 0 before that.
  double drawn_ms();
  /// The work done since the last call.
  RenderWork take_work();
  /// The box of the particles at the last update.
  const Bounds& bounds() const;
  /// Size of the buffers that grow with the cloth, including memory lent to siblings' engines.
  std::size_t bytes() const;
  /// The picture drawn last.
  Image pixels() const;

 private:
  struct Shared;
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// Selects the visible part of a cloth that is finer than the picture.

/// Every how many rows and columns are drawn in a picture of that size, so that no more than about four particles share
/// a pixel of a cloth that fills it as framed: 1 draws all.
int drawn_every(const Lattice& lattice, int width, int height);

/// Every n-th row and column of a cloth, the last ones included, as a cloth of its own.
class DrawnCloth {
 public:
  /// Takes what changed. `every` is 2 or more.
  void take(const ClothScene& scene, int every, bool moved, bool topology_changed);
  /// Valid until the next take(), while the scene that was taken lives.
  ClothScene scene(const ClothScene& whole) const;
  std::size_t bytes() const { return positions_.capacity() * sizeof(float); }

 private:
  void take_positions(const PositionView& view);
  void take_tears(const Tears& tears);
  bool torn_between(const Tears& tears, int direction, int i, int j) const;

  DrawnSites sites_{{}, 0};
  Lattice lattice_;
  Tears tears_;
  std::vector<float> positions_;  ///< laid out as an engine's: a row's x, its y, its z
};

}  // namespace tyglab
