// The menu of engines and precisions in the top bar, which the palette also lists.
#pragma once

#include <span>
#include <string>

#include "core/model/preset.h"

namespace tyglab {

struct Ui;

/// Where the cloth is computed, and how exactly.
struct EngineMode {
  const char* name;   ///< in the session report: "cpu_float"
  const char* label;  ///< in the menu: "CPU · float"
  const char* title;  ///< in the palette: "CPU, float"
  EngineKind engine;
  Precision precision;
};
std::span<const EngineMode> engine_modes();

/// Why the mode cannot be chosen with these constants, in sentences; empty: it can, as far as is known. `devices`: what
/// OpenCL offers, null while that is not known.
std::string why_not(const EngineMode& mode, const Preset& preset, const OpenClInventory* devices);
/// What the mode is, in a sentence, with the device's name where it is known.
std::string words_of(const EngineMode& mode, const Preset& preset, const OpenClInventory* devices);

/// The menu, as a combo box of that width.
void engine_menu(Ui& ui, float width);

}  // namespace tyglab
