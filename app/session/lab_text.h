// Words, numbers and paragraphs of a lab's text.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/session/lab.h"

namespace tyglab {

/// Without the spaces before and behind it.
std::string_view trimmed(std::string_view text);

/// As the card sets it: in one piece, whatever its lines are in the file, without Markdown's `code` and **strong**.
std::string card_text(std::string_view text);

std::vector<std::string> words_in(std::string_view text);

/// None where it is no number, or none that is finite ("nan").
std::optional<double> plain_number(std::string_view text);

/// Lines are gathered into paragraphs: an empty line or a "- " begins a new one.
class Gathered {
 public:
  void add(std::string_view line);
  /// What has been gathered, as the card sets it; begins again.
  Paragraphs take();

 private:
  Paragraphs paragraphs_;
  bool open_ = false;
};

}  // namespace tyglab
