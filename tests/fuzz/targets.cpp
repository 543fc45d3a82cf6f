#include "tests/fuzz/targets.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "app/base/experiment_file.h"
#include "app/base/image.h"
#include "app/base/settings.h"
#include "app/cli/commands/commands.h"
#include "app/session/lab.h"
#include "core/engines/engine.h"
#include "core/io/preset_io.h"
#include "core/model/notation.h"
#include "core/output/series_csv.h"
#include "core/output/state_csv.h"
#include "core/playback.h"
#include "core/simulation.h"
#include "tests/fuzz/csv_reader.h"
#include "tests/support/pictures.h"
#include "tests/support/places.h"

namespace tyglab::fuzz {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void broken(const std::string& why) {
  std::fprintf(stderr, "\nDoes not hold: %s\n", why.c_str());
  std::abort();
}

void require(bool holds, const std::string& what) {
  if (!holds) broken(what);
}

/// Every refusal is an exception of this kind, and says why.
template <class Refusal, class Read>
void read_or_refuse(const Read& read) {
  try {
    read();
  } catch (const Refusal& refusal) {
    require(std::string(refusal.what()).size() >= 8, "a refusal says why");
  }
}

void require_good(const Preset& preset) {
  const std::string problem = check_preset(preset);
  require(problem.empty(), "what is accepted passes the check: " + problem);
  require(parse_preset(preset_to_json(preset), "again") == preset, "what is written is read as it was");
}

void read_preset_text(std::string_view input) {
  read_or_refuse<PresetError>([&] { require_good(parse_preset(input, "fuzz.json")); });
}

std::vector<std::string> lines(std::string_view text) {
  std::vector<std::string> all;
  std::istringstream in{std::string(text)};
  for (std::string line; std::getline(in, line);) all.push_back(line);
  return all;
}

/// A setting a line.
void read_settings(std::string_view input) {
  read_or_refuse<PresetError>([&] { require_good(with_settings(Preset{}, lines(input.substr(0, 4096)))); });
}

void read_lab(std::string_view input) {
  read_or_refuse<std::runtime_error>([&] { parse_lab(input, "fuzz.md"); });
}

void read_picture(std::string_view input) {
  read_or_refuse<std::runtime_error>([&] {
    const std::span bytes(reinterpret_cast<const unsigned char*>(input.data()), input.size());
    const Image image = decode_image(bytes, "the picture");
    require(image.width >= 1 && image.height >= 1 && image.width <= 4096 && image.height <= 4096,
            "a picture has an allowed size");
    require(image.rgb.size() == std::size_t(3) * image.width * image.height, "a picture has all its pixels");
  });
}

/// The file of the last session, in a folder of its own.
void read_settings_file(std::string_view input) {
  const fs::path folder = fs::temp_directory_path() / ("tyglab-fuzz-" + std::to_string(::getpid()));
  fs::remove_all(folder);
  fs::create_directory(folder);
  ::setenv("TYGLAB_CONFIG_DIR", folder.c_str(), 1);
  std::ofstream(folder / "settings.json", std::ios::binary).write(input.data(), std::streamsize(input.size()));
  std::string problem;
  const Settings settings = load_settings(problem);
  require(problem.empty() || problem.size() >= 8, "a refusal says why");
  require(!settings.session || check_preset(settings.session->preset).empty(), "a session's preset is good");
}

/// Whether it is repeated in an instant, wherever it leads.
bool is_small(const Experiment& experiment) {
  const Preset& largest = experiment.largest;
  return largest.rows * largest.columns <= 64 && experiment.recording.steps() <= 50 &&
         experiment.recording.events().size() <= 200;
}

/// An experiment is repeated to its end, to a divergence, to an event that does not fit the cloth, or for a second.
void repeat(const Experiment& experiment) {
  for (const Recording::Entry& entry : experiment.recording.events())
    if (const auto* change = std::get_if<event::Change>(entry.event))
      for (const std::string& setting : change->settings)
        if (setting.find("opencl") != std::string::npos) return;  // a driver takes seconds to compile
  if (experiment.recording.start().engine == EngineKind::opencl) return;
  using Clock = std::chrono::steady_clock;
  const auto until = Clock::now() + std::chrono::seconds(1);
  bool late = false;
  const auto in_time = [&](Simulation& simulation) {
    simulation.stop_when([&] { return late = late || Clock::now() > until; });
  };
  const auto repeats = [&] {
    Playback playback(experiment.recording);
    Simulation simulation(experiment.recording.start());
    in_time(simulation), simulation.keep_hashes(true);
    playback.advance(simulation, experiment.recording.steps());
    require(late || simulation.divergence() || playback.over(simulation), "a repetition comes to its end");
    require_good(simulation.preset());
    const std::string again = experiment_text(experiment_of(simulation));
    const Experiment own = parse_experiment(again, "again");
    require(experiment_text(own) == again, "what was repeated can be saved");
    Playback second(own.recording);
    Simulation other(own.recording.start());
    in_time(other);
    second.advance(other, own.recording.steps());
    require(late || (second.over(other) && !second.comparison().differs_at && other.hash() == simulation.hash()),
            "and repeated to the last bit");
  };
  try {
    read_or_refuse<PresetError>(repeats);
  } catch (const EngineError& error) {
    require(std::string(error.what()).size() >= 8, "a refusal says why");
  }
}

/// A file of an experiment: packed, or its text.
void read_experiment(std::string_view input) {
  std::optional<Experiment> read;
  read_or_refuse<PresetError>([&] { read = experiment_from(input, "fuzz.tyglab"); });
  if (!read) return;
  const Recording& recording = read->recording;
  require_good(recording.start());
  const std::string text = experiment_text(*read);
  const Experiment other = parse_experiment(text, "again");
  require(experiment_text(other) == text, "what is written is read as it was");
  require(other.seconds == read->seconds && other.largest == read->largest, "so is what follows from it");
  require(experiment_text(experiment_from(experiment_bytes(*read), "again")) == text, "so is what is packed");
  std::int64_t step = 0;
  for (const Recording::Entry& entry : recording.events())
    require(entry.step >= std::exchange(step, entry.step), "events follow each other");
  require(step <= recording.steps(), "and none is later than the end");
  if (is_small(*read)) repeat(*read);
}

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// What is printed meanwhile goes nowhere.
class Hushed {
 public:
  Hushed() : out_(std::cout.rdbuf(&nowhere_)), err_(std::cerr.rdbuf(&nowhere_)) {}
  ~Hushed() { std::cout.rdbuf(out_), std::cerr.rdbuf(err_); }
  Hushed(const Hushed&) = delete;
  Hushed& operator=(const Hushed&) = delete;
  std::string text() const { return nowhere_.str(); }

 private:
  std::stringbuf nowhere_;
  std::streambuf *out_, *err_;
};

/// A word a line. It is understood, or refused with a sentence and the exit code of command lines.
void read_command_line(std::string_view input) {
  std::vector<std::string> words;
  for (const std::string& line : lines(input.substr(0, 4096)))
    if (words.size() < 63) words.push_back(line.substr(0, line.find('\0')));
  const Hushed hushed;
  Action action;
  CLI::App program("", "tyglab");
  declare_program(program, action);
  try {
    program.parse(std::vector<std::string>(words.rbegin(), words.rend()));
  } catch (const CLI::ParseError& error) {
    const int code = exit_of_parsing(program, error, words);
    require(code == exit_command_line || code == exit_done, "what is not understood ends with exit code 2");
    require(hushed.text().size() >= 8, "it says why");
    return;
  }
  require(action != nullptr, "a command line that is understood asks for something");
}

/// Numbers as their bytes, whatever they are.
class Numbers {
 public:
  explicit Numbers(std::string_view bytes) : bytes_(bytes) {}
  bool empty() const { return bytes_.empty(); }
  double next() {
    double value = 0;
    const std::size_t size = std::min(bytes_.size(), sizeof value);
    std::memcpy(&value, bytes_.data(), size);
    bytes_.remove_prefix(size);
    return value;
  }

 private:
  std::string_view bytes_;
};

void require_good_table(const std::string& text, std::size_t rows) {
  std::string problem;
  const CsvTable table = read_csv(text, problem);
  require(problem.empty(), "a table can be read: " + problem);
  require(table.rows.size() == rows, "a table has all its rows");
}

/// Every table that the program writes, of states that hold any numbers: each has all its cells, and a number that is
/// finite comes back as it was; one that is not leaves its cell empty, and is in no state (StepGuard).
void write_tables(std::string_view input) {
  Numbers numbers(input);
  const Lattice lattice{2, 3};
  State state;
  state.x.resize(6), state.v.resize(6);
  for (VectorField<double>* field : {&state.x, &state.v})
    for (auto* part : {&field->x, &field->y, &field->z})
      for (double& value : *part) value = numbers.next(), value = std::isfinite(value) ? value : 0;
  const std::string text = state_csv(Tears(lattice), state, {0.5, 3, "0123456789abcdef"});
  require_good_table(text, 6);
  std::string problem;
  const CsvTable table = read_csv(text, problem);
  for (std::size_t p = 0; p < 6; ++p)
    require(table.rows[p][2] == state.x.x[p] && table.rows[p][7] == state.v.z[p], "a state comes back as it was");

  const fs::path file = fs::temp_directory_path() / ("tyglab-fuzz-" + std::to_string(::getpid()) + ".csv");
  for (const auto& columns : {series_columns(Kind::cloth), ledger_columns()}) {
    SeriesCsv series(file, columns, "0123456789abcdef");
    std::size_t rows = 0;
    for (; rows < 3; ++rows) {
      std::vector<double> values(columns.size());
      for (double& value : values) value = numbers.next();
      series.add(double(rows), values);
    }
    series.end();
    require_good_table(content(file), rows);
  }
  fs::remove(file);
}

std::vector<std::string> files_of(const char* folder, const char* extension) {
  std::vector<std::string> all;
  for (const auto& entry : fs::directory_iterator(fs::path(test::source_dir) / folder))
    if (entry.path().extension() == extension) all.push_back(content(entry.path()));
  return all;
}

std::vector<std::string> preset_seeds() {
  return files_of("app/presets", ".json");
}

std::vector<std::string> setting_seeds() {
  std::vector<std::string> all{"W=[0,0,0.02]", "bodies[0].shape=sphere\nbodies[0].r=0.3", "pins=[[0,0],[3,3]]"};
  for (const PresetRow& row : notation()) all.push_back(std::string(row.key) + "=1");
  return all;
}

std::vector<std::string> lab_seeds() {
  return files_of("docs/labs", ".md");
}

/// Of every kind of event, packed and as text.
std::vector<std::string> experiment_seeds() {
  std::vector<std::string> all;
  const auto add = [&](const Simulation& simulation) {
    const Experiment experiment = experiment_of(simulation);
    all.push_back(experiment_bytes(experiment)), all.push_back(experiment_text(experiment));
  };
  for (const char* tearing : {"springs", "split"}) {
    Preset preset;
    preset.rows = 6, preset.columns = 5, preset.tearing = tearing, preset.bodies = {Body{.c = {0, 0.6, 0}, .r = 0.1}};
    Simulation cloth(preset);
    add(cloth);
    cloth.mark(std::string(2 * longest_mark, 'x')), cloth.advance(3);
    cloth.apply(edit::Grab{5, 2}), cloth.apply(edit::MoveHand{{0.1, 0.7, -0.0}, 4}), cloth.advance(5);
    const Snapshot then = cloth.snapshot();
    cloth.apply(edit::Release{}), cloth.apply(edit::Cut{{{3, 1}, {3, 2}, {3, 3}}}), cloth.advance(2);
    cloth.apply(edit::CutSprings{{{0, 1, 1}, {1, 1, 1}}}), cloth.apply(edit::Pin{5, 0, true}), cloth.advance(2);
    cloth.apply(edit::MoveBody{0, {0, 0.7, 0}, 3}), cloth.advance(4);
    preset = cloth.preset(), preset.k_s = 80, preset.precision = Precision::double_, preset.integrator = "rk4";
    cloth.apply(edit::Change{preset}), cloth.advance(3);
    add(cloth);
    if (cloth.fits(then)) cloth.restore(then), cloth.advance(2);
    cloth.load(cloth.read()), cloth.advance(3);
    add(cloth);
    cloth.apply(edit::Restart{}), cloth.advance(2);
    preset = cloth.preset(), preset.rows = 7, preset.W = {0, 0, 1e-4}, preset.gust = 0.5;
    cloth.apply(edit::Change{preset}), cloth.advance(10);
    preset.k_s = 1e6, cloth.apply(edit::Change{preset}), cloth.advance(20);
    require(cloth.divergence().has_value(), "the seed diverges");
    add(cloth);
  }
  for (const std::string& seed : all) experiment_from(seed, "a seed");
  return all;
}

std::vector<std::string> picture_seeds() {
  std::vector<std::string> all = test::pictures_of_all_kinds(12);
  for (std::string& picture : files_of("tests/fuzz/pictures", ".jpg")) all.push_back(std::move(picture));
  return all;
}

std::vector<std::string> settings_file_seeds() {
  const std::string preset = preset_to_json(Preset{});
  return {R"({"tyglab_settings": 1, "theme": "light", "window": {"x": 1, "y": 2, "width": 800, "height": 600}})",
          R"({"tyglab_settings": 1, "session": {"label": "a", "file": "", "preset": )" + preset + R"(, "saved": )" +
              preset + "}}"};
}

/// Every command with each of its options.
void add_command_lines(const CLI::App& command, const std::string& before, std::vector<std::string>& all) {
  for (const CLI::Option* option : command.get_options())
    for (const char* value : {"1", "denim", "auto", "k_s=5", "640x480"})
      all.push_back(before + (option->get_positional() ? "" : option->get_name() + "\n") + value);
  for (const CLI::App* next : command.get_subcommands([](const CLI::App*) { return true; }))
    add_command_lines(*next, before + next->get_name() + "\n", all);
}

std::vector<std::string> command_line_seeds() {
  Action action;
  CLI::App program("", "tyglab");
  declare_program(program, action);
  std::vector<std::string> all{"", "run\ndenim\n--seconds\n2\n--state\ndenim.csv", "rum\n--help", "--size=1x1\nrun"};
  add_command_lines(program, "", all);
  return all;
}

std::vector<std::string> table_seeds() {
  std::vector<std::string> all;
  for (const double value : {0.0, -0.0, 1.0 / 3, 5e-324, -1.7976931348623157e308, double(INFINITY), double(NAN)}) {
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    std::string& seed = all.emplace_back();
    for (int n = 0; n < 120; ++n) seed += bytes;
  }
  return all;
}

constexpr Target all_targets[]{{"presets", read_preset_text, preset_seeds},
                               {"settings", read_settings, setting_seeds},
                               {"labs", read_lab, lab_seeds},
                               {"experiments", read_experiment, experiment_seeds},
                               {"pictures", read_picture, picture_seeds},
                               {"sessions", read_settings_file, settings_file_seeds},
                               {"command_lines", read_command_line, command_line_seeds},
                               {"tables", write_tables, table_seeds}};

}  // namespace

std::span<const Target> targets() {
  return all_targets;
}

}  // namespace tyglab::fuzz
