// --color: the quantity that colors the cloth in pictures and in the window.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace tyglab {

/// Adds --color, whose text is the name of a ParticleField (field_called), or empty. `copies`: there may be some, which
/// the distance from a reference needs.
void add_color_option(CLI::App& command, std::string& name, bool copies);

}  // namespace tyglab
