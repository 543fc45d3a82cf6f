#include "app/base/text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <limits>

#include "app/base/files.h"
#include "core/io/json_tree.h"
#include "core/io/preset_io.h"
#include "core/io/terminal.h"
#include "core/model/notation.h"

namespace tyglab {
namespace {

constexpr auto default_preset = "hanging";

/// A part of a link in a sentence.
std::string cited(std::string_view text, std::size_t most = 60) {
  return "'" + in_one_line(excerpt(text, most)) + "'";
}

[[noreturn]] void fail(std::string_view link, const std::string& why) {
  throw PresetError("The link " + cited(link, 200) + " " + why + " Copy the whole link again; links look like " +
                    std::string(example_link) + ".");
}

/// Of a hexadecimal digit; below 0: it is none.
int digit(char letter) {
  constexpr std::string_view digits = "0123456789abcdef", capitals = "0123456789ABCDEF";
  const std::size_t at = std::min(digits.find(letter), capitals.find(letter));
  return at == std::string_view::npos ? -1 : int(at);
}

std::string decoded(std::string_view text, std::string_view link) {
  std::string plain;
  for (std::size_t n = 0; n < text.size(); ++n) {
    if (text[n] != '%') {
      plain += text[n];
      continue;
    }
    if (n + 2 >= text.size() || digit(text[n + 1]) < 0 || digit(text[n + 2]) < 0)
      fail(link, "has a % that is not followed by two hexadecimal digits.");
    plain += char(16 * digit(text[n + 1]) + digit(text[n + 2]));
    n += 2;
  }
  return plain;
}

std::string encoded(std::string_view text) {
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.-~,:=[]/";
  std::string link;
  for (const char letter : text) {
    if (plain.find(letter) != std::string_view::npos) {
      link += letter;
    } else {
      std::array<char, 4> code{};
      std::snprintf(code.data(), code.size(), "%%%02X", unsigned(static_cast<unsigned char>(letter)));
      link += code.data();
    }
  }
  return link;
}

bool is_shipped_preset(const std::string& name) {
  const std::vector<std::string> names = shipped_presets();
  return std::binary_search(names.begin(), names.end(), name);
}

/// "https" of an address that begins with https://, in lower case; empty if the text is no address.
std::string scheme_of(std::string_view text) {
  std::string scheme(text.substr(0, std::min(text.find("://"), text.size())));
  const auto is_letter = [](unsigned char letter) { return std::isalpha(letter) != 0; };
  if (scheme.size() == text.size() || !std::all_of(scheme.begin(), scheme.end(), is_letter)) return {};
  for (char& letter : scheme) letter = char(std::tolower(static_cast<unsigned char>(letter)));
  return scheme;
}

/// Of an address that holds no experiment.
[[noreturn]] void refuse_address(std::string_view address) {
  std::string cure =
      "Tyglab downloads nothing: download the file first, then open that file. A link to an experiment "
      "has it after a #: https://…/" +
      std::string(example_link) + ".";
  if (scheme_of(address) == "file")
    cure = "Open the file by its path: " +
           cited(decoded(address.substr(std::min(address.find('/', 7), address.size())), address), 200) + ".";
  throw PresetError("The address " + cited(address, 200) + " contains no experiment. " + cure);
}

/// Without the last bits that sums leave: 0.2325 in place of 0.23249999999999998.
double without_noise(double value) {
  constexpr int digits = 12;
  constexpr double noise = 4 * std::numeric_limits<double>::epsilon();
  const double plain = rounded(value, digits);
  return std::abs(plain - value) <= noise * std::abs(value) ? plain : value;
}

template <class T>
void drop_noise(const FieldOf<T>& field, T& of) {
  if (const auto* number = std::get_if<double T::*>(&field)) of.** number = without_noise(of.**number);
  if (const auto* vector = std::get_if<glm::dvec3 T::*>(&field))
    for (int k = 0; k < 3; ++k) (of.**vector)[k] = without_noise((of.**vector)[k]);
}

/// The preset that an address names before its #, as in ?embed&preset=flag&panels=0; empty if it names none. Where no #
/// follows (`alone`), nothing else may stand there that means an experiment.
std::string framed_preset(std::string_view address, std::string_view link, bool alone) {
  std::string name;
  std::string_view rest = address.substr(std::min(address.find('?'), address.size() - 1) + 1);
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('&'), rest.size());
    const std::string part = decoded(rest.substr(0, end), link), key = part.substr(0, part.find('='));
    const std::string value = part.substr(std::min(key.size() + 1, part.size()));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (key == "preset") {
      name = value;
    } else if (alone && key == "lab") {
      throw PresetError("The link opens a lab, not a preset: start it in the window with tyglab --lab " +
                        in_one_line(excerpt(value)) + ".");
    } else if (alone && key != "embed" && key != "panels") {
      if (name.empty()) refuse_address(link);
      fail(link, "has no # before its constants, such as " + cited(part) + ".");
    }
  }
  if (!name.empty() && !is_shipped_preset(name)) fail(link, "names no shipped preset: " + cited(name) + ".");
  return name;
}

}  // namespace

bool is_link(std::string_view text) {
  return text.starts_with('#') || !scheme_of(text).empty();
}

LinkedPreset read_link(std::string_view text) {
  const std::size_t hash = std::min(text.find('#'), text.size());
  const bool alone = hash == text.size();
  const std::string framed = hash > 0 ? framed_preset(text.substr(0, hash), text, alone) : std::string();
  const bool file = text.substr(0, std::min(text.find('?'), hash)).ends_with(".json");
  if (file || (hash > 0 && framed.empty() && hash + 1 >= text.size())) refuse_address(text);
  if (text == "#") fail(text, "names neither a preset nor a constant.");
  LinkedPreset linked{framed.empty() ? default_preset : framed, {}};
  std::string_view rest = text.substr(std::min(hash + 1, text.size()));
  for (bool first = true; !rest.empty(); first = false) {
    const std::size_t end = std::min(rest.find('&'), rest.size());
    const std::string part = decoded(rest.substr(0, end), text);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (first && part.find('=') == std::string::npos) {
      if (!is_shipped_preset(part)) fail(text, "names no shipped preset: " + cited(part) + ".");
      linked.name = part;
    } else if (part.find('=') == std::string::npos || part.starts_with('=')) {
      fail(text, "has a part that is not KEY=VALUE: " + cited(part) + ".");
    } else {
      const std::string key = part.substr(0, part.find('='));
      const auto same = [&](const std::string& other) { return other.substr(0, other.find('=')) == key; };
      if (std::any_of(linked.settings.begin(), linked.settings.end(), same))
        fail(text, "sets " + cited(key) + " twice; keep one of them.");
      linked.settings.push_back(part);
    }
  }
  return linked;
}

Preset linked_preset(const LinkedPreset& link) {
  std::vector<Setting> settings;
  for (const std::string& text : link.settings) {
    Setting setting = parse_setting(text);
    setting.typed = "The link's " + in_one_line(excerpt(text, 200));
    settings.push_back(std::move(setting));
  }
  Preset preset = with_parsed_settings(read_preset(find_preset(link.name).file), settings);
  if (!preset.texture.empty() && !is_shipped_texture(preset.texture))
    throw PresetError("The link's texture " + cited(preset.texture) +
                      " is not a shipped one; a link contains no image.");
  return preset;
}

std::string link_to(const Preset& preset, const std::string& label) {
  const std::string name = is_shipped_preset(label) ? label : default_preset;
  const Preset from = read_preset(find_preset(name).file);
  Preset to = preset;
  if (!to.texture.empty() && !is_shipped_texture(to.texture)) to.texture = from.texture;
  for (const PresetRow& row : notation()) drop_noise(row.field, to);
  for (const BodyRow& row : body_notation())
    for (Body& body : to.bodies) drop_noise(row.field, body);
  std::string link = "#" + encoded(name);
  for (const std::string& setting : settings_between(from, to)) link += "&" + encoded(setting);
  return link;
}

}  // namespace tyglab
