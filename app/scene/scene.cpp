#include "app/scene/scene.h"

namespace tyglab {

namespace {

/// Height and width of the cloth at rest, m.
glm::dvec2 extent(const Preset& preset) {
  return preset.L * glm::dvec2(preset.rows - 1, preset.columns - 1);
}

}  // namespace

void Scene::follow() {
  const SessionCounts& now = session.counts;
  if (now.documents != seen_.documents) wants_framing = true;
  if (now.lattices != seen_.lattices && extent(session.preset()) != extent_) wants_framing = true;
  extent_ = extent(session.preset());
  follow_restart();
  if (now.copies != seen_.copies) views.forget_copies();
  if (now.labs_begun != seen_.labs_begun) {
    const auto field = colors.chosen ? std::optional(colors.chosen->field) : std::nullopt;
    if (!own_look_) own_look_ = OwnLook{camera, camera_by_hand, field};
    colors.choose(std::nullopt);
  }
  if (now.lab_steps != seen_.lab_steps && session.labs.run) {
    const std::string& field = session.labs.run->now().color;
    if (!field.empty() || lab_colors_) colors.choose(field_called(field));
    lab_colors_ = !field.empty();
  }
  if (lab_colors_ && !session.labs.run) lab_colors_ = false, colors.choose(std::nullopt);
  if (own_look_ && !session.labs.run) {
    if (now.experiments_back != seen_.experiments_back) {
      if (own_look_->by_hand) camera = own_look_->camera, camera_by_hand = true, wants_framing = false;
      colors.choose(own_look_->color);
    }
    own_look_.reset();
  }
  // The line would answer what a lab asks for.
  view.equilibrium = !awaits_prediction(session);
  if (now.cloths != seen_.cloths) redraw = true;
  seen_ = now;
}

/// A restart brings the cloth back to where the scene's camera looks. Who looks at a part of it from a place of their
/// own goes on doing so.
void Scene::follow_restart() {
  constexpr float well = 0.5f;
  const double t = session.simulation->time();
  const bool restarted = t == 0 && seen_time_ > 0;
  seen_time_ = t;
  const glm::vec2 shown = viewport.size();
  if (!restarted || shown.x <= 1 || shown.y <= 1) return;
  const auto part = part_of_picture(camera, bounds(session.simulation->positions()), shown.x / shown.y);
  if (!camera_by_hand || !part || part->in_sight() < well) wants_framing = true;
}

void Scene::draw(glm::vec2 magnified) {
  views.draw(*this, magnified);
}

Simulation& cloth_in_tile(const Scene& scene, int tile) {
  return cloth_of(scene.session, tile < scene.session.copies.tiles() ? tile - 1 : Copies::original);
}

}  // namespace tyglab
