// Requests from panels, keys, menus and labs to a session. They change nothing themselves: requests.cpp applies them in
// one place.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/edit.h"
#include "core/model/difference.h"
#include "core/model/effect.h"

namespace tyglab {

namespace request {
/// An edit of the simulation. Edits of one gesture (a drag of a slider) are undone together; 0 stands alone.
struct Apply {
  Edit edit;
  unsigned gesture = 0;
  bool confirmed = false;  ///< the user has agreed to a very large cloth
};
/// Goes back one second and continues with these constants.
struct Retry {
  Preset preset;
};
/// Replays the last steps before the divergence slowly.
struct Replay {};
/// Opens a preset from a file, with these settings ("k_s=500"). Asks first if changes would be lost, unless confirmed.
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
struct Quit {
  bool confirmed = false;
};
}  // namespace request

using Request = std::variant<request::Apply, request::Retry, request::Replay, request::Open, request::SavePreset,
                             request::LoadTexture, request::AddCopy, request::RemoveCopy, request::Quit>;

/// A question that the user must answer before the session continues with a request.
struct Question {
  enum class About { unsaved_changes, large_cloth };
  About about;
  std::string text;
  Request then;  ///< what follows a yes
};

struct Session;
/// Applies all requests since the last update, in order. Errors become messages and change nothing.
void apply_requests(Session& session);
/// Whether the present constants differ from those of the file (the view apart); never those of a lab's cloth.
bool unsaved(const Session& session);
/// Whether the motion has diverged, and constants of its model have been changed since.
bool changed_since_divergence(const Session& session);
/// Effects of changes that do not affect the model of the motion.
inline constexpr EffectSet beside_model = motionless | Effect::engine | Effect::device | Effect::precision;
/// Whether both describe the same motion: they may differ in name, picture, engine and precision.
bool same_model(const Preset& a, const Preset& b);

}  // namespace tyglab
