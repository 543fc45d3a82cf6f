// Writes settings to disk while the window is open, so nothing is lost however the window ends.
#pragma once

#include <functional>
#include <string>
#include <variant>

#include "app/base/messages.h"
#include "app/base/settings.h"
#include "app/studies/job.h"

namespace tyglab {

/// Writes settings beside the frames, within a second of a change.
class SettingsWriter {
 public:
  /// `known`: what this program has read from the file.
  explicit SettingsWriter(Settings known) : known_(std::move(known)) {}
  /// To be called often; `now` is in s. Begins to write what `present` returns where that has changed. Returns
  /// whether there is a message, once, that it cannot be written.
  bool update(double now, const std::function<Settings()>& present, Messages& messages);
  /// Writes the last ones. Throws OutputError.
  void finish(const Settings& last);

 private:
  using Written = std::variant<Settings, std::string>;  ///< what stands in the file now, or why it does not

  /// Takes the outcome of the work, waiting for it; why it failed, or nothing.
  std::string take();

  Settings known_;  ///< as this program read or wrote it last
  Job<Written> job_;
  double next_ = 0;  ///< s, not before which it looks again
  std::string problem_;
};

}  // namespace tyglab
