// The notation table, and what is generated from it.
#include <doctest/doctest.h>

#include <cstdlib>
#include <set>

#include "core/integrators/scheme.h"
#include "core/integrators/stabilized.h"
#include "core/io/output_file.h"
#include "core/model/notation.h"
#include "tests/support/files.h"
#include "tests/support/places.h"

namespace tyglab::notation_test {

template <class T>
void check_row(const Row<T>& row, std::set<std::string_view>& keys) {
  CAPTURE(std::string(row.key));
  CHECK(keys.insert(row.key).second);
  CHECK_FALSE(row.quantity.empty());
  CHECK_FALSE(row.storhet.empty());
  CHECK(row.help.size() > 10);
  if (std::holds_alternative<std::string T::*>(row.field)) return;
  CHECK(row.min < row.max);
  if (row.zero_is_off) CHECK(row.min == 0);
  const T defaults;
  const auto in_range = [&](double value) { CHECK((value >= row.min && value <= row.max)); };
  if (const auto* field = std::get_if<double T::*>(&row.field))
    if (!is_absent(row, defaults.**field)) in_range(defaults.**field);
  if (const auto* field = std::get_if<int T::*>(&row.field)) in_range(defaults.**field);
  if (const auto* field = std::get_if<glm::dvec3 T::*>(&row.field)) {
    for (int c = 0; c < 3; ++c) in_range((defaults.**field)[c]);
  }
}

TEST_CASE("every row has symbol, quantity, Swedish, help, and a range that holds its default") {
  std::set<std::string_view> keys;
  for (const PresetRow& row : notation()) {
    check_row(row, keys);
    CHECK_FALSE(row.section.empty());
    CHECK(find_row(row.key) == &row);
  }
  keys.clear();
  for (const BodyRow& row : body_notation()) {
    check_row(row, keys);
    CHECK(find_body_row(row.key) == &row);
  }
  CHECK(find_row("no such key") == nullptr);
  CHECK(find_body_row("") == nullptr);
}

TEST_CASE("every dimension has its SI unit") {
  for (const auto& [key, unit] : {std::pair{"L", "m"},
                                  {"m", "kg"},
                                  {"k_s", "N/m"},
                                  {"k_b", "N/m"},
                                  {"k", "N/m"},
                                  {"g", "m/s²"},
                                  {"W", "N"},
                                  {"dt", "s"},
                                  {"x_0", "m"},
                                  {"v_0", "m/s"},
                                  {"F_max", "N"},
                                  {"F_release", "N"},
                                  {"tolerance", "m"},
                                  {"offset", "m"},
                                  {"rows", ""}}) {
    CAPTURE(std::string(key));
    CHECK(std::string(find_row(key)->unit) == unit);
  }
  CHECK(std::string(find_body_row("r")->unit) == "m");
}

TEST_CASE("every variable of table B.1 can be read out") {
  std::set<std::string> keys;
  for (const Variable& variable : variables()) {
    CAPTURE(std::string(variable.key));
    keys.insert(std::string(variable.key));
    CHECK_FALSE(variable.symbol.empty());
    CHECK_FALSE(variable.quantity.empty());
    CHECK_FALSE(variable.storhet.empty());
    CHECK_FALSE(variable.unit.empty());
  }
  for (const char* key : {"F", "F_s", "F_b", "F_d", "F_g", "F_int", "F_ext", "x", "v", "a"})
    CHECK(keys.count(key) == 1);
}

TEST_CASE("docs/notation.md is current") {
  // After a change of the table: TYGLAB_WRITE_DOCS=1 presets_tests writes the page anew.
  if (std::getenv("TYGLAB_WRITE_DOCS") != nullptr) {
    write_atomically(std::string(test::source_dir) + "/docs/notation.md", notation_markdown());
  }
  CHECK(test::read_file(std::string(test::source_dir) + "/docs/notation.md") == notation_markdown());
}

TEST_CASE("docs/integrators.md is current, and says of each method what it must") {
  if (std::getenv("TYGLAB_WRITE_DOCS") != nullptr)
    write_atomically(std::string(test::source_dir) + "/docs/integrators.md", integrators_markdown());
  CHECK(test::read_file(std::string(test::source_dir) + "/docs/integrators.md") == integrators_markdown());
  for (const Scheme& scheme : schemes()) {
    CAPTURE(std::string(scheme.name));
    for (const std::string_view text :
         {scheme.title, scheme.source, scheme.note, scheme.stability, scheme.cost, scheme.formula})
      CHECK_FALSE(text.empty());
    CHECK(scheme.note.ends_with('.'));
    CHECK_FALSE(scheme.stability.ends_with('.'));
  }
}

TEST_CASE("the nearest known word is found, and nothing far-fetched") {
  const std::string_view known[] = {"rows", "columns", "k_s", "integrator"};
  CHECK(nearest("colums", known) == "columns");
  CHECK(nearest("row", known) == "rows");
  CHECK(nearest("intergrator", known) == "integrator");
  CHECK_FALSE(nearest("temperature", known).has_value());
  CHECK_FALSE(nearest("", known).has_value());
  CHECK_FALSE(nearest("anything", {}).has_value());
}

TEST_CASE("a slider spans about three decades round its value, within the allowed range, from 0 where 0 is allowed") {
  for (const PresetRow& row : notation()) {
    CAPTURE(std::string(row.key));
    const auto* field = std::get_if<double Preset::*>(&row.field);
    if (field == nullptr) continue;
    for (const double value : {is_absent(row, Preset{}) ? usual_value(row) : Preset{}.**field, row.min, row.max}) {
      const SliderRange range = slider_range(row, value);
      CHECK(range.min >= row.min);
      CHECK(range.max <= row.max);
      CHECK(range.min < range.max);
      CHECK(range.min <= value);
      CHECK(value <= range.max);
      if (row.min == 0) CHECK(range.min == 0);
    }
  }
  const SliderRange k_s = slider_range(*find_row("k_s"), 50);
  CHECK(k_s.max >= 500);
  CHECK(k_s.max <= 50e3);
}

}  // namespace tyglab::notation_test
