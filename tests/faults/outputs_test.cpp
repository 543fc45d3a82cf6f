// Memory, disks and system calls that fail while files are written and read: the older file stands, nothing half-made
// lies beside it but what is documented (docs/presets.md), and what is said names the file.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>

#include "app/base/image.h"
#include "app/base/settings.h"
#include "app/shell/sandbox.h"
#include "core/io/output_file.h"
#include "core/io/preset_io.h"
#include "core/output/obj.h"
#include "core/output/series_csv.h"
#include "core/output/state_csv.h"
#include "tests/support/faults.h"
#include "tests/support/files.h"
#include "tests/support/pictures.h"
#include "tests/support/scenes.h"

namespace tyglab::outputs_faults_test {
namespace {

namespace fs = std::filesystem;
using test::Fault;

/// A file that is to be replaced.
class Writing final : public test::Scene {
 public:
  using Act = std::function<void(const fs::path&)>;
  explicit Writing(Act act) : act_(std::move(act)) { test::write_file(file(), "older"); }
  void act() override { act_(file()); }
  std::string state() override {
    std::string text;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_.path()))
      if (entry.path() != incomplete()) text += entry.path().filename().string() + ": " + test::read_file(entry) + '\n';
    return text;
  }
  std::string problem(const test::Attempt& attempt, const std::string& before) override {
    if (std::string wrong = Scene::problem(attempt, before); !wrong.empty()) return wrong;
    const bool named = attempt.sentence.find(file().string()) != std::string::npos;
    if (!attempt.out_of_memory && !named) return "the file is not named: " + attempt.sentence;
    // Only what grows row by row is of use when it is cut short, and then it is said where it is.
    const bool kept = fs::exists(incomplete());
    if (kept && !grows_) return "F.incomplete is left";
    if (kept) fs::remove(incomplete());
    return {};
  }
  Writing& grows() {
    grows_ = true;
    return *this;
  }

 private:
  fs::path file() const { return folder_ / "out.csv"; }
  fs::path incomplete() const { return folder_ / "out.csv.incomplete"; }
  test::TemporaryFolder folder_;
  Act act_;
  bool grows_ = false;
};

void write_of(const char* name, const Writing::Act& act, bool grows = false) {
  for (const Fault kind : {Fault::allocation, Fault::write, Fault::file})
    test::inject({.operation = name, .kind = kind, .dense = 40, .may_pass = kind == Fault::file}, [&] {
      auto scene = std::make_unique<Writing>(act);
      if (grows) scene->grows();
      return scene;
    });
}

/// Something that is read, or not.
class Reading final : public test::Scene {
 public:
  explicit Reading(std::function<void()> act) : act_(std::move(act)) {}
  void act() override { act_(), ++done_; }
  std::string state() override { return std::to_string(done_); }

 private:
  std::function<void()> act_;
  int done_ = 0;
};

void read_of(const char* name, const std::function<void()>& act, bool files = true) {
  for (const Fault kind : {Fault::allocation, Fault::file})
    if (files || kind == Fault::allocation)
      test::inject({.operation = name, .kind = kind, .dense = 60}, [&] { return std::make_unique<Reading>(act); });
}

Preset some_preset() {
  return test::cloth(6, 6);
}

}  // namespace

TEST_CASE("files that are written" * doctest::test_suite("slow")) {
  Simulation cloth(some_preset());
  cloth.advance(3);
  const State state = cloth.read();
  write_of("save preset", [](const fs::path& file) { save_preset(some_preset(), file); });
  write_of("export OBJ", [&](const fs::path& file) { write_obj(file, cloth.tears(), state.x, {.name = "cloth"}); });
  write_of("export state CSV", [&](const fs::path& file) { write_atomically(file, state_csv(cloth)); });
  write_of("export values CSV", [&](const fs::path& file) { write_atomically(file, values_csv(cloth, nullptr)); });
  Image picture{24, 16, {}};
  for (int n = 0; n < 24 * 16 * 3; ++n) picture.rgb.push_back(std::uint8_t(n * 37));
  write_of("save picture as PNG", [&](const fs::path& file) { write_png(file, picture); });
  write_of(
      "export PC2",
      [&](const fs::path& file) {
        PointCache cache(file, 36);
        for (int n = 0; n < 3; ++n) cache.add(state.x);
        cache.end();
      },
      true);
  write_of(
      "export series",
      [&](const fs::path& file) {
        SeriesCsv series(file, series_columns(Kind::cloth), preset_hash(cloth.preset()));
        for (int n = 0; n < 3; ++n) series.add(n, series_values(cloth));
        series.end();
      },
      true);
  cloth.enable_ledger(true);
  write_of(
      "export ledger",
      [&](const fs::path& file) {
        SeriesCsv series(file, ledger_columns(), preset_hash(cloth.preset()));
        for (int n = 0; n < 3; ++n) series.add(n, ledger_values(*cloth.ledger()));
        series.end();
      },
      true);
}

TEST_CASE("files that are read") {
  const test::TemporaryFolder folder;
  const fs::path preset = folder / "preset.json";
  save_preset(some_preset(), preset);
  read_of("read preset", [&] { load_preset(preset); });
  const Preset own = some_preset();
  read_of(
      "settings of a preset",
      [&] {
        with_settings(own, {"k_s=70", "W=[0,0,0.01]"});
      },
      false);
  Image picture{24, 16, std::vector<std::uint8_t>(24 * 16 * 3, 90)};
  write_png(folder / "picture.png", picture);
  // Files of pictures are read by the standard library, whose calls are not in our hands.
  read_of(
      "read PNG", [&] { read_image(folder / "picture.png"); }, false);
}

TEST_CASE("settings that are written beside the frames: what fails is said, and the older ones stand") {
  class Keeping final : public test::Scene {
   public:
    Keeping() {
      ::setenv("TYGLAB_CONFIG_DIR", folder_.path().c_str(), 1);
      save_settings(Settings(), Settings());
      later_.width = 1000, later_.theme = "light";
    }
    ~Keeping() override { ::unsetenv("TYGLAB_CONFIG_DIR"); }
    Keeping(const Keeping&) = delete;
    Keeping& operator=(const Keeping&) = delete;
    void act() override { SettingsWriter(Settings()).finish(later_); }
    std::string state() override {
      std::string text;
      for (const fs::directory_entry& entry : fs::directory_iterator(folder_.path()))
        text += entry.path().filename().string() + ": " + test::read_file(entry) + '\n';
      return text;
    }

   private:
    test::TemporaryFolder folder_;
    Settings later_;
  };
  test::inject({.operation = "write settings", .kind = Fault::write, .dense = 60},
               [] { return std::make_unique<Keeping>(); });
}

}  // namespace tyglab::outputs_faults_test
