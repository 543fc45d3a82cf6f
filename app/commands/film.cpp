#include "app/commands/film.h"

#include <iostream>

#include "app/data_files.h"
#include "app/viewport/image.h"

namespace tyglab {

Film::Film(const Preset& preset, int view, PictureSize size)
    : size_(size), camera_(scene_camera(preset, float(size.width) / float(size.height))) {
  options_.mode = view == 0 ? preset.mode : view;
  if (const auto problem = renderer_.set_texture(texture_file(preset.texture)))
    std::cerr << "tyglab: " << *problem << '\n';
}

void Film::shoot(Simulation& simulation, const std::filesystem::path& file) {
  renderer_.lend_memory(simulation);
  renderer_.update(simulation, options_);
  renderer_.draw(camera_, options_, size_.width, size_.height);
  write_png(file, renderer_.pixels());
}

}  // namespace tyglab
