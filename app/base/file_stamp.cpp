#include "app/base/file_stamp.h"

#include <system_error>

namespace tyglab {
namespace fs = std::filesystem;

std::optional<FileStamp> stamp_of(const fs::path& file) {
  std::error_code no_time, no_size;
  const FileStamp stamp{file, fs::last_write_time(file, no_time), fs::file_size(file, no_size)};
  return no_time || no_size ? std::nullopt : std::optional(stamp);
}

}  // namespace tyglab
