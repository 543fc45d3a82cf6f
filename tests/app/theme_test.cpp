// Every theme can be read: contrasts as the WCAG 2.1 defines them.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "app/ui/kit/theme.h"

namespace tyglab::theme_test {

double luminance(ImU32 color) {
  const auto linear = [](ImU32 byte) {
    const double c = double(byte & 255) / 255;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(color) + 0.7152 * linear(color >> 8) + 0.0722 * linear(color >> 16);
}

double contrast(ImU32 a, ImU32 b) {
  const double one = luminance(a), other = luminance(b);
  return (std::max(one, other) + 0.05) / (std::min(one, other) + 0.05);
}

TEST_CASE("text of every theme has 4.5 to 1 at least on all grounds, curves and signs 3 to 1") {
  for (const Look& look : looks()) {
    CAPTURE(std::string(look.name));
    const Tokens c = look.tokens();
    for (const ImU32 ground : {c.ground, c.panel, c.field}) {
      CHECK(contrast(c.text, ground) > 7);
      CHECK(contrast(c.quiet, ground) > 4.5);
    }
    CHECK(contrast(c.on_accent, c.accent) > 4.5);
    const std::array signs{c.accent,  c.danger, c.warning,   c.good,   c.blue, c.green,
                           c.magenta, c.yellow, c.vermilion, c.orange, c.sky};
    for (std::size_t n = 0; n < signs.size(); ++n) {
      CAPTURE(n);
      CHECK(contrast(signs[n], c.ground) > 3);
      CHECK(contrast(signs[n], c.panel) > 3);
    }
  }
}

TEST_CASE("an unknown theme is the first one") {
  CHECK(look("projector").magnified > 1.2f);
  CHECK(look("sepia").name == "dark");
}

}  // namespace tyglab::theme_test
