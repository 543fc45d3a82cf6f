
#include "core/io/system_files.h"

#include <fcntl.h>
#include <io.h>
#include <sys/stat.h>
#include <windows.h>
#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <thread>

namespace tyglab::os {

namespace fs = std::filesystem;

const std::size_t pipe_portion = 4096;

namespace {

/// What a system call said, as errno.
void set_errno(DWORD error) {
  switch (error) {
    case ERROR_FILE_EXISTS:
    case ERROR_ALREADY_EXISTS:
      errno = EEXIST;
      break;
    case ERROR_FILE_NOT_FOUND:
    case ERROR_PATH_NOT_FOUND:
    case ERROR_INVALID_NAME:
    case ERROR_BAD_PATHNAME:
      errno = ENOENT;
      break;
    case ERROR_DISK_FULL:
    case ERROR_HANDLE_DISK_FULL:
      errno = ENOSPC;
      break;
    case ERROR_BROKEN_PIPE:
    case ERROR_NO_DATA:
      errno = EPIPE;
      break;
    default:
      errno = EACCES;
  }
}

/// Others may read, replace and remove it meanwhile; who writes says so by lock().
int open_file(const fs::path& file, DWORD access, DWORD how, DWORD flags = 0) {
  constexpr DWORD shared = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
  const HANDLE handle =
      ::CreateFileW(file.c_str(), access, shared, nullptr, how, FILE_ATTRIBUTE_NORMAL | flags, nullptr);
  if (handle == INVALID_HANDLE_VALUE) return set_errno(::GetLastError()), -1;
  const int descriptor = ::_open_osfhandle(reinterpret_cast<std::intptr_t>(handle),
                                           _O_BINARY | _O_NOINHERIT | ((access & GENERIC_WRITE) != 0 ? 0 : _O_RDONLY));
  if (descriptor < 0) ::CloseHandle(handle);
  return descriptor;
}

HANDLE handle_of(int descriptor) {
  return reinterpret_cast<HANDLE>(::_get_osfhandle(descriptor));
}

FileFacts facts_in(const struct _stat64& status) {
  return {.regular = (status.st_mode & _S_IFMT) == _S_IFREG,
          .folder = (status.st_mode & _S_IFMT) == _S_IFDIR,
          .size = std::uintmax_t(status.st_size),
          .mode = status.st_mode & 0777u};
}

/// One call takes and gives a whole number of type unsigned.
unsigned portion(std::size_t bytes) {
  return unsigned(std::min<std::size_t>(bytes, std::size_t(1) << 30));
}

bool same_file(HANDLE a, HANDLE b) {
  BY_HANDLE_FILE_INFORMATION of_a{}, of_b{};
  return ::GetFileInformationByHandle(a, &of_a) != 0 && ::GetFileInformationByHandle(b, &of_b) != 0 &&
         of_a.dwVolumeSerialNumber == of_b.dwVolumeSerialNumber && of_a.nFileIndexHigh == of_b.nFileIndexHigh &&
         of_a.nFileIndexLow == of_b.nFileIndexLow;
}

/// A call that others can be in the way of for a moment, such as virus scanners that read what is new.
template <typename Call>
bool repeated(const Call& call) {
  constexpr int most = 20, moment = 10;  // ms
  for (int n = 0; n < most; ++n) {
    if (call() != 0) return true;
    const DWORD error = ::GetLastError();
    set_errno(error);
    if (error != ERROR_SHARING_VIOLATION && error != ERROR_ACCESS_DENIED && error != ERROR_LOCK_VIOLATION) return false;
    ::Sleep(moment);
  }
  return false;
}

}  // namespace

std::optional<FileFacts> facts_of(const fs::path& file) {
  struct _stat64 status = {};
  return ::_wstat64(file.c_str(), &status) == 0 ? std::optional(facts_in(status)) : std::nullopt;
}

std::optional<FileFacts> facts_of(int descriptor) {
  struct _stat64 status = {};
  return ::_fstat64(descriptor, &status) == 0 ? std::optional(facts_in(status)) : std::nullopt;
}

int open_to_read(const fs::path& file) {
  return open_file(file, GENERIC_READ, OPEN_EXISTING);
}

int open_new(const fs::path& file, bool) {  // it gets the permissions of its folder
  return open_file(file, GENERIC_READ | GENERIC_WRITE | DELETE, CREATE_NEW);
}

int open_present(const fs::path& file) {
  return open_file(file, GENERIC_READ | DELETE, OPEN_EXISTING, FILE_FLAG_OPEN_REPARSE_POINT);
}

int open_stream(const fs::path& file) {
  return open_file(file, GENERIC_WRITE, OPEN_EXISTING);
}

fs::path temporary_folder() {
  std::error_code error;
  return fs::temp_directory_path(error);
}

int open_temporary() {
  const fs::path folder = temporary_folder();
  for (unsigned n = 0; n < 1000; ++n) {
    const fs::path file = folder / ("tyglab-" + std::to_string(::GetCurrentProcessId()) + "-" + std::to_string(n));
    const int opened = open_file(file, GENERIC_READ | GENERIC_WRITE | DELETE, CREATE_NEW, FILE_FLAG_DELETE_ON_CLOSE);
    if (opened >= 0 || errno != EEXIST) return opened;
  }
  return -1;
}

void close(int descriptor) {
  ::_close(descriptor);
}

bool close_written(int descriptor) {
  return ::_close(descriptor) == 0;
}

bool arrived(int) {
  return true;  // what is written is given room at once
}

std::int64_t read(int descriptor, char* bytes, std::size_t most) {
  return ::_read(descriptor, bytes, portion(most));
}

std::int64_t read_at(int descriptor, char* bytes, std::size_t most, std::uint64_t offset) {
  return ::_lseeki64(descriptor, std::int64_t(offset), SEEK_SET) < 0 ? -1 : read(descriptor, bytes, most);
}

std::int64_t write(int descriptor, const char* bytes, std::size_t count) {
  return ::_write(descriptor, bytes, portion(count));
}

std::int64_t write_at(int descriptor, const char* bytes, std::size_t count, std::uint64_t offset) {
  return ::_lseeki64(descriptor, std::int64_t(offset), SEEK_SET) < 0 ? -1 : write(descriptor, bytes, count);
}

void truncate(int descriptor, std::uint64_t size) {
  ::_chsize_s(descriptor, std::int64_t(size));
}

bool can_seek(int descriptor) {
  return ::GetFileType(handle_of(descriptor)) == FILE_TYPE_DISK;
}

bool lock(int descriptor) {
  // A byte far behind all others, since nobody else may read what is locked.
  OVERLAPPED place = {};
  place.OffsetHigh = 0x40000000;
  if (::LockFileEx(handle_of(descriptor), LOCKFILE_EXCLUSIVE_LOCK | LOCKFILE_FAIL_IMMEDIATELY, 0, 1, 0, &place) != 0)
    return true;
  const DWORD error = ::GetLastError();
  return error != ERROR_LOCK_VIOLATION && error != ERROR_IO_PENDING;
}

bool names(const fs::path& file, int descriptor) {
  const int by_name = open_file(file, 0, OPEN_EXISTING, FILE_FLAG_OPEN_REPARSE_POINT);
  if (by_name < 0) return false;
  const bool same = same_file(handle_of(by_name), handle_of(descriptor));
  ::_close(by_name);
  return same;
}

void adopt(int, const FileFacts&) {}  // permissions are those of the folder

bool unlink(const fs::path& file) {
  return repeated([&] { return ::DeleteFileW(file.c_str()); });
}

bool rename(const fs::path& from, const fs::path& to) {
  return repeated([&] { return ::MoveFileExW(from.c_str(), to.c_str(), MOVEFILE_REPLACE_EXISTING); });
}

bool is_stream(const fs::path& file) {
  if (file.native().starts_with(L"\\\\.\\")) return true;
  std::error_code error;
  return fs::exists(file, error) && !fs::is_regular_file(file, error);
}

bool may_write(const fs::path& file) {
  constexpr int write = 2;
  return ::_waccess(file.c_str(), write) == 0;
}

bool may_write_into(const fs::path& folder) {
  // The attribute "read-only" of a folder means something else, and permissions are known by trying alone.
  constexpr DWORD flags = FILE_FLAG_BACKUP_SEMANTICS, shared = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
  const HANDLE handle = ::CreateFileW(folder.c_str(), FILE_ADD_FILE, shared, nullptr, OPEN_EXISTING, flags, nullptr);
  if (handle == INVALID_HANDLE_VALUE) return false;
  ::CloseHandle(handle);
  return true;
}

bool takes_bytes_within(int milliseconds, int descriptor) {
  if (descriptor >= 0) return true;  // to write is to wait
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
  return false;
}

bool output_has_no_reader() {
  return false;  // a write says so
}

bool is_terminal(int descriptor) {
  DWORD mode = 0;
  return ::GetConsoleMode(handle_of(descriptor), &mode) != 0;
}

}  // namespace tyglab::os

namespace tyglab {

std::string environment(const char* name) {
  const wchar_t* value = ::_wgetenv(std::filesystem::path(name).c_str());
  return value != nullptr ? std::filesystem::path(value).string() : std::string();
}

std::filesystem::path settings_base() {
  return environment("APPDATA");
}

std::filesystem::path cache_base() {
  return environment("LOCALAPPDATA");
}

std::filesystem::path home_folder() {
  return environment("USERPROFILE");
}

}  // namespace tyglab
