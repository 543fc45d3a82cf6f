// Does actions on the user interface without a window, and watches what must hold after each frame.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "app/shell/sandbox.h"
#include "tests/monkey/action.h"
#include "tests/ui/null_ui.h"

namespace tyglab::monkey {

/// Something that must hold does not.
class Finding : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a run came to.
struct Tally {
  long actions = 0, frames = 0, restarts = 0;
  long passed_over = 0;  ///< whose control or particle was not in sight
  double longest_frame_s = 0;
  double most_work_s = 0;     ///< processor time of the thread that draws, from one frame to the next
  std::string longest_after;  ///< the action in which that was
  double most_mb = 0;         ///< resident memory
};

class Player {
 public:
  /// Begins a session in a folder of its own, with files to open and drop; nothing is written outside that.
  Player();
  ~Player();
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

  /// Throws Finding, and whatever the user interface throws.
  void play(const Action& action);
  test::NullUi& window() { return *window_; }
  const Tally& tally() const { return tally_; }
  /// Names of the files that can be opened and dropped now.
  std::vector<std::string> files() const;

 private:
  void lay_out_files() const;
  std::filesystem::path file(const std::string& name) const;
  void begin(const Settings& settings);
  void restart();
  bool done(const Action& action);
  bool on_control(const Action& action);
  bool on_cloth(const Action& action);
  bool with_file(const Action& action);
  void click(glm::vec2 at, int button);
  void stroke(const Action& action);
  void type(std::string_view text);
  void replace(const std::string& name, std::string_view text);
  void tap(const std::string& chord);
  void undo_redo();
  std::optional<glm::vec2> particle(const Action& action, std::size_t n);
  std::optional<glm::vec2> middle(const std::string& name) const;
  void after_frame(double seconds);
  void check_state();
  void check_documents() const;

  test::TemporaryFolder folder_;
  std::unique_ptr<test::NullUi> window_;
  std::unique_ptr<SettingsWriter> writer_;
  std::optional<Preset> checked_;  ///< the last preset that was found good
  Tally tally_;
  double worked_s_ = 0;  ///< processor time of this thread until the last frame
  std::string now_;      ///< the action that is being done
};

/// Resident memory now, MB.
double resident_mb();

}  // namespace tyglab::monkey
