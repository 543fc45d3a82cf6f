
#include "core/io/system_files.h"

#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <memory>

namespace tyglab::os {

namespace fs = std::filesystem;

const std::size_t pipe_portion = PIPE_BUF;

namespace {

constexpr mode_t permissions = 0777;

FileFacts facts_in(const struct stat& status) {
  return {S_ISREG(status.st_mode),      S_ISDIR(status.st_mode), std::uintmax_t(status.st_size),
          status.st_mode & permissions, status.st_uid,           status.st_gid};
}

}  // namespace

std::optional<FileFacts> facts_of(const fs::path& file) {
  struct stat status = {};
  return ::stat(file.c_str(), &status) == 0 ? std::optional(facts_in(status)) : std::nullopt;
}

std::optional<FileFacts> facts_of(int descriptor) {
  struct stat status = {};
  return ::fstat(descriptor, &status) == 0 ? std::optional(facts_in(status)) : std::nullopt;
}

int open_to_read(const fs::path& file) {
  return ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
}

int open_new(const fs::path& file, bool closed) {
  return ::open(file.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, closed ? 0600 : 0666);
}

int open_present(const fs::path& file) {
  return ::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
}

int open_stream(const fs::path& file) {
  return ::open(file.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC | O_NONBLOCK);
}

int open_temporary() {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> temporary(std::tmpfile(), std::fclose);
  return temporary ? ::fcntl(::fileno(temporary.get()), F_DUPFD_CLOEXEC, 0) : -1;
}

fs::path temporary_folder() {
  return P_tmpdir;
}

void close(int descriptor) {
  ::close(descriptor);
}

bool close_written(int descriptor) {
  return ::close(descriptor) == 0;
}

bool arrived(int descriptor) {
  // Some file systems tell only when a file is closed that the disk is full. A copy is, since the descriptor has the
  // lock.
  const int copy = ::dup(descriptor);
  return copy < 0 || ::close(copy) == 0;
}

std::int64_t read(int descriptor, char* bytes, std::size_t most) {
  return ::read(descriptor, bytes, most);
}

std::int64_t read_at(int descriptor, char* bytes, std::size_t most, std::uint64_t offset) {
  return ::pread(descriptor, bytes, most, off_t(offset));
}

std::int64_t write(int descriptor, const char* bytes, std::size_t count) {
  return ::write(descriptor, bytes, count);
}

std::int64_t write_at(int descriptor, const char* bytes, std::size_t count, std::uint64_t offset) {
  return ::pwrite(descriptor, bytes, count, off_t(offset));
}

void truncate(int descriptor, std::uint64_t size) {
  [[maybe_unused]] const int cut = ::ftruncate(descriptor, off_t(size));
}

bool can_seek(int descriptor) {
  return ::lseek(descriptor, 0, SEEK_CUR) >= 0;
}

bool lock(int descriptor) {
  while (::flock(descriptor, LOCK_EX | LOCK_NB) != 0)
    if (errno != EINTR) return errno != EWOULDBLOCK;
  return true;
}

bool names(const fs::path& file, int descriptor) {
  struct stat by_name = {}, opened = {};
  return ::lstat(file.c_str(), &by_name) == 0 && ::fstat(descriptor, &opened) == 0 && by_name.st_dev == opened.st_dev &&
         by_name.st_ino == opened.st_ino;
}

void adopt(int descriptor, const FileFacts& older) {
  constexpr mode_t of_group = 0070, of_others = 0007;
  mode_t mode = older.mode;
  const auto owner = uid_t(older.owner);
  const auto group = gid_t(older.group);
  // Not even the owner can give a file to a group of others: that group then gets what others have.
  if (::fchown(descriptor, owner, group) != 0 && ::fchown(descriptor, uid_t(-1), group) != 0)
    mode = (mode & ~of_group) | (mode & of_others) << 3;
  ::fchmod(descriptor, mode);
}

bool unlink(const fs::path& file) {
  return ::unlink(file.c_str()) == 0;
}

bool rename(const fs::path& from, const fs::path& to) {
  return ::rename(from.c_str(), to.c_str()) == 0;
}

bool is_stream(const fs::path& file) {
  std::error_code error;
  if (fs::exists(file, error) && !fs::is_regular_file(file, error)) return true;
  const fs::path folder = fs::canonical(file.has_parent_path() ? file.parent_path() : fs::path("."), error);
  return !error && folder.string().starts_with("/proc/");
}

bool may_write(const fs::path& file) {
  return ::access(file.c_str(), W_OK) == 0;
}

bool may_write_into(const fs::path& folder) {
  return ::access(folder.c_str(), W_OK | X_OK) == 0;
}

bool takes_bytes_within(int milliseconds, int descriptor) {
  pollfd wanted{descriptor, POLLOUT, 0};
  return ::poll(&wanted, 1, milliseconds) > 0;
}

bool output_has_no_reader() {
  pollfd output{STDOUT_FILENO, POLLOUT, 0};
  return ::poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0;
}

bool is_terminal(int descriptor) {
  return ::isatty(descriptor) == 1;
}

}  // namespace tyglab::os

namespace tyglab {

namespace {

/// What XDG's variable names, or that folder in the user's own.
std::filesystem::path base(const char* variable, const char* in_home) {
  if (const std::filesystem::path xdg = environment(variable); xdg.is_absolute()) return xdg;
  const std::filesystem::path home = home_folder();
  return home.empty() ? home : home / in_home;
}

}  // namespace

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

std::filesystem::path settings_base() {
  return base("XDG_CONFIG_HOME", ".config");
}

std::filesystem::path cache_base() {
  return base("XDG_CACHE_HOME", ".cache");
}

std::filesystem::path home_folder() {
  return environment("HOME");
}

}  // namespace tyglab
