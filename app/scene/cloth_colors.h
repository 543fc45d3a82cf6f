// The coloring of the cloths in the window, computed only while it is shown and something has moved.
//
// Copies share one scale, so the values of all pictures are computed before any is drawn. The scale ends at a round
// number that 98 % of the values stay below, but never below a floor (least_top), so rounding noise has no colors. It
// grows at once and shrinks after forty frames of motion in which it was not needed (SteadyTop). The user can also drag
// or type its end. A replay starts with a separate scale, which grows with the values; the scale of its end would leave
// all but the last steps pale. Values beyond the scale have the color of its end, and the ends of the legend are then
// arrows. A texture stores the values, one float per particle; fragments interpolate values, not colors, and look them
// up in 256 colors that are evenly spaced in Oklab (app/render/field_colors.h). The shaders are the usual files,
// compiled a second time with COLORED once a cloth is colored. The choice of the quantity is stored in the settings,
// not in presets.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/render/field_colors.h"

namespace tyglab {

struct Scene;
class ClothRenderer;

class ClothColors {
 public:
  std::optional<FieldColors> chosen;   ///< none: the cloth has its own look
  std::optional<float> under_pointer;  ///< the value of the particle that the pointer touches

  /// Takes a field, with an automatic scale, or none.
  void choose(std::optional<ParticleField> field);
  /// Computes the missing values of the n-th picture; to be called for all pictures before any is drawn, since they
  /// share one scale.
  void update(Scene& scene, int tile, int every);
  /// Passes the missing values to the renderer of that picture.
  void give(Scene& scene, int tile, ClothRenderer& renderer);
  /// The value of a particle in the n-th picture; none where it is not known.
  std::optional<float> value(int tile, Pins::Site site) const;
  /// Counts up whenever values of that picture change.
  std::uint64_t version(int tile) const;

 private:
  /// The source of the values of a picture.
  struct Source {
    const Simulation* cloth = nullptr;
    std::uint64_t revision = 0;
    const Simulation* reference = nullptr;
    std::uint64_t reference_revision = 0;
    Preset constants;
    ParticleField field{};
    int every = 0;
    bool wreck = false;  ///< the step in which it diverges is undone, and leaves its state and revision as they were
    bool operator==(const Source&) const = default;
  };
  struct Picture {
    Source of;
    DrawnSites sites;
    std::vector<float> values;
    std::uint64_t version = 0;
    const ClothRenderer* given_to = nullptr;
    std::uint64_t given = 0;
    bool wreck = false;  ///< its cloth had diverged
  };

  std::vector<Picture> pictures_;
  std::uint64_t versions_ = 0;
  std::optional<ColorMap> map_;
};

/// Whether the viewport's ground is light, which asks for other colors.
bool light_ground(const Scene& scene);
/// Why the cloth cannot be colored by that field now, a sentence; empty if it can.
std::string why_not_colored(const Scene& scene, ParticleField field);
/// The field and scale that color the cloth at present; null if none do.
const FieldColors* shown_colors(const Scene& scene);
/// The field after the present one that can be shown, or after the last none.
std::optional<ParticleField> next_field(const Scene& scene);

}  // namespace tyglab
