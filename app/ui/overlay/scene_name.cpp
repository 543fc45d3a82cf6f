// The name of the scene in presentation mode.
#include <algorithm>
#include <cmath>
#include <string>

#include "app/base/numbers.h"
#include "app/session/motion.h"
#include "app/ui/kit/symbol.h"
#include "app/ui/overlay/overlay.h"

namespace tyglab {

void scene_name(Ui& ui, ImDrawList& draw, const Box& row) {
  const Tokens& c = ui.theme.colors;
  const ImFont &font = *ui.fonts.title, &mono = *ui.fonts.mono;
  const float pad = ui.theme.px(12), gap = ui.theme.px(14);
  const Preset& preset = ui.session.preset();
  const std::string time =
      ui.time_in_picture ? "t = " + time_number(clock_time(ui.session), preset.dt) + " s" : std::string();
  const float time_width = time.empty() ? 0 : gap + text_width(mono, time);
  // PAUSED has its place beside it.
  const float most = row.hi.x - row.lo.x - pause_mark_size(ui).x - gap;
  const std::string name = fitted(font, preset.name, most - 2 * pad - time_width);
  const float name_width = text_width(font, name);
  const Box box{row.lo, {std::ceil(row.lo.x + 2 * pad + name_width + time_width), row.hi.y}};
  draw.AddRectFilled(vec(box.lo), vec(box.hi), faded(c.ground, 0.85f), ui.theme.px(6));
  const float baseline = baseline_at(ui.fonts, (box.lo.y + box.hi.y) / 2);
  draw_on_baseline(draw, font, {box.lo.x + pad, baseline}, c.text, name);
  if (!time.empty()) draw_on_baseline(draw, mono, {box.lo.x + pad + name_width + gap, baseline}, c.text, time);
  ui.placing.take("scene_name", box);
}

}  // namespace tyglab
