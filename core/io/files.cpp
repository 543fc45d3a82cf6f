#include "core/io/files.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>

namespace tyglab {
namespace {

/// Where a link points in the end, whether that is there yet or not; a link still if they go round in a circle.
std::filesystem::path followed(std::filesystem::path file) {
  constexpr int most_links = 40;  // as many as Linux follows
  std::error_code error;
  for (int n = 0; n < most_links && std::filesystem::is_symlink(file, error); ++n)
    file = file.parent_path() / std::filesystem::read_symlink(file, error);
  return file;
}

}  // namespace

void write_atomically(const std::filesystem::path& file, std::string_view text) {
  const auto fail = [&](const std::string& why) { throw OutputError(file.string() + ": cannot be written: " + why); };
  std::filesystem::path target = file;
  std::error_code error;
  if (std::filesystem::is_directory(target, error)) fail("it is a folder; name a file in it");
  if (std::filesystem::exists(target, error) && !std::filesystem::is_regular_file(target, error)) {
    // A pipe or a device (/dev/stdout) cannot be replaced; it takes the text as it comes.
    std::ofstream out(target, std::ios::binary);
    out << text << std::flush;
    if (!out) fail(std::strerror(errno));
    return;
  }
  // The file that a link points to is replaced, and not the link.
  target = followed(target);
  if (std::filesystem::is_symlink(target, error)) fail(std::strerror(ELOOP));
  const std::filesystem::path temporary = target.string() + "." + std::to_string(::getpid()) + ".tmp";
  const int fd = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (fd < 0) fail(std::strerror(errno));
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t n = ::write(fd, text.data() + done, text.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) {
      const std::string why = std::strerror(errno);
      ::close(fd);
      ::unlink(temporary.c_str());
      fail(why);
    }
    done += std::size_t(n);
  }
  if (::close(fd) != 0 || ::rename(temporary.c_str(), target.c_str()) != 0) {
    const std::string why = std::strerror(errno);
    ::unlink(temporary.c_str());
    fail(why);
  }
}

}  // namespace tyglab
