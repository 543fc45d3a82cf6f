// The constants of an experiment as a link, "#hanging&k_s=100&W=[0,0,0.02]": a shipped preset and its differences,
// written as for --set. A page of Tyglab shows the link at the end of its address; the command line accepts the whole
// address or the link alone.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/model/preset.h"

namespace tyglab {

/// Whether a word on the command line, or dropped on the window, is a link or an address rather than a name or a file.
bool is_link(std::string_view text);

/// What a link says.
struct LinkedPreset {
  std::string name;                   ///< of a shipped preset
  std::vector<std::string> settings;  ///< "k_s=300"
};
/// Reads a link, or an address with one in it. Its constants are those of the preset that it names; else of the one
/// that the address names before the #, as in ?embed&preset=flag#k_s=300; else of the default preset. Throws
/// PresetError: the link names no shipped preset, or something in it is no setting.
LinkedPreset read_link(std::string_view text);

/// The preset itself. Throws PresetError: a setting is wrong.
Preset linked_preset(const LinkedPreset& link);

/// The link to these constants. `label`: of the shipped preset that they were made from, or anything else. Its texture
/// is named only where it is shipped.
std::string link_to(const Preset& preset, const std::string& label);

}  // namespace tyglab
