// Pictures of a simulation without a window.
#pragma once

#include <filesystem>
#include <future>
#include <iosfwd>

#include "app/platform/platform.h"
#include "app/render/camera.h"
#include "app/render/cloth_renderer.h"
#include "app/render/cloth_texture.h"
#include "app/render/field_colors.h"
#include "app/shell/sandbox.h"
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
  /// Returns the path of the picture (write_output). Throws OutputError.
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

// The replacement of the sandbox on a machine without a display.

/// Simulates the preset and writes pictures of it and its last state into a new folder ./tyglab-out, or tyglab-out-2
/// and so on where there is one: nothing is replaced. The screenshot and the time report too, where they are asked for.
/// Shows progress and names the files on `out`. Returns the exit code.
int run_headless(const SandboxOptions& options, std::ostream& out);

}  // namespace tyglab
