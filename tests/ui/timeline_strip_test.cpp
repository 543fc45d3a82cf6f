// The timeline below the picture, with the pointer and by keys.
#include <doctest/doctest.h>

#include "app/session/timeline.h"
#include "tests/ui/null_ui.h"

namespace tyglab::timeline_strip_test {

TEST_CASE("a drag on the timeline goes to any step, and Space repeats what was done from there") {
  test::NullUi window;
  window.frames(60);
  window.key(GLFW_KEY_SPACE);
  window.rest();
  const std::int64_t end = window.session.simulation->past().steps();
  REQUIRE(end > 200);
  const std::uint64_t at_end = window.session.simulation->hash();
  const Box strip = window.control("viewport.timeline");
  CHECK(strip.lo.y >= window.ui.viewport.box.hi.y);
  const float y = (strip.lo.y + strip.hi.y) / 2, width = strip.hi.x - strip.lo.x;
  window.drag({glm::vec2(strip.lo.x + 0.9f * width, y), glm::vec2(strip.lo.x + 0.3f * width, y)});
  window.frames(3);
  const std::int64_t there = window.session.simulation->past().steps();
  CHECK(there > 0.2 * double(end));
  CHECK(there < 0.4 * double(end));
  CHECK(window.session.repetition);
  CHECK_FALSE(window.session.pacing.playing);
  CHECK(present_line(window.session).steps() == end);

  window.key(GLFW_KEY_RIGHT, GLFW_MOD_SHIFT);
  window.frames(2);
  CHECK(window.session.simulation->past().steps() == there + 1);
  window.key(GLFW_KEY_LEFT, GLFW_MOD_CONTROL);
  window.frames(2);
  CHECK(window.session.simulation->past().steps() == there + 1 - std::int64_t(0.1 / window.session.preset().dt + 0.5));
  go_to_step(window.session, end);
  CHECK(window.session.simulation->hash() == at_end);
}

}  // namespace tyglab::timeline_strip_test
