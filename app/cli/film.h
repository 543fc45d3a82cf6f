// Pictures of a simulation without a window.
#pragma once

#include <filesystem>
#include <future>

#include "app/platform/headless_context.h"
#include "app/render/camera.h"
#include "app/render/cloth_renderer.h"
#include "app/render/cloth_texture.h"
#include "app/render/field_colors.h"
#include "core/simulation.h"

namespace tyglab {

struct PictureSize {
  int width = 1280, height = 720;  ///< pixels
};

/// Draws a scene with a fixed camera and writes pictures.
class Film {
 public:
  /// `view`: 1 to 5, 0: the preset's own. A texture that cannot be read is reported on stderr. Throws GraphicsError.
  /// `color`: what colors the cloth, with a legend in the picture; none: it has its own look.
  Film(const Preset& preset, int view, PictureSize size, std::optional<ParticleField> color = {});
  /// Returns where the picture is (write_output). Throws OutputError.
  std::filesystem::path shoot(Simulation& simulation, const std::filesystem::path& file, Reach reach = Reach::whole);

 private:
  std::future<ClothPicture> texture_;  // read while the context is made
  HeadlessContext context_;            // before what lives in it
  ClothRenderer renderer_;
  ViewOptions options_;
  Image with_legend() const;

  PictureSize size_;
  Camera camera_;
  std::optional<FieldColors> colors_;
};

}  // namespace tyglab
