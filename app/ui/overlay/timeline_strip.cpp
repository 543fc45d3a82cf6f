// The timeline at the foot of the viewport: what has been recorded, with a mark for everything that was done. A drag
// goes to any step of it; a branch's mark leads back to the course that was left there.
#include <algorithm>
#include <cmath>
#include <string>

#include "app/base/text.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"
#include "app/ui/overlay/overlay.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

ImU32 color_of(const Tokens& c, TimelineMark::Kind kind) {
  using Kind = TimelineMark::Kind;
  switch (kind) {
    case Kind::change:
      return c.sky;
    case Kind::hand:
    case Kind::body:
      return c.orange;
    case Kind::cut:
      return c.vermilion;
    case Kind::diverged:
      return c.danger;
    case Kind::pin:
      return c.yellow;
    case Kind::branch:
      return c.magenta;
    default:
      return c.text;
  }
}

/// The strip's line in the window, and the steps that it stands for.
struct StepScale {
  float from, to;
  double steps;
  float at(std::int64_t step) const { return from + (to - from) * float(std::clamp(double(step) / steps, 0.0, 1.0)); }
  std::int64_t step(float x) const {
    return std::int64_t(std::llround(std::clamp((x - from) / (to - from), 0.f, 1.f) * steps));
  }
};

/// The mark under the pointer, if there is one within a few pixels.
const TimelineMark* mark_at(const std::vector<TimelineMark>& marks, const StepScale& scale, float x, float reach) {
  const TimelineMark* nearest = nullptr;
  for (const TimelineMark& mark : marks) {
    const float far = std::abs(scale.at(mark.step) - x);
    if (far <= reach && (nearest == nullptr || far <= std::abs(scale.at(nearest->step) - x))) nearest = &mark;
  }
  return nearest;
}

/// The number of the branch that left the line at that step.
std::size_t branch_at(const Session& session, std::int64_t step) {
  const auto& branches = session.timeline.branches();
  for (std::size_t n = branches.size(); n > 0; --n)
    if (branches[n - 1].from == step) return n - 1;
  return branches.size();
}

void draw_strip(Ui& ui, ImDrawList& draw, const StepScale& scale, float y, const std::vector<TimelineMark>& marks) {
  const Tokens& c = ui.theme.colors;
  const std::int64_t here = ui.session.simulation->past().steps();
  const float thin = ui.theme.px(3), tall = ui.theme.px(7), now = scale.at(here);
  draw.AddLine({scale.from, y}, {scale.to, y}, faded(c.ground, 0.6f), thin + ui.theme.px(4));
  draw.AddLine({scale.from, y}, {scale.to, y}, c.line, thin);
  draw.AddLine({scale.from, y}, {now, y}, c.accent, thin);
  for (const TimelineMark& mark : marks) {
    const float x = std::round(scale.at(mark.step));
    const ImU32 color = color_of(c, mark.kind);
    if (mark.kind == TimelineMark::Kind::branch)
      draw.AddTriangleFilled({x - tall, y + tall}, {x + tall, y + tall}, {x, y}, color);
    else
      draw.AddLine({x, y - tall}, {x, y + tall}, color, ui.theme.px(2));
  }
  draw.AddCircleFilled({now, y}, ui.theme.px(6), c.text, 20);
  draw.AddCircle({now, y}, ui.theme.px(6), faded(c.ground, 0.8f), 20, ui.theme.px(1.5f));
}

}  // namespace

float timeline_height(const Ui& ui, float region) {
  constexpr float height = 26, least_region = 300;  // px at scale 1
  const bool there = ui.panels && !ui.presenting && ui.session.requested_preset().kind == Kind::cloth;
  return there && region >= ui.theme.px(least_region) ? ui.theme.px(height) : 0;
}

void timeline_strip(Ui& ui, ImDrawList& draw, const Box& box) {
  Session& session = ui.session;
  const std::int64_t steps = present_line(session).steps();
  const float pad = ui.theme.px(16);
  const StepScale scale{box.lo.x + pad, box.hi.x - pad, double(std::max<std::int64_t>(steps, 1))};
  const std::vector<TimelineMark>& marks = session.timeline.marks(present_line(session), session.now);
  cover_viewport(ui, vec(box.lo), vec(box.hi));
  ImGui::SetCursorScreenPos(vec(box.lo));
  const bool clicked = gui::press_area("timeline", vec(box.hi - box.lo));
  report_control(ui, "timeline");
  const float x = ImGui::GetIO().MousePos.x;
  const TimelineMark* mark =
      ImGui::IsItemHovered() || clicked ? mark_at(marks, scale, x, ui.theme.px(ui.input.by_touch ? 14 : 6)) : nullptr;
  // A press that stays where it is goes to a mark under it; a drag goes to any step.
  const float slop = ui.theme.px(ui.input.by_touch ? 10 : 4);
  const bool active = ImGui::IsItemActive(), moved = ImGui::GetIO().MouseDragMaxDistanceSqr[0] > slop * slop;
  const bool dragged = active && moved;
  if (moved) mark = nullptr;
  const std::int64_t step = mark != nullptr ? mark->step : scale.step(x);
  if (ImGui::IsItemHovered() || dragged) {
    std::string words = "Step " + grouped(step) + " of " + grouped(steps);
    if (mark != nullptr) words += ": " + mark->words;
    words += mark != nullptr && mark->kind == TimelineMark::Kind::branch
                 ? ". A click returns to the former course."
                 : ". Drag to go to another step; what follows is repeated from there until you change something.";
    tooltip(ui, gui::item_id(), words);
  }
  const bool branches = mark != nullptr && mark->kind == TimelineMark::Kind::branch;
  if (clicked && !moved && branches) {
    if (const std::size_t branch = branch_at(session, mark->step); branch < session.timeline.branches().size())
      ui.act([branch](Ui& u) { go_to_branch(u.session, branch); });
  } else if (const bool let_go = ImGui::IsItemDeactivated();
             (let_go || (dragged && ImGui::GetIO().MouseDelta.x != 0)) && step != session.simulation->past().steps()) {
    constexpr double while_dragging = 0.1, at_last = 2;  // s
    session.pacing.playing = false;
    ui.act([step, seconds = let_go ? at_last : while_dragging](Ui& u) { go_to_step(u.session, step, seconds); });
  }
  draw_strip(ui, draw, scale, std::round((box.lo.y + box.hi.y) / 2), marks);
}

}  // namespace tyglab
