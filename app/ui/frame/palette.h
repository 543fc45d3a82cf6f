// Ctrl+P: finds commands, presets, integrators, labs, constants and views by typing.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "app/ui/state/ui.h"

namespace tyglab {

/// Opens it; `labs`: with labs alone, and how far each is done.
void open_palette(Ui& ui, bool labs = false);
/// Draws it, and does what is chosen.
void palette(Ui& ui);

/// All that it finds now.
std::vector<PaletteEntry> palette_entries(Ui& ui);
/// A lab, and a preset, as it finds them.
PaletteEntry lab_entry(const Ui& ui, const Lab& lab);
PaletteEntry preset_entry(const Preset& preset, const std::filesystem::path& file, bool shipped);
/// Indices of the entries that hold every word typed, those whose title begins with it first.
std::vector<int> matching(std::span<const PaletteEntry> entries, std::string_view typed);

}  // namespace tyglab
