#include <array>
#include <optional>

#include "app/ui/overlay/overlay.h"
#include "core/contact/crossings.h"

namespace tyglab {
namespace {

void outline(Ui& ui, ImDrawList& draw, const TriangleSite& site) {
  const auto& corners = quad_triangles[std::size_t((site.i + site.j) & 1)][std::size_t(site.which)];
  std::array<ImVec2, 3> pixels;
  for (std::size_t n = 0; n < 3; ++n) {
    const Mesh* mesh = ui.session.simulation->tears().mesh();
    const int columns = ui.session.simulation->lattice().columns;
    const int particle = mesh != nullptr ? mesh->corner(site.i, site.j, corners[n])
                                         : (site.i + corners[n].di) * columns + site.j + corners[n].dj;
    const auto pixel = particle_on_screen(ui, 0, {particle / columns, particle % columns});
    if (!pixel) return;
    pixels[n] = *pixel;
  }
  draw.AddTriangle(pixels[0], pixels[1], pixels[2], ui.theme.colors.warning, ui.theme.px(1.5f));
}

}  // namespace

void crossing_triangles(Ui& ui, ImDrawList& draw) {
  const CrossingWatch& watch = ui.session.studies.crossings;
  const Lattice& lattice = ui.session.simulation->lattice();
  if (!watch.found() || watch.lattice() != lattice) return;
  for (const int number : watch.found()->triangles) outline(ui, draw, triangle_at(lattice.sites(), number));
}

}  // namespace tyglab
