// What stands over the cloth: no mark over another, at every size of window and text, in every theme.
#include <doctest/doctest.h>

#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "app/base/glfw_keys.h"
#include "app/ui/overlay/overlay.h"
#include "tests/ui/null_ui.h"

namespace tyglab::marks_test {

constexpr int right = GLFW_MOUSE_BUTTON_RIGHT;

struct LookCase {
  glm::ivec2 size;
  double scale;
  const char* theme;
};
const LookCase looks[] = {{{1280, 720}, 1, "dark"},  {{1280, 720}, 1, "projector"}, {{1280, 720}, 2, "light"},
                          {{900, 600}, 1, "light"},  {{900, 600}, 2, "dark"},       {{1920, 1080}, 1.5, "projector"},
                          {{1920, 1080}, 2, "dark"}, {{900, 600}, 1.5, "dark"},     {{900, 600}, 1.5, "projector"}};

test::UiOptions options(const LookCase& look, const std::string& preset, const char* color = "") {
  return {.preset = preset, .size = look.size, .settings = [look, color](Settings& settings) {
            settings.ui_scale = look.scale, settings.theme = look.theme, settings.color = color;
          }};
}

void pause(test::NullUi& window) {
  window.until([&] { return window.t() > 0.3; }, "the cloth to fall a little");
  window.pause();
  window.rest();
  window.frames(6);
}

/// No two marks overlap, all are within the window, and those that are wanted are there.
void judge(test::NullUi& window, const LookCase& look, std::initializer_list<const char*> wanted) {
  const auto& marks = window.ui.placing.marks();
  for (std::size_t k = 0; k < marks.size(); ++k) {
    CAPTURE(marks[k].name);
    const Box& box = marks[k].box;
    CHECK(box.lo.x >= 0);
    CHECK(box.lo.y >= 0);
    CHECK(box.hi.x <= float(look.size.x));
    CHECK(box.hi.y <= float(look.size.y));
    for (std::size_t other = 0; other < k; ++other) {
      CAPTURE(marks[other].name);
      CHECK_FALSE(overlap(box, marks[other].box));
    }
  }
  for (const std::string name : wanted) {
    CAPTURE(name);
    CHECK(window.ui.placing.find(name) != nullptr);
  }
}

TEST_CASE("legend, scale of arrows, labels and PAUSED keep apart, and PAUSED off the cloth") {
  for (const LookCase& look : looks) {
    CAPTURE(look.size.x);
    CAPTURE(look.scale);
    CAPTURE(std::string(look.theme));
    test::NullUi window(options(look, "hanging", "tension"));
    pause(window);
    judge(window, look, {"views", "legend", "paused"});
    if (look.size.x > 900) CHECK(window.ui.placing.find("scale N") != nullptr);
    if (look.scale >= 2) continue;  // there the picture has no height to spare
    for (const char* name : {"legend", "paused"}) {
      CAPTURE(std::string(name));
      CHECK(covered(*window.ui.placing.find(name), drawn_parts(window.ui)) == 0);
    }
  }
}

TEST_CASE("the legend leaves a cloth that has come to lie under it, wherever there is free ground") {
  for (const bool presenting : {false, true})
    for (const LookCase& look : {looks[1], looks[3], LookCase{{900, 600}, 1, "projector"}}) {
      CAPTURE(presenting);
      CAPTURE(look.size.x);
      CAPTURE(std::string(look.theme));
      test::NullUi window(options(look, "sphere", "tension"));
      if (presenting) window.key(GLFW_KEY_F5);
      window.until([&] { return window.t() > 3; }, "the cloth to lie on the sphere");
      const Box* legend = window.ui.placing.find("legend");
      REQUIRE(legend != nullptr);
      const glm::vec2 size = legend->hi - legend->lo;
      CHECK(covered(*legend, drawn_parts(window.ui)) < 0.25f * size.x * size.y);
    }
  // A window that is made smaller.
  test::NullUi window(options(looks[0], "hanging", "tension"));
  window.until([&] { return window.t() > 1; }, "the cloth to hang");
  window.resize({900, 600});
  window.frames(120);
  const Box* legend = window.ui.placing.find("legend");
  REQUIRE(legend != nullptr);
  CHECK(covered(*legend, drawn_parts(window.ui)) <
        0.25f * (legend->hi.x - legend->lo.x) * (legend->hi.y - legend->lo.y));
}

TEST_CASE("the check of view 2 has a ground of its own beside or under the buttons, and the wind's label is seen") {
  for (const LookCase& look : std::span(looks).first(4)) {
    CAPTURE(look.size.x);
    CAPTURE(look.scale);
    CAPTURE(std::string(look.theme));
    test::UiOptions with = options(look, "flag", "tension");
    with.with = [](Preset& preset) { preset.mode = 2; };
    test::NullUi window(with);
    pause(window);
    judge(window, look, {"views", "bending", "legend", "wind"});
  }
}

TEST_CASE("the names of copies, the legend and the scales keep apart beside, above and under each other") {
  for (const LookCase& look : std::span(looks).subspan(1, 4)) {
    CAPTURE(look.size.x);
    CAPTURE(look.scale);
    CAPTURE(std::string(look.theme));
    test::NullUi window(options(look, "hanging", "tension"));
    for (const char* item : {"copy_double", "copy_half"}) {
      const std::size_t before = window.session.copies.lockstep.size();
      window.click("constants.k_s.value", right);
      window.click(std::string("menu.") + item);
      REQUIRE(window.session.copies.lockstep.size() == before + 1);
      if (before == 0) pause(window);
      window.rest();
      window.frames(9);
      judge(window, look, {"views", "name 0", "name 1", "paused"});
    }
    const Viewport& viewport = window.ui.viewport;
    const Box* legend = window.ui.placing.find("legend");
    const bool wide_enough = look.scale < 2;  // or no cell holds a legend
    if (legend == nullptr || viewport.columns != 2 || viewport.rows != 2 || !wide_enough) continue;
    const glm::vec2 middle = (viewport.box.lo + viewport.box.hi) / 2.f;
    CHECK(legend->lo.x > middle.x);  // it takes the cell that is empty
    CHECK(legend->lo.y > middle.y);
    const Box &row = *window.ui.placing.find("views"), &paused = *window.ui.placing.find("paused");
    const bool in_empty_cell = paused.lo.x > middle.x && paused.lo.y > middle.y;
    CHECK((paused.lo.y < row.hi.y || in_empty_cell));  // it stands on no picture
  }
}

TEST_CASE("a window of any width is drawn, also where a control has no room at all") {
  for (const char* theme : {"light", "projector"}) {
    CAPTURE(std::string(theme));
    test::NullUi window(options({{900, 600}, 1.5, theme}, "hanging", "tension"));
    for (const bool presenting : {false, true}) {
      CAPTURE(presenting);
      if (presenting) window.key(GLFW_KEY_F5);
      for (int width = 200; width < 700; ++width) {
        CAPTURE(width);
        window.resize({width, 828});
        window.frames(1);
      }
    }
  }
}

TEST_CASE("PAUSED stands clear of the one weight's spring") {
  for (const LookCase& look : std::span(looks).first(5)) {
    CAPTURE(look.size.x);
    CAPTURE(look.scale);
    CAPTURE(std::string(look.theme));
    test::NullUi window(options(look, "one_weight"));
    window.pause();
    window.rest();
    window.frames(6);
    judge(window, look, {"paused"});
    const std::vector<Box> parts = drawn_parts(window.ui);  // its spring, its ceiling, and its lines
    const float x = window.pixel_of(0, 0).x;
    REQUIRE(parts.front().lo.x < x);
    REQUIRE(x < parts.front().hi.x);
    for (const Box& part : parts) CHECK_FALSE(overlap(*window.ui.placing.find("paused"), part));
  }
}

TEST_CASE("a message stands on the status line, outside the picture, and a long one reaches up over its edge") {
  test::NullUi window(options({{1280, 720}, 1, "dark"}, "hanging"));
  pause(window);
  window.session.messages.note("Saved.");
  window.frames(3);
  const Box brief = window.control("message.dismiss");
  CHECK(brief.lo.y >= window.ui.viewport.box.hi.y);
  CHECK(brief.hi.y == 720);
  std::string many_words = "This one has many more words than the one above it, and needs more room. ";
  window.session.messages.note(many_words + many_words + many_words);
  window.frames(3);
  const Box high = window.control("message.dismiss");
  CHECK(high.hi.y == 720);
  CHECK(high.lo.y < brief.lo.y);
  CHECK(high.lo.y > brief.lo.y - 40);
  for (const auto& mark : window.ui.placing.marks())
    if (mark.name != "message") CHECK_FALSE(overlap(mark.box, high));
}

TEST_CASE("messages follow one another, the most severe first, and none is lost") {
  test::NullUi window(
      {.preset = "hanging", .size = {900, 600}, .settings = [](Settings& settings) { settings.ui_scale = 1.5; }});
  pause(window);
  window.session.messages.note("A note that needs a line or two in a window as small as this, and waits for its turn.");
  window.session.messages.error("An error that needs a line or two in a window as small as this, and is seen first.");
  window.frames(3);
  CHECK(window.drew("An error that needs"));
  CHECK_FALSE(window.drew("A note that needs"));
  window.until([&] { return window.session.messages.list().size() == 1; }, "the error to have been read");
  window.frames(3);
  CHECK(window.drew("A note that needs"));
  window.until([&] { return window.session.messages.list().empty(); }, "the note to have been read");

  window.session.messages.note("One.");
  window.session.messages.note("Two.");
  window.frames(3);
  CHECK(window.drew("Two."));
  CHECK(window.drew("+1"));  // how many wait
  CHECK_FALSE(window.drew("One."));
}

TEST_CASE("labels and scales of arrows make room for a tooltip, however low the window") {
  test::NullUi window(options({{900, 600}, 1.5, "dark"}, "hanging"));
  pause(window);
  for (int height = 420; height <= 660; height += 20) {
    CAPTURE(height);
    window.resize({900, height});
    window.rest();
    window.move(window.middle("constants.dt.slider"));
    window.until([&] { return window.tooltip().has_value(); }, "the tooltip to come");
    window.frames(8);
    // What is measured beside the frames lengthens it; marks know where it stood in the frame before.
    std::optional<Box> before;
    window.until(
        [&] {
          const std::optional<Box> last = std::exchange(before, window.tooltip());
          return last && before && last->lo == before->lo && last->hi == before->hi;
        },
        "the tooltip to stand still");
    for (const auto& mark : window.ui.placing.marks()) {
      CAPTURE(mark.name);
      if (mark.name.starts_with("label ") || mark.name.starts_with("scale "))
        CHECK_FALSE(overlap(*window.tooltip(), mark.box));
    }
  }
}

TEST_CASE("a message and PAUSED stand apart") {
  for (const LookCase& look : std::span(looks).first(5)) {
    CAPTURE(look.size.x);
    CAPTURE(look.scale);
    CAPTURE(std::string(look.theme));
    test::NullUi window(options(look, "hanging"));
    window.pause();
    window.type_value("k_s", "abc");
    REQUIRE_FALSE(window.session.messages.list().empty());
    CHECK_FALSE(overlap(window.control("message.dismiss"), *window.ui.placing.find("paused")));
  }
}

TEST_CASE("all choices of a lab's question are seen, and nothing over the low picture covers anything") {
  for (const int n : {0, 1, 5, 6}) {
    const LookCase& look = looks[n];
    CAPTURE(look.size.x);
    CAPTURE(look.scale);
    CAPTURE(std::string(look.theme));
    test::UiOptions with = options(look, "hanging");
    with.settings = [look](Settings& settings) {
      settings.ui_scale = look.scale, settings.theme = look.theme, settings.labs = {{"01_hooke", 2}};
    };
    test::NullUi window(with);
    window.key(GLFW_KEY_L, GLFW_MOD_CONTROL);
    window.until([&] { return window.ui.palette.open && window.typing(); }, "the list of labs");
    window.type("hooke");
    window.key(GLFW_KEY_ENTER);
    window.until([&] { return window.session.labs.run.has_value(); }, "the lab");
    window.frames(3);
    CHECK(window.session.labs.run->step == 2);
    CHECK(window.session.document.label == "hanging");
    CHECK(window.t() == 0);
    window.rest();
    window.frames(8);
    judge(window, look, {"paused"});
    if (look.scale != 1 || std::string(look.theme) != "dark") continue;
    for (const char* choice : {"lab.choice.1", "lab.choice.2", "lab.choice.3"}) {
      const Box box = window.control(choice);
      CHECK(box.hi.y - box.lo.y > 20);
    }
    CHECK(window.sees("lab.Predict"));
  }
}

}  // namespace tyglab::marks_test
