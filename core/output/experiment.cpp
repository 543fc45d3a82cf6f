#include "core/output/experiment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "core/io/json_tree.h"
#include "core/io/preset_io.h"
#include "core/io/terminal.h"
#include "core/model/notation.h"
#include "core/model/words.h"
#include "core/simulation.h"
#include "tyglab_version.h"

namespace tyglab {
namespace {

constexpr std::int64_t most_steps = 1'000'000'000'000;
constexpr std::size_t most_values = 4'000'000;
constexpr double farthest = 1e9;  // m, of the hand

// Bytes as text.

constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::string in_base64(std::string_view bytes) {
  std::string text;
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    std::uint32_t group = 0;
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - at);
    for (std::size_t n = 0; n < 3; ++n)
      group = group << 8 | (n < count ? static_cast<unsigned char>(bytes[at + n]) : 0u);
    for (std::size_t n = 0; n <= count; ++n) text += letters[group >> (18 - 6 * n) & 63];
  }
  return text;
}

/// None where a character is none of the letters.
std::optional<std::string> from_base64(std::string_view text) {
  std::string bytes;
  std::uint32_t group = 0;
  int bits = 0;
  for (const char letter : text) {
    const std::size_t value = letters.find(letter);
    if (value == std::string_view::npos) return std::nullopt;
    group = group << 6 | std::uint32_t(value), bits += 6;
    if (bits >= 8) bytes += char(group >> (bits -= 8) & 255);
  }
  return bytes;
}

std::string in_hexadecimal(std::uint64_t value) {
  std::array<char, 17> text{};
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(value));
  return text.data();
}

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

// Writing.

/// The bytes of a state: x of every particle, then y, z, and the velocities likewise; IEEE doubles, little endian.
std::string bytes_of(const State& state) {
  std::string bytes;
  for (const VectorField<double>* field : {&state.x, &state.v})
    for (const Array<double>* component : {&field->x, &field->y, &field->z})
      bytes.append(reinterpret_cast<const char*>(component->data()), component->size() * sizeof(double));
  return bytes;
}

class EventText {
 public:
  explicit EventText(std::int64_t step) : text_("[" + std::to_string(step)) {}
  EventText& add(std::string_view json) {
    text_ += ",";
    text_ += json;
    return *this;
  }
  EventText& word(std::string_view word) { return add(json_text(word)); }
  EventText& words(const std::vector<std::string>& all) {
    for (const std::string& one : all) word(one);
    return *this;
  }
  EventText& number(int value) { return add(std::to_string(value)); }
  EventText& point(const glm::dvec3& at) {
    // JSON's -0 is a whole number, which has no sign.
    for (int c = 0; c < 3; ++c) add(at[c] == 0 && std::signbit(at[c]) ? "-0.0" : shortest_number(at[c]));
    return *this;
  }
  std::string end() const { return text_ + "]"; }

 private:
  std::string text_;
};

std::string text_of(const Recording::Entry& entry) {
  EventText text(entry.step);
  std::visit(
      Overloaded{[&](const event::Change& e) { text.word("set").words(e.settings); },
                 [&](const edit::Restart&) { text.word("restart"); },
                 [&](const edit::Grab& e) { text.word("grab").number(e.i).number(e.j); },
                 [&](const edit::MoveHand& e) { text.word("hand").point(e.to).number(e.steps); },
                 [&](const edit::Release&) { text.word("release"); },
                 [&](const edit::Cut& e) {
                   text.word("cut");
                   for (const Pins::Site& site : e.sites) text.number(site.i).number(site.j);
                 },
                 [&](const edit::CutSprings& e) {
                   text.word("cut springs");
                   for (const SpringSite& one : e.springs) text.number(one.direction).number(one.i).number(one.j);
                 },
                 [&](const edit::Pin& e) { text.word("pin").number(e.i).number(e.j).add(e.pinned ? "true" : "false"); },
                 [&](const edit::MoveBody& e) { text.word("body").number(e.index).point(e.c).number(e.steps); },
                 [&](const event::Resume& e) { text.word("resume").add(e.held ? "true" : "false").words(e.settings); },
                 [&](const event::Load& e) { text.word("state").word(in_base64(bytes_of(*e.state))); },
                 [&](const event::Hash& e) { text.word("hash").word(in_hexadecimal(e.value)); },
                 [&](const event::Look& e) {
                   text.word("look");
                   for (const glm::dvec3& x : e.x) text.point(x);
                 },
                 [&](const event::Diverge&) { text.word("diverged"); },
                 [&](const event::Mark& e) { text.word("mark").word(e.words); }},
      *entry.event);
  return text.end();
}

// Reading.

/// One event of a file: its values one after another.
class EventReader {
 public:
  EventReader(const JsonNode& node, std::string_view source) : node_(node), source_(source) {
    if (node.type != JsonNode::Type::list || node.items.size() < 2) fail("must be a list: a step, a word, and values");
    step_ = std::int64_t(number(0, double(most_steps), true));
    word_ = text();
  }
  std::int64_t step() const { return step_; }

  Event event() {
    Event event = read();
    if (at_ != node_.items.size()) fail("has more values than \"" + excerpt(word_) + "\" takes");
    return event;
  }
  [[noreturn]] void fail(const std::string& why) const {
    throw PresetError(std::string(source_) + ", line " + std::to_string(node_.line) + ": this event " + why);
  }

 private:
  Event read() {
    if (word_ == "set") return event::Change{settings()};
    if (word_ == "restart") return edit::Restart{};
    if (word_ == "grab") return pair<edit::Grab>();
    if (word_ == "hand") {
      const glm::dvec3 to = point();
      return edit::MoveHand{to, whole(1, 1 << 30)};
    }
    if (word_ == "release") return edit::Release{};
    if (word_ == "cut") {
      edit::Cut cut;
      while (at_ < node_.items.size()) cut.sites.push_back(pair<Pins::Site>());
      return cut;
    }
    if (word_ == "cut springs") {
      edit::CutSprings cut;
      while (at_ < node_.items.size()) {
        const int direction = whole(0, stretch_directions - 1);
        const auto [i, j] = pair<Pins::Site>();
        cut.springs.push_back({direction, i, j});
      }
      return cut;
    }
    if (word_ == "pin") {
      const auto [i, j] = pair<Pins::Site>();
      return edit::Pin{i, j, flag()};
    }
    if (word_ == "body") {
      const int index = whole(0, most_site);
      const glm::dvec3 c = point();
      return edit::MoveBody{index, c, whole(0, 1 << 30)};
    }
    if (word_ == "resume") {
      const bool held = flag();
      return event::Resume{settings(), held};
    }
    if (word_ == "state") return event::Load{state()};
    if (word_ == "hash") return event::Hash{hash()};
    if (word_ == "look") {
      event::Look look;
      while (at_ < node_.items.size()) look.x.push_back(point());
      return look;
    }
    if (word_ == "diverged") return event::Diverge{};
    if (word_ == "mark") {
      std::string words = printable(text());
      if (words.size() > longest_mark) fail("has a mark of more than " + std::to_string(longest_mark) + " bytes");
      return event::Mark{std::move(words)};
    }
    fail("is \"" + printable(excerpt(word_)) + "\", which is not known");
  }

  const JsonNode& next() {
    if (at_ == node_.items.size()) fail("ends early: \"" + printable(excerpt(word_)) + "\" takes more values");
    return node_.items[at_++];
  }
  double number(double least, double most, bool is_whole) {
    const JsonNode& value = next();
    if (!value.is_number() || !(value.number >= least && value.number <= most) ||
        (is_whole && value.type != JsonNode::Type::integer))
      fail("has a value that is not allowed; allowed: " + std::string(is_whole ? "a whole number" : "a number") +
           " from " + shortest_number(least) + " to " + shortest_number(most));
    return value.number;
  }
  int whole(int least, int most) { return int(number(least, most, true)); }
  glm::dvec3 point() {
    glm::dvec3 at;
    for (int c = 0; c < 3; ++c) at[c] = number(-farthest, farthest, false);
    return at;
  }
  template <class T>
  T pair() {
    const int i = whole(-1, most_site), j = whole(-1, most_site);
    return {i, j};
  }
  bool flag() {
    const JsonNode& value = next();
    if (value.type != JsonNode::Type::boolean) fail("needs true or false");
    return value.number != 0;
  }
  std::string text() {
    const JsonNode& value = next();
    if (value.type != JsonNode::Type::text) fail("needs a text");
    return value.text;
  }
  std::vector<std::string> settings() {
    std::vector<std::string> all;
    while (at_ < node_.items.size()) all.push_back(text());
    return all;
  }
  std::uint64_t hash() {
    const std::string digits = text();
    if (digits.size() != 16 || digits.find_first_not_of("0123456789abcdef") != std::string::npos)
      fail("needs a hash of 16 hexadecimal digits");
    return std::stoull(digits, nullptr, 16);
  }
  std::shared_ptr<const State> state() {
    const auto bytes = from_base64(text());
    constexpr std::size_t each = 6 * sizeof(double);
    if (!bytes || bytes->empty() || bytes->size() % each != 0) fail("has a damaged state");
    auto state = std::make_shared<State>();
    const std::size_t particles = bytes->size() / each;
    std::size_t from = 0;
    for (VectorField<double>* field : {&state->x, &state->v}) {
      field->resize(particles);
      for (Array<double>* component : {&field->x, &field->y, &field->z}) {
        std::memcpy(component->data(), bytes->data() + from, particles * sizeof(double));
        from += particles * sizeof(double);
        for (const double value : *component)
          if (!(std::abs(value) <= farthest)) fail("has a state with values beyond 1e9");
      }
    }
    return state;
  }

  static constexpr int most_site = 1'000'000;
  const JsonNode& node_;
  std::string_view source_;
  std::int64_t step_ = 0;
  std::string word_;
  std::size_t at_ = 0;
};

const JsonNode& member(const JsonNode& root, std::string_view key, JsonNode::Type type, std::string_view source) {
  const JsonNode* value = root.find(key);
  const bool fits = value != nullptr && value->type == type;
  if (!fits)
    throw PresetError(std::string(source) + ": \"" + std::string(key) + "\" is missing, or is not " +
                      std::string(type_name(type)));
  return *value;
}

/// Follows the constants of a recording.
class Constants {
 public:
  explicit Constants(const Preset& start) : now_(start), largest_(start) {}
  void follow(std::int64_t step, const Event& event) {
    const auto* change = std::get_if<event::Change>(&event);
    const auto* resume = std::get_if<event::Resume>(&event);
    if (change == nullptr && resume == nullptr) return;
    end(step);
    now_ = with_settings(now_, change != nullptr ? change->settings : resume->settings);
    if (lattice_of(now_).size() > lattice_of(largest_).size()) largest_ = now_;
  }
  void end(std::int64_t step) { seconds_ += double(step - std::exchange(from_, step)) * now_.dt; }
  const Preset& now() const { return now_; }
  const Preset& largest() const { return largest_; }
  double seconds() const { return seconds_; }

 private:
  Preset now_, largest_;
  std::int64_t from_ = 0;
  double seconds_ = 0;
};

/// Whether a texture is a file rather than one of the program's.
bool names_path(const std::string& texture) {
  return texture.find_first_of("/\\:") != std::string::npos;
}

/// Whether a setting names a picture.
bool sets_texture(const std::string& setting) {
  return setting.starts_with("texture=");
}

/// As a file may have it: without pictures outside the program's own folder, since a file names no other file, and with
/// marks that are not too long.
Event as_in_file(Event event) {
  constexpr std::size_t continued = 3;  // bytes that say so
  if (auto* mark = std::get_if<event::Mark>(&event); mark != nullptr && mark->words.size() > longest_mark)
    mark->words = excerpt(mark->words, longest_mark - continued);
  if (auto* change = std::get_if<event::Change>(&event)) std::erase_if(change->settings, sets_texture);
  if (auto* resume = std::get_if<event::Resume>(&event)) std::erase_if(resume->settings, sets_texture);
  return event;
}

}  // namespace

Experiment experiment_of(const Simulation& simulation) {
  return experiment_of(simulation.past(), simulation);
}

Experiment experiment_of(const Recording& past, const Simulation& simulation) {
  Preset start = past.start();
  if (names_path(start.texture)) start.texture = Preset().texture;
  Recording recording(start);
  Constants constants(start);
  for (const Recording::Entry& entry : past.events()) {
    recording.add_steps(entry.step - recording.steps());
    Event kept = as_in_file(*entry.event);
    constants.follow(entry.step, kept);
    recording.add(std::move(kept));
  }
  recording.add_steps(past.steps() - recording.steps());
  constants.end(past.steps());
  // What a repetition ends with can be compared.
  if (!simulation.divergence() && simulation.past().steps() == past.steps())
    recording.add(event::Hash{simulation.hash()}), recording.add(simulation.look());
  if (!past.repeats()) recording.give_up_repeating();
  const Preset& now = simulation.preset();
  return {std::move(recording), TYGLAB_VERSION, simulation.engine().name() + ", " + std::string(name_of(now.precision)),
          constants.seconds(), constants.largest()};
}

std::string experiment_text(const Experiment& experiment) {
  const Recording& recording = experiment.recording;
  std::string text = "{\"tyglab_experiment\": " + std::to_string(experiment_version) +
                     ",\n\"version\": " + json_text(experiment.version) +
                     ",\n\"made_with\": " + json_text(experiment.made_with) +
                     ",\n\"repeats\": " + (recording.repeats() ? "true" : "false") +
                     ",\n\"steps\": " + std::to_string(recording.steps()) +
                     ",\n\"preset\": " + preset_to_json(recording.start()) + ",\n\"events\": [";
  bool first = true;
  for (const Recording::Entry& entry : recording.events()) {
    text += (first ? "\n" : ",\n") + text_of(entry);
    first = false;
  }
  return text + "\n]}\n";
}

Experiment parse_experiment(std::string_view text, std::string_view source) {
  const JsonNode root = parse_json(text, source, Lines::told, most_values);
  const auto fail = [&](const std::string& why) { throw PresetError(std::string(source) + ": " + why); };
  using Type = JsonNode::Type;
  if (root.type != Type::object || root.find("tyglab_experiment") == nullptr) fail("is not an experiment of Tyglab");
  const double version = member(root, "tyglab_experiment", Type::integer, source).number;
  if (version > experiment_version)
    fail("was made by a newer version of Tyglab (format " + shortest_number(version) + "); this one reads format " +
         std::to_string(experiment_version));
  constexpr std::array<std::string_view, 7> known{
      "tyglab_experiment", "version", "made_with", "repeats", "steps", "preset", "events"};
  for (const JsonNode::Member& one : root.members)
    if (std::find(known.begin(), known.end(), one.key) == known.end())
      fail("line " + std::to_string(one.value.line) + ": unknown key \"" + printable(excerpt(one.key)) + "\"");

  Experiment experiment{Recording(preset_from(member(root, "preset", Type::object, source), source, {}, "preset")),
                        printable(excerpt(member(root, "version", Type::text, source).text)),
                        printable(excerpt(member(root, "made_with", Type::text, source).text, 200))};
  Recording& recording = experiment.recording;
  const double steps = member(root, "steps", Type::integer, source).number;
  if (!(steps >= 0 && steps <= double(most_steps))) fail("\"steps\" is not allowed; allowed: 0 to 1e12");
  if (member(root, "repeats", Type::boolean, source).number == 0) recording.give_up_repeating();
  if (names_path(recording.start().texture)) fail("preset: names a texture outside the program");
  Constants constants(recording.start());
  for (const JsonNode& node : member(root, "events", Type::list, source).items) {
    EventReader reader(node, source);
    Event event = reader.event();
    if (reader.step() < recording.steps()) reader.fail("is earlier than the one before");
    if (double(reader.step()) > steps) reader.fail("is later than the end");
    recording.add_steps(reader.step() - recording.steps());
    try {
      constants.follow(reader.step(), event);
    } catch (const PresetError& error) {
      reader.fail(std::string("has a setting that is not allowed: ") + error.what());
    }
    if (names_path(constants.now().texture)) reader.fail("names a texture outside the program");
    recording.add(std::move(event));
  }
  recording.add_steps(std::int64_t(steps) - recording.steps());
  constants.end(recording.steps());
  experiment.seconds = constants.seconds(), experiment.largest = constants.largest();
  return experiment;
}

std::string comparison_in_words(const Playback& playback, const Experiment& experiment, bool own_start) {
  const Playback::Comparison& found = playback.comparison();
  if (!playback.recording().repeats())
    return "some recorded steps were cut off by the time limit, so the motion does not repeat exactly.";
  const std::string apart = found.looked_at == 0 ? ""
                                                 : " At step " + grouped(found.looked_at) +
                                                       " the corners, the edges' middles and the middle are at most " +
                                                       printed("%.2g", found.apart) + " m away from where they were.";
  if (found.compared == 0) return "the recording has no checks of the positions, so nothing was compared.";
  if (!found.differs_at)
    return "the positions equal the recorded ones to the last bit, in " + grouped(found.compared) +
           (found.compared == 1 ? " check." : " checks.");
  return "the positions equal the recorded ones to step " + grouped(found.equal_until) + " and differ at step " +
         grouped(*found.differs_at) + "; " +
         (own_start ? "the recording was made with " + experiment.made_with
                    : std::string("the command line changed the start")) +
         "." + apart;
}

}  // namespace tyglab
