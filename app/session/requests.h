// What panels, keys and menus ask for. They change nothing themselves: requests.cpp applies what they ask, in one
// place.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/edit.h"
#include "core/fields/particle_field.h"
#include "core/model/difference.h"

namespace tyglab {

enum class Command {
  restart,           ///< motion only; constants stay
  reset_constants,   ///< to the preset's, motion stays
  reset_everything,  ///< the preset, its start, the camera
  undo_and_restart,
  rewind,         ///< a second back
  toggle_auto,    ///< dt chosen and watched by the program
  choose_engine,  ///< measured by the program
  toggle_play,
  step,
  undo,
  redo,
  frame_cloth,
  open_dialog,
  save,
  save_as,
  load_texture_dialog,
  export_forces,
  export_height,
  toggle_help,
  open_palette,
  choose_lab,
  leave_lab,
  start_tour,
  toggle_panels,
  toggle_map,  ///< its card comes to the front, or closes where it stands there
  toggle_inside,
  show_forces,  ///< cards of the plots' column
  show_height,
  show_distances,
  show_copies,
  show_stability,
  show_accuracy,
  show_energy,
  show_performance,
  toggle_cut_path,    ///< cuts run along the pointer's path, or upwards
  toggle_wind_arrow,  ///< shown, or not
  toggle_slow_hand,   ///< slow motion while the hand is in the cloth, or not
  export_map,
  export_map_picture,
  export_copies,
  full_screen,
  larger_text,
  smaller_text,
  normal_text,
  next_theme,
  next_color,
  export_values,
  export_mesh,
  export_state,
  measure_convergence,
  export_convergence,
  toggle_effects,
  save_picture,
  quit,
};

/// What can be written to a file (exports.h), in its order.
enum class ExportSource { forces, height, map, copies, values, convergence, map_picture, mesh, state };

namespace request {
/// An edit of the simulation. Edits of one gesture (a drag of a slider) are undone together; 0 stands alone.
struct Apply {
  Edit edit;
  unsigned gesture = 0;
  bool confirmed = false;  ///< the user has agreed to a very large cloth
};
struct Do {
  Command command;
};
/// A second back, and on from there with these constants.
struct Retry {
  Preset preset;
};
/// Takes a preset from a file, with these settings ("k_s=500") made in it. Asks first where changes would be lost,
/// unless confirmed.
struct Open {
  std::filesystem::path file;
  bool shipped = false;
  bool confirmed = false;
  std::vector<std::string> settings = {};
};
struct SavePreset {
  std::filesystem::path file;
  std::string name;
};
struct WriteExport {
  std::filesystem::path file;
  ExportSource source = ExportSource::forces;
};
/// A PNG of the window, or of the viewport with what its colours mean and without buttons.
struct SavePicture {
  std::filesystem::path file;
  bool whole_window = false;
};
struct LoadTexture {
  std::string name;  ///< shipped name or path
};
/// A copy that moves in lockstep, with these values instead of the present ones.
struct AddCopy {
  std::vector<Difference> differences;
  bool as_reference = false;
};
struct RemoveCopy {
  std::size_t index;
};
/// What colours the cloth: none, its own look.
struct ColorBy {
  std::optional<ParticleField> field;
};
struct Quit {
  bool confirmed = false;
};
}  // namespace request

using Request = std::variant<request::Apply, request::Do, request::Open, request::SavePreset, request::WriteExport,
                             request::LoadTexture, request::Retry, request::AddCopy, request::RemoveCopy,
                             request::ColorBy, request::SavePicture, request::Quit>;

struct App;
/// Applies all requests since the last frame, in order. Errors become messages and leave everything as it was.
void apply_requests(App& app);
/// While dt is automatic: halves it if the ledger finds that the method makes energy.
void watch_dt(App& app);
/// Whether the present constants differ from those of the file (the view apart).
bool unsaved(const App& app);
/// Whether the motion has diverged, and constants of its model have been changed since.
bool changed_since_divergence(const App& app);
/// Whether both say the same of the motion: they may differ in name, picture, engine and precision.
bool same_model(Preset a, const Preset& b);

}  // namespace tyglab
