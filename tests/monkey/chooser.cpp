#include "tests/monkey/chooser.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "app/ui/frame/commands.h"
#include "app/ui/frame/panels.h"
#include "core/model/notation.h"

namespace tyglab::monkey {
namespace {

constexpr double enough_particles = 64 * 64;  // of more the monkey soon leaves, since each frame costs
constexpr int most_rows = 400;                // that it types

constexpr std::array texts{"",       "0",     "-0",     "-1",     "1",    "nan",      "inf",
                           "-inf",   "1e999", "1e-999", "1,5",    "2 ms", "9,8 cm",   "0x10",
                           "abc",    "1 2",   "+5",     "1e",     ".",    "--",       "1e308",
                           "5e-324", "0.1.2", "%n%s",   "\"\\\"", "{}",   "1e5 kg m", "99999999999999999999"};

std::string joined_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

/// The controls of bodies and entries count once, whichever it is.
std::string kind_of(std::string name) {
  for (char& letter : name)
    if (letter >= '0' && letter <= '9') letter = '#';
  return name;
}

bool ends_with(const std::string& text, std::string_view end) {
  return std::string_view(text).ends_with(end);
}

const PresetRow* row_of_control(const std::string& control) {
  const std::size_t first = control.find('.'), second = control.find('.', first + 1);
  if (first == std::string::npos) return nullptr;
  return find_row(control.substr(first + 1, second - first - 1));
}

}  // namespace

/// One of them by chance: one that was taken n times comes with a weight of 1/(1 + n)².
std::string Chooser::seldom(const std::vector<std::string>& names, std::map<std::string, int>& done) {
  double sum = 0;
  const auto weight = [&](const std::string& name) { return 1 / std::pow(1.0 + done[kind_of(name)], 2); };
  for (const std::string& name : names) sum += weight(name);
  double left = part() * sum;
  for (const std::string& name : names)
    if ((left -= weight(name)) <= 0) return ++done[kind_of(name)], name;
  return ++done[kind_of(names.back())], names.back();
}

/// A cloth of millions of particles would take the memory of the machine, and minutes; nor is there a full screen.
bool Chooser::allowed(const std::string& control) const {
  if (control == "dialog.Build_it") return false;
  if (!one_cloth_) return true;
  for (const char* other : {"rows", "columns", "entry", "resolution", "Quit", "kind"})
    if (control.find(other) != std::string::npos) return false;
  return true;
}

std::string Chooser::number_between(double least, double most) {
  const bool decades = least > 0 && most / least > 100;
  return joined_number(decades ? least * std::pow(most / least, part()) : least + (most - least) * part());
}

std::string Chooser::decimal(double least, double most) {
  char text[16];
  std::snprintf(text, sizeof text, "%.3f", least + (most - least) * part());
  return text;
}

std::string Chooser::value(const std::string& control) {
  if (one_in(4)) return one_of(texts);
  const PresetRow* row = row_of_control(control);
  if (control.find("rows") != control.npos || control.find("columns") != control.npos)
    return std::to_string(one_in(12) ? below(most_rows) : 2 + below(40));
  if (row == nullptr) return number_between(-10, 10);
  if (one_in(6)) return joined_number(one_in(2) ? row->min : row->max);
  if (one_in(8)) return joined_number(row->max * 1.01 + 1);
  const double least = row->min > 0 ? row->min : row->scale == Scale::logarithmic ? 1e-6 : row->min;
  return number_between(least, std::min(row->max, 1e6));
}

Action Chooser::control(Player& player) {
  std::vector<std::string> names;
  for (const auto& [name, box] : player.window().controls()) {
    controls_.try_emplace(kind_of(name), 0);
    if (allowed(name)) names.push_back(name);
  }
  if (names.empty()) return {Verb::wait, {"3"}};
  const std::string name = seldom(names, controls_);
  if (ends_with(name, ".slider")) {
    if (one_in(8)) return {Verb::wheel, {name, one_in(2) ? "-2" : "2"}};
    if (!one_in(4)) return {Verb::drag, {name, decimal(0, 1), decimal(-0.2, 1.2)}};
  }
  if (ends_with(name, ".value") && !one_in(4)) return {Verb::value, {name, value(name)}};
  if (name == "dialog.name") return {Verb::fill, {name, one_of(texts)}};
  if (one_in(12)) return {Verb::wheel, {name, one_in(2) ? "-3" : "3"}};
  const std::size_t how = below(12);
  if (how == 0) return {Verb::click, {name, "right"}};
  if (how == 1) return {Verb::click, {name, "double"}};
  return {Verb::click, {name}};
}

/// By its keys, or through the palette.
Action Chooser::command(Player&) {
  std::vector<std::string> ids;
  for (const CommandTopic& topic : command_topics())
    for (const CommandRow& row : topic.rows)
      if (std::string_view(row.id) != "quit" || !one_cloth_) ids.emplace_back(row.id);
  const CommandRow& row = tyglab::row_of(seldom(ids, commands_));
  if (!row.chords.empty() && !one_in(3)) {
    const Chord& chord = one_of(row.chords);
    if (const std::string name = name_of(Key{chord.key, chord.mods}); !name.empty()) return {Verb::key, {name}};
  }
  return {Verb::find, {row.name}};
}

/// Anything that the palette holds: methods, presets, labs, constants.
Action Chooser::found(Player& player) {
  std::vector<std::string> titles;
  for (const PaletteEntry& entry : palette_entries(player.window().ui)) {
    const bool other = entry.group == "Preset" || entry.group == "Lab" || entry.title.starts_with("Quit");
    if (!one_cloth_ || !other) titles.push_back(entry.title);
  }
  return {Verb::find, {seldom(titles, entries_)}};
}

Action Chooser::on_cloth() {
  const auto site = [&] { return std::to_string(below(5)); };
  switch (below(6)) {
    case 0:
    case 1:
      return {Verb::grab, {site(), site(), decimal(-0.4, 0.4), decimal(-0.4, 0.4)}};
    case 2:
      return {Verb::cut, {site(), site(), site(), site()}};
    case 3:
      return {Verb::pin, {site(), site()}};
    case 4:
      return {Verb::pick, {site(), site()}};
    default:
      return stroke();
  }
}

Action Chooser::stroke() {
  if (one_in(3)) return {Verb::zoom, {one_in(2) ? "-2" : "2"}};
  constexpr std::array buttons{"left", "middle", "right"};
  constexpr std::array held{"", "ctrl", "shift"};
  Action action{Verb::stroke, {decimal(0, 1), decimal(0, 1), decimal(0, 1), decimal(0, 1), one_of(buttons)}};
  if (const std::string key = one_of(held); !key.empty()) action.words.push_back(key);
  return action;
}

Action Chooser::document(Player& player) {
  const std::vector<std::string> files = player.files();
  const std::size_t what = below(8);
  if (one_cloth_ || what < 2) return {Verb::save, {"saved-" + std::to_string(below(4)) + ".json"}};
  if (what < 4) return {Verb::open, {one_of(files)}};
  if (what < 7) return {Verb::drop, {one_of(files)}};
  return {Verb::quit_restart, {}};
}

Action Chooser::next(Player& player) {
  Session& session = player.window().session;
  if (particles(session.requested_preset()) > enough_particles && one_in(2)) return {Verb::find, {"hanging"}};
  const std::size_t what = below(100);
  if (player.window().ui.dialog.kind != Dialog::Kind::none && what < 60) return control(player);
  if (what < 42) return control(player);
  if (what < 56) return command(player);
  if (what < 62) return found(player);
  if (what < 76) return on_cloth();
  if (what < 82) return {Verb::key, {one_of(key_names())}};
  if (what < 86) return {Verb::key, {"Escape"}};
  if (what < 90) return {Verb::undo_redo, {}};
  if (what < 93) return document(player);
  if (what < 94) return {Verb::type, {one_of(texts)}};
  if (what < 96) return {Verb::resize, {std::to_string(320 + below(1600)), std::to_string(200 + below(1000))}};
  return {Verb::wait, {std::to_string(1 + below(40))}};
}

std::string Chooser::coverage() const {
  const auto used = [](const std::map<std::string, int>& of) {
    return std::to_string(std::count_if(of.begin(), of.end(), [](const auto& one) { return one.second > 0; }));
  };
  std::size_t commands = 0;
  for (const CommandTopic& topic : command_topics()) commands += topic.rows.size();
  return used(controls_) + " of " + std::to_string(controls_.size()) + " controls that were seen, " + used(commands_) +
         " of " + std::to_string(commands) + " commands, " + used(entries_) + " entries of the palette";
}

}  // namespace tyglab::monkey
