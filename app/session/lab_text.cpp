#include "app/session/lab.h"

#include <cmath>
#include <sstream>
#include <utility>

#include "app/base/text.h"
#include "core/model/notation.h"

namespace tyglab {
namespace {

/// Without the signs of Markdown that the card does not set: `code` and **strong**.
std::string without_marks(std::string_view text) {
  std::string plain;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] == '`') continue;
    if (text.substr(k, 2) == "**") {
      ++k;
      continue;
    }
    plain += text[k];
  }
  return plain;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t\r"), end = text.find_last_not_of(" \t\r");
  return begin == std::string_view::npos ? std::string_view() : text.substr(begin, end - begin + 1);
}

std::string card_text(std::string_view text) {
  return with_whole_terms(without_marks(text));
}

std::vector<std::string> words_in(std::string_view text) {
  std::istringstream in{std::string(text)};
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

std::optional<double> plain_number(std::string_view text) {
  double value = 0;
  const auto [stop, error] = read_number(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || stop != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

void Gathered::add(std::string_view line) {
  if (line.empty()) {
    open_ = false;
    return;
  }
  const bool item = line.starts_with("- ");
  std::string text = without_marks(item ? line.substr(2) : line);
  if (item || !open_) {
    paragraphs_.push_back(item ? "• " + text : std::move(text));
  } else {
    paragraphs_.back() += " " + text;
  }
  open_ = true;
}

Paragraphs Gathered::take() {
  open_ = false;
  for (std::string& paragraph : paragraphs_) paragraph = with_whole_terms(std::move(paragraph));
  return std::exchange(paragraphs_, {});
}

}  // namespace tyglab
