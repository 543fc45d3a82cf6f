// Leaving out effects where drawing is slow: in order, after a few frames, and back without flickering.
#include "app/scene/effects.h"

#include <doctest/doctest.h>

namespace tyglab::effects_test {

void draw(Effects& effects, double ms, int frames) {
  for (int n = 0; n < frames; ++n) effects.drew(ms);
}

constexpr int enough = Effects::looks + 10;  // to settle, and for a mean

TEST_CASE("slow drawing leaves out one effect after another, in their order, and says so") {
  Effects effects;
  ViewOptions view;
  draw(effects, 12, 1000);
  CHECK(effects.left_out() == 0);
  CHECK(effects.words().empty());
  draw(effects, 45, enough);
  CHECK(effects.words() == "soft shadows");
  effects.apply(view);
  CHECK_FALSE(view.soft_shadows);
  CHECK(view.samples == 4);
  draw(effects, 35, enough);
  CHECK(effects.words() == "soft shadows and smooth edges");
  effects.apply(view);
  CHECK(view.samples == 1);
  CHECK(view.shadows);
  draw(effects, 30, enough);
  CHECK(effects.words() == "shadows and smooth edges");
  effects.apply(view);
  CHECK_FALSE(view.shadows);
  draw(effects, 30, 1000);
  CHECK(effects.left_out() == Effects::count);
}

TEST_CASE("a single slow frame, or a few after a change of size, leave nothing out") {
  Effects effects;
  for (int n = 0; n < 50; ++n) draw(effects, 12, 29), draw(effects, 90, 1);
  CHECK(effects.left_out() == 0);
  for (int n = 0; n < 100; ++n) effects.disturb(), draw(effects, 90, 10);
  CHECK(effects.left_out() == 0);
}

TEST_CASE("an effect comes back once there is room for it, and less often where it was in vain") {
  Effects effects;
  draw(effects, 24, enough);
  draw(effects, 18, enough);  // it had cost 6 ms
  CHECK(effects.left_out() == 1);
  draw(effects, 10, 10 * Effects::patience);  // with it 16 ms, too near to the limit
  CHECK(effects.left_out() == 1);
  draw(effects, 5, 2 * Effects::patience);
  CHECK(effects.left_out() == 0);
  int changes = 0, before = 0;
  for (int frame = 0; frame < 100 * Effects::patience; ++frame) {
    effects.drew(effects.left_out() == 0 ? 24 : 5);  // each time it is too slow after all
    changes += effects.left_out() != before;
    before = effects.left_out();
  }
  CHECK(changes < 16);
}

TEST_CASE("who wishes all effects, or few, has them at once and for good") {
  Effects effects;
  effects.mode = Effects::Mode::all;
  draw(effects, 90, 1000);
  CHECK(effects.left_out() == 0);
  effects.mode = Effects::Mode::few;
  CHECK(effects.left_out() == Effects::count);
  draw(effects, 1, 1000);
  CHECK(effects.left_out() == Effects::count);
}

}  // namespace tyglab::effects_test
