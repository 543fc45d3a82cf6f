#include "app/ui/kit/scene_picture.h"

#include <algorithm>
#include <vector>

#include "app/scene/sketch.h"

namespace tyglab {
namespace {

ImU32 lit(const Tokens& c, const SceneSketch::Corner& corner) {
  if (!corner.cloth) return mixed(c.ground, c.quiet, 0.45f + 0.35f * std::clamp(corner.light, 0.f, 1.f));
  const ImU32 shade = mixed(c.ground, c.accent, c.light ? 0.75f : 0.35f),
              bright = mixed(c.accent, rgb(0xffffff), 0.55f);
  return mixed(shade, bright, std::clamp(corner.light, 0.f, 1.f));
}

/// Some of the triangles; corners are shared.
void draw_triangles(ImDrawList& draw, const Tokens& c, const SceneSketch& sketch, const std::vector<ImVec2>& at,
                    std::size_t from, std::size_t to) {
  if (from >= to) return;
  draw.PrimReserve(int(3 * (to - from)), int(at.size()));
  const unsigned first = draw._VtxCurrentIdx;
  const ImVec2 white = draw._Data->TexUvWhitePixel;
  for (std::size_t n = from; n < to; ++n)
    for (const std::uint16_t corner : sketch.triangles[n]) draw.PrimWriteIdx(ImDrawIdx(first + corner));
  for (std::size_t n = 0; n < at.size(); ++n) draw.PrimWriteVtx(at[n], white, lit(c, sketch.corners[n]));
}

}  // namespace

void draw_scene(ImDrawList& draw, const Theme& theme, const SceneSketch& sketch, ImVec2 lo, ImVec2 hi) {
  const Tokens& c = theme.colors;
  const ImVec2 size{hi.x - lo.x, hi.y - lo.y};
  const auto pixel = [&](glm::vec2 at) { return ImVec2{lo.x + at.x * size.x, lo.y + at.y * size.y}; };
  draw.PushClipRect(lo, hi, true);
  std::vector<ImVec2> at;
  for (const SceneSketch::Corner& corner : sketch.corners) at.push_back(pixel(corner.at));
  std::vector<ImVec2> line;
  for (const glm::vec2 point : sketch.line) line.push_back(pixel(point));
  if (!line.empty()) draw.AddPolyline(line.data(), int(line.size()), c.text, ImDrawFlags_None, theme.px(2));
  std::size_t drawn = 0;
  for (const SceneSketch::Ball& ball : sketch.balls) {
    const std::size_t behind = std::max(ball.behind, drawn);
    draw_triangles(draw, c, sketch, at, drawn, behind);
    drawn = behind;
    const ImVec2 middle = pixel(ball.at);
    const float radius = ball.radius * size.y;
    draw.AddCircleFilled(middle, radius, mixed(c.ground, c.quiet, 0.6f), 48);
    draw.AddCircleFilled({middle.x - 0.25f * radius, middle.y - 0.3f * radius}, 0.55f * radius,
                         mixed(c.ground, c.quiet, 0.75f), 32);
  }
  draw_triangles(draw, c, sketch, at, drawn, sketch.triangles.size());
  draw.PopClipRect();
}

}  // namespace tyglab
