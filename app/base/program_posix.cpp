#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <sstream>
#include <string>

#include "app/base/settings.h"

namespace tyglab {

namespace fs = std::filesystem;

fs::path program_file() {
  return fs::read_symlink("/proc/self/exe");
}

std::string this_program_again() {
  return "/proc/self/exe";
}

fs::path data_folder_beside(const fs::path& folder) {
  return (folder / ".." / "share" / "tyglab").lexically_normal();
}

// The system notes its start to a hundredth of a second.
double program_age_s() {
  std::ifstream stat("/proc/self/stat");
  std::string text;
  std::getline(stat, text);
  std::istringstream fields(text.substr(std::min(text.rfind(')') + 2, text.size())));
  for (int before_start = 0; before_start < 19; ++before_start) fields >> text;
  double start_ticks = 0;
  fields >> start_ticks;
  timespec now{};
  clock_gettime(CLOCK_BOOTTIME, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec) - start_ticks / double(sysconf(_SC_CLK_TCK));
}

}  // namespace tyglab
