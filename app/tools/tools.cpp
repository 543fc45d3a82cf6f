#include "app/tools/tools.h"

#include "app/tools/knife.h"

namespace tyglab {

void Tools::follow() {
  const SessionCounts& counts = session.counts;
  if (counts.documents != seen_.documents) tool = Tool{}, wind_arrow.reset();
  if (counts.hands != seen_.hands) tool.kind = Tool::Kind::none;
  if (counts.lattices != seen_.lattices) {
    tool.site.reset(), tool.last_site.reset();
    if (tool.kind == Tool::Kind::grab) tool.kind = Tool::Kind::none;
  }
  seen_ = counts;
}

SessionInput Tools::session_input() {
  SessionInput wanted;
  if (tool.kind == Tool::Kind::grab) wanted.hand = tool.hand;
  if (cuts_between_steps(*this)) wanted.after_steps = [this] { use_knife(*this); };
  wanted.touched = tool.kind != Tool::Kind::none;
  wanted.slow_motion = settings.slow_hand && hand_in_cloth(*this);
  return wanted;
}

}  // namespace tyglab
