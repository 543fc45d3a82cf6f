#include "app/shell/sandbox.h"

#include <utility>

#include "app/platform/platform.h"
#include "core/io/output_file.h"

namespace tyglab {
namespace {

constexpr double between_looks = 0.5;  // s
constexpr double after_failure = 10;   // s

}  // namespace

std::string SettingsWriter::take() {
  auto outcome = job_.take();
  if (const auto* error = std::get_if<JobError>(&outcome)) return error->what;
  auto& written = std::get<Written>(outcome);
  if (auto* why = std::get_if<std::string>(&written)) return std::move(*why);
  known_ = std::move(std::get<Settings>(written));
  return {};
}

bool SettingsWriter::update(double now, const std::function<Settings()>& present, Messages& messages) {
  if (job_.ready()) {
    std::string problem = take();
    if (!problem.empty()) next_ = now + after_failure;
    const bool new_one = !problem.empty() && problem != problem_;
    if (new_one)
      messages.warning(problem + ". The settings of this session are not remembered until that is resolved.");
    problem_ = std::move(problem);
    if (new_one) return true;
  }
  if (job_.busy() || now < next_) return false;
  next_ = now + between_looks;
  Settings settings = present();
  if (settings == known_) return false;
  job_.start(Priority::normal, [settings = std::move(settings), known = known_](const JobControl&) -> Written {
    try {
      save_settings(settings, known);
      keep_files(config_folder());
    } catch (const OutputError& error) {
      return error.what();
    }
    return settings;
  });
  return false;
}

void SettingsWriter::finish(const Settings& last) {
  if (job_.busy()) take();
  save_settings(last, known_);
  keep_files(config_folder());
  known_ = last;
}

}  // namespace tyglab
