#include "app/cli/film.h"

#include <algorithm>
#include <iostream>
#include <stdexcept>

#include "app/base/files.h"
#include "app/base/image.h"
#include "app/cli/stepping.h"
#include "app/process/interrupt.h"
#include "app/render/cloth_renderer.h"
#include "app/ui/kit/color_legend.h"
#include "app/ui/kit/scene_picture.h"
#include "core/io/terminal.h"

namespace tyglab {

Film::Film(const Preset& preset, int view, PictureSize size, std::optional<ParticleField> color)
    : texture_(std::async(std::launch::async, read_picture, texture_file(preset.texture))),
      size_(size),
      camera_(scene_camera(preset, float(size.width) / float(size.height))) {
  options_.mode = view == 0 ? preset.mode : view;
  const auto warn = [](const std::string& problem) {
    std::cerr << "tyglab: view.texture: the cloth is drawn without its image: " << in_one_line(problem) << '\n';
  };
  try {
    if (const auto problem = renderer_.set_texture(texture_.get())) warn(*problem);
  } catch (const std::runtime_error& error) {
    warn(error.what());
  }
  if (!color || preset.kind != Kind::cloth) return;
  colors_.emplace(FieldColors{*color});
  renderer_.set_color_map(map_colors(colors_->map(false), map_size));
}

/// What was drawn last, with what its colors mean in a corner.
Image Film::with_legend() const {
  constexpr float height_at_1 = 720, least_scale = 0.6f;
  Theme theme;
  theme.scale = std::max(float(size_.height) / height_at_1, least_scale);
  const ImVec2 size{float(size_.width), float(size_.height)};
  const float margin = theme.px(16);
  const ImVec2 legend = legend_size(theme, std::max(size.x - 2 * margin, 1.f));
  const PictureGui gui(size, theme);
  gui.show(renderer_.texture_id());
  draw_color_legend({gui.draw(), theme, gui.fonts()}, {size.x - margin - legend.x, size.y - margin - legend.y}, legend,
                    {.field = info(colors_->field),
                     .map = colors_->map(false),
                     .top = colors_->top(),
                     .root = root_scale(colors_->field),
                     .beyond = colors_->beyond()});
  return gui.pixels();
}

std::filesystem::path Film::shoot(Simulation& simulation, const std::filesystem::path& file, Reach reach) {
  std::optional<InterruptExit> at_once;
  if (takes_long_to_show(simulation)) at_once.emplace();
  renderer_.lend_memory(simulation);
  renderer_.update(simulation, options_);
  if (colors_) {
    std::vector<float> values;
    const DrawnSites sites = drawn_sites(simulation, options_.every);
    read_field(colors_->field, simulation, nullptr, sites, values);
    renderer_.set_values(values, sites.rows(), sites.columns());
    colors_->look(span_of(values), simulation.preset());
    options_.colored = colors_->range();
  }
  renderer_.draw(camera_, options_, size_.width, size_.height);
  return write_png(file, colors_ ? with_legend() : renderer_.pixels(), reach);
}

}  // namespace tyglab
