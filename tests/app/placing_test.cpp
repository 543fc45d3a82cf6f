// Where marks over the cloth stand: none over another, as near to their corner as that allows, and still.
#include <doctest/doctest.h>

#include <array>

#include "app/ui/kit/overlay_layout.h"

namespace tyglab::placing_test {

const Box area{{0, 0}, {400, 300}};

TEST_CASE("a mark stands in its corner, or beside what has taken it, and nowhere where the side is full") {
  OverlayLayout placing;
  placing.begin(4);
  const auto first = placing.in_corner(area, {100, 50}, ScreenCorner::lower_right);
  REQUIRE(first.has_value());
  CHECK(first->lo == glm::vec2(300, 250));
  placing.take("first", *first);
  const auto second = placing.in_corner(area, {80, 20}, ScreenCorner::lower_right);
  REQUIRE(second.has_value());
  CHECK(second->lo == glm::vec2(320, 226));
  CHECK(placing.in_corner(area, {80, 20}, ScreenCorner::upper_right)->lo == glm::vec2(320, 0));
  CHECK(placing.in_corner(area, {80, 20}, ScreenCorner::lower_left)->lo == glm::vec2(0, 280));
  CHECK_FALSE(placing.in_corner(area, {80, 260}, ScreenCorner::lower_right).has_value());
  CHECK_FALSE(placing.in_corner(area, {401, 20}, ScreenCorner::lower_left).has_value());
  CHECK(placing.find("first")->lo.y == 250);
  CHECK(placing.find("second") == nullptr);
  placing.take("second", *second);
  placing.back_to("second");
  CHECK(placing.marks().size() == 1);
  placing.begin(4);
  CHECK(placing.marks().empty());
}

TEST_CASE("marks keep their gap, and a label takes the first of its places that is free") {
  OverlayLayout placing;
  placing.begin(4);
  placing.take("bar", {{100, 100}, {200, 120}});
  CHECK_FALSE(placing.free({{203, 100}, {220, 120}}));
  CHECK(placing.free({{205, 100}, {220, 120}}));
  const std::array<Box, 3> places{{{{150, 110}, {170, 130}}, {{150, 123}, {170, 140}}, {{150, 130}, {170, 150}}}};
  CHECK(placing.first_free(places)->lo.y == 130);
  CHECK_FALSE(placing.first_free(std::span(places).first(2)).has_value());
}

TEST_CASE("a mark leaves the place where it covers something, and does not run about") {
  const std::array<std::optional<Box>, 3> places{Box{{300, 250}, {400, 300}}, std::nullopt, Box{{0, 250}, {100, 300}}};
  const std::array<Box, 1> right{{{{350, 200}, {420, 260}}}};
  const std::array<Box, 2> both{{{{350, 200}, {420, 260}}, {{80, 290}, {200, 300}}}};
  const std::array<Box, 2> alike{{{{350, 200}, {420, 260}}, {{50, 200}, {110, 258}}}};
  CHECK(covered(*places[0], right) == 500);
  CHECK(choose_place(places, {}, {}) == 0u);
  CHECK(choose_place(places, right, {}) == 2u);
  CHECK(choose_place(places, right, 0) == 2u);
  CHECK(choose_place(places, {}, 2) == 2u);     // nothing drives it back
  CHECK(choose_place(places, both, 0) == 2u);   // less than half is covered there
  CHECK(choose_place(places, alike, 0) == 0u);  // hardly better elsewhere
  CHECK(choose_place(places, {}, 1) == 0u);     // its place is gone
  CHECK_FALSE(choose_place(std::span(places).subspan(1, 1), {}, {}).has_value());
}

}  // namespace tyglab::placing_test
