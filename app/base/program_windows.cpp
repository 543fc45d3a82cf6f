#include <windows.h>

#include <string>
#include <system_error>

#include "app/base/settings.h"

namespace tyglab {

namespace fs = std::filesystem;

fs::path program_file() {
  std::wstring name(1 << 15, L'\0');  // the longest that Windows knows
  const DWORD length = ::GetModuleFileNameW(nullptr, name.data(), DWORD(name.size()));
  if (length == 0 || length == name.size())
    throw fs::filesystem_error("GetModuleFileName", std::error_code(int(::GetLastError()), std::system_category()));
  name.resize(length);
  return name;
}

std::string this_program_again() {
  return program_file().string();
}

fs::path data_folder_beside(const fs::path& folder) {
  const fs::path unzipped = folder / "data";
  std::error_code error;
  return fs::is_directory(unzipped, error) ? unzipped : (folder / ".." / "share" / "tyglab").lexically_normal();
}

double program_age_s() {
  FILETIME start{}, now{}, unused{};
  ::GetProcessTimes(::GetCurrentProcess(), &start, &unused, &unused, &unused);
  ::GetSystemTimePreciseAsFileTime(&now);
  const auto ticks = [](const FILETIME& time) {
    return double(std::uint64_t(time.dwHighDateTime) << 32 | time.dwLowDateTime);
  };
  return 1e-7 * (ticks(now) - ticks(start));
}

}  // namespace tyglab
