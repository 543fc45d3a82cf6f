#include "app/scene/cloth_colors.h"

#include <utility>

#include "app/scene/scene.h"

namespace tyglab {
namespace {

/// What distances in the n-th picture are measured from. Overlaid, the original shows how far the first copy is from
/// it where it is itself the reference.
Simulation* reference_of(Scene& scene, int tile) {
  const Copies& copies = scene.session.copies;
  if (copies.lockstep.empty()) return nullptr;
  const bool itself = copies.reference == Copies::original && tile == 0;
  return &cloth_of(scene.session, itself && copies.overlaid ? 0 : copies.reference);
}

}  // namespace

bool light_ground(const Scene& scene) {
  return scene.view.palette == light_palette;
}

void ClothColors::choose(std::optional<ParticleField> field) {
  if (field == (chosen ? std::optional(chosen->field) : std::nullopt)) return;
  chosen.reset();
  if (field) chosen.emplace(FieldColors{*field});
  pictures_.clear();
}

void ClothColors::update(Scene& scene, int tile, int every) {
  if (pictures_.size() <= std::size_t(tile)) pictures_.resize(std::size_t(tile) + 1);
  Picture& picture = pictures_[std::size_t(tile)];
  Simulation& cloth = cloth_in_tile(scene, tile);
  Simulation* reference = chosen->field == ParticleField::distance ? reference_of(scene, tile) : nullptr;
  const bool wreck = cloth.divergence().has_value();
  Source now{&cloth,         cloth.revision(), reference, reference != nullptr ? reference->revision() : 0,
             cloth.preset(), chosen->field,    every,     wreck};
  if (now == picture.of || scene.session.rebuild.holds_present()) return;  // then another thread reads the cloth
  const FrameCosts::Timer timer(scene.session.costs, Part::colors);
  picture.of = std::move(now);
  picture.sites = drawn_sites(cloth, every);
  read_field(chosen->field, cloth, reference, picture.sites, picture.values);
  picture.version = ++versions_;
  // Where another cloth shares the scale, what is left of one that has diverged would take all of it.
  if (wreck && !scene.session.copies.lockstep.empty()) return;
  if (std::exchange(picture.wreck, wreck) && !wreck) chosen->automatic.forget();
  chosen->look(span_of(picture.values), cloth.preset(), wreck);
}

void ClothColors::give(Scene& scene, int tile, ClothRenderer& renderer) {
  const ColorMap map = chosen->map(light_ground(scene));
  if (map_ != map) {
    scene.renderer->set_color_map(map_colors(map, map_size));
    map_ = map;
  }
  Picture& picture = pictures_[std::size_t(tile)];
  if (picture.given_to == &renderer && picture.given == picture.version) return;
  renderer.set_values(picture.values, picture.sites.rows(), picture.sites.columns());
  picture.given_to = &renderer, picture.given = picture.version;
}

std::optional<float> ClothColors::value(int tile, Pins::Site site) const {
  if (!chosen || std::size_t(tile) >= pictures_.size()) return std::nullopt;
  const Picture& picture = pictures_[std::size_t(tile)];
  const int every = picture.sites.every, row = (site.i + every / 2) / every, column = (site.j + every / 2) / every;
  if (row >= picture.sites.rows() || column >= picture.sites.columns()) return std::nullopt;
  const float value = picture.values[std::size_t(row) * std::size_t(picture.sites.columns()) + std::size_t(column)];
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::uint64_t ClothColors::version(int tile) const {
  return std::size_t(tile) < pictures_.size() ? pictures_[std::size_t(tile)].version : 0;
}

std::string why_not_colored(const Scene& scene, ParticleField field) {
  if (field == ParticleField::distance && scene.session.copies.lockstep.empty())
    return "There is no copy to measure from; add one first.";
  return {};
}

const FieldColors* shown_colors(const Scene& scene) {
  const auto& chosen = scene.colors.chosen;
  if (!chosen || scene.session.preset().kind != Kind::cloth || !why_not_colored(scene, chosen->field).empty())
    return nullptr;
  return &*chosen;
}

std::optional<ParticleField> next_field(const Scene& scene) {
  const auto fields = particle_fields();
  const auto& chosen = scene.colors.chosen;
  for (std::size_t k = chosen ? std::size_t(chosen->field) + 1 : 0; k < fields.size(); ++k)
    if (why_not_colored(scene, fields[k].field).empty()) return fields[k].field;
  return std::nullopt;
}

}  // namespace tyglab
