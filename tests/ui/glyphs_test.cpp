// Every character of every shipped text has a glyph in the fonts: what has none is drawn as a question mark.
#include <doctest/doctest.h>

#include <cstdio>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>

#include "app/base/files.h"
#include "app/session/lab_state.h"
#include "app/ui/frame/commands.h"
#include "core/fields/particle_field.h"
#include "core/integrators/scheme.h"
#include "core/io/preset_io.h"
#include "core/model/notation.h"
#include "tests/support/places.h"
#include "tests/ui/null_ui.h"

namespace tyglab::glyphs_test {

/// Fails the test for each character of the text that the font has no glyph for, once.
class GlyphCheck {
 public:
  explicit GlyphCheck(const ImFont& font) : font_(font) {}

  void operator()(std::string_view text, std::string_view where) {
    for (std::size_t at = 0; at < text.size();) {
      const unsigned code = next(text, at);
      ++seen_;
      if (code < 0x20 || font_.FindGlyphNoFallback(ImWchar(code)) != nullptr || !missing_.insert(code).second) continue;
      char hex[16];
      std::snprintf(hex, sizeof hex, "U+%04X", code);
      FAIL_CHECK(std::string(hex) << " has no glyph: " << std::string(where) << ": " << std::string(text));
    }
  }
  int seen() const { return seen_; }

 private:
  static unsigned next(std::string_view text, std::size_t& at) {
    const auto byte = [&](std::size_t k) {
      return k < text.size() ? unsigned(static_cast<unsigned char>(text[k])) : 0;
    };
    const unsigned first = byte(at);
    const int more = first < 0x80 ? 0 : first < 0xE0 ? 1 : first < 0xF0 ? 2 : 3;
    unsigned code = more == 0 ? first : first & (0x3Fu >> more);
    for (int k = 1; k <= more; ++k) code = code << 6 | (byte(at + std::size_t(k)) & 0x3F);
    at += std::size_t(more) + 1;
    return code;
  }

  const ImFont& font_;
  std::set<unsigned> missing_;
  int seen_ = 0;
};

void check(GlyphCheck& glyphs, const Paragraphs& text, const std::string& where) {
  for (const std::string& paragraph : text) glyphs(paragraph, where);
}

void check_labs(GlyphCheck& glyphs) {
  std::vector<std::string> problems;
  const std::vector<Lab> labs = read_labs(problems);
  CHECK(labs.size() >= 12);
  for (const Lab& lab : labs) {
    glyphs(lab.title, lab.label);
    check(glyphs, lab.summary, lab.label);
    for (const LabStep& step : lab.steps) {
      glyphs(step.title, lab.label);
      check(glyphs, step.text, lab.label);
      check(glyphs, step.todo, lab.label);
      check(glyphs, step.explanation, lab.label);
      for (const Condition& condition : step.checks) glyphs(words_of(condition), lab.label);
      if (!step.prediction) continue;
      glyphs(step.prediction->question, lab.label);
      glyphs(step.prediction->unit, lab.label);
      check(glyphs, step.prediction->choices, lab.label);
    }
  }
}

template <class Rows>
void check_rows(GlyphCheck& glyphs, const Rows& rows) {
  for (const auto& row : rows)
    for (const std::string_view text : {row.quantity, row.storhet, row.unit, row.help}) glyphs(text, row.key);
}

void check_tables(GlyphCheck& glyphs) {
  for (const std::string& name : shipped_presets()) {
    const Preset preset = load_preset(find_preset(name).file);
    glyphs(preset.name, name), glyphs(preset.description, name);
  }
  check_rows(glyphs, notation());
  check_rows(glyphs, body_notation());
  check_rows(glyphs, variables());
  for (const Scheme& scheme : schemes())
    for (const std::string_view text : {scheme.title, scheme.note, scheme.source, scheme.equation})
      glyphs(text, scheme.name);
  for (const FieldInfo& field : particle_fields()) glyphs(field.title, field.name), glyphs(field.unit, field.name);
  for (const CommandTopic& topic : command_topics())
    for (const CommandRow& row : topic.rows) {
      glyphs(row.name, row.id);
      glyphs(row.keys, row.id);
      glyphs(row.help, row.id);
    }
}

/// The strings of a source file; of those with escapes, such as icons, nothing is said.
void check_source(GlyphCheck& glyphs, const std::string& source, const std::string& name) {
  for (std::size_t at = 0; at < source.size(); ++at) {
    if (source.compare(at, 2, "//") == 0) {
      at = std::min(source.find('\n', at), source.size());
    } else if (source[at] == '\'') {
      at = std::min(source.find('\'', at + (source[at + 1] == '\\' ? 3 : 2)), source.size());
    } else if (source[at] == '"') {
      std::size_t end = at + 1;
      while (end < source.size() && source[end] != '"') end += source[end] == '\\' ? 2 : 1;
      const std::string text = source.substr(at + 1, end - at - 1);
      if (text.find("\\x") == std::string::npos) glyphs(text, name);
      at = end;
    }
  }
}

/// Words that the window is made of.
void check_sources(GlyphCheck& glyphs) {
  namespace fs = std::filesystem;
  for (const char* folder : {"app/ui", "app/session", "app/studies", "app/scene", "app/tools", "app/base", "app/shell",
                             "core/model", "core/theory", "core/analysis", "core/engines", "core/fields"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(test::source_dir) / folder)) {
      const fs::path& file = entry.path();
      if (file.filename() == "text_lines.cpp") continue;  // its signs are what a formula may be broken at
      if (file.extension() == ".cpp" || file.extension() == ".h")
        check_source(glyphs, test::read_file(file.string()), file.filename().string());
    }
}

TEST_CASE("every character of every shipped text has a glyph") {
  test::NullUi window;
  for (const ImFont* font : {window.ui.fonts.text, window.ui.fonts.small}) {
    GlyphCheck glyphs(*font);
    check_labs(glyphs);
    check_tables(glyphs);
    check_sources(glyphs);
    CHECK(glyphs.seen() > 50000);
  }
  for (const ImFont* font : {window.ui.fonts.mono, window.ui.fonts.axis}) {
    GlyphCheck numbers(*font);
    numbers("·10⁻⁰¹²³⁴⁵⁶⁷⁸⁹ × µnm", "numbers");
  }
  GlyphCheck title(*window.ui.fonts.title);
  check_labs(title);
}

}  // namespace tyglab::glyphs_test
