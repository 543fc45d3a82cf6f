// File operations that differ between POSIX and Windows, and only those. output_file.cpp and input_file.cpp determine
// what is written and read with them, and in which order.
//
// Functions that can fail return -1 or false, and leave the reason in errno.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace tyglab::os {

/// Facts about a file that is not open.
struct FileFacts {
  bool regular = false, folder = false;
  std::uintmax_t size = 0;             ///< bytes
  unsigned mode = 0;                   ///< permissions, as POSIX writes them: 0644
  std::uint64_t owner = 0, group = 0;  ///< 0 on Windows
};

/// Of the file that the name leads to; nothing (with errno) if it cannot be asked.
std::optional<FileFacts> facts_of(const std::filesystem::path& file);
/// Of an open file.
std::optional<FileFacts> facts_of(int descriptor);

/// Opens a file to be read, without waiting for anybody.
int open_to_read(const std::filesystem::path& file);
/// Opens a new file to be read and written; fails with EEXIST if the name is taken. `closed`: for its owner alone.
int open_new(const std::filesystem::path& file, bool closed);
/// Opens the file of that name, but does not follow a link.
int open_present(const std::filesystem::path& file);
/// Opens a pipe or a device to be written; fails with ENXIO where a pipe has no reader yet.
int open_stream(const std::filesystem::path& file);
/// Opens a file without a name, which is gone once it is closed.
int open_temporary();
/// Where that file takes up space.
std::filesystem::path temporary_folder();
void close(int descriptor);
/// Closes it; false if what was written did not arrive.
bool close_written(int descriptor);
/// Whether everything written has arrived, as far as the file system reports. The file stays open and locked.
bool arrived(int descriptor);

/// Bytes that were read: 0 at the end.
std::int64_t read(int descriptor, char* bytes, std::size_t most);
std::int64_t read_at(int descriptor, char* bytes, std::size_t most, std::uint64_t offset);
/// Bytes that were written, which may be fewer.
std::int64_t write(int descriptor, const char* bytes, std::size_t count);
std::int64_t write_at(int descriptor, const char* bytes, std::size_t count, std::uint64_t offset);
void truncate(int descriptor, std::uint64_t size);
bool can_seek(int descriptor);

/// Whether this process has locked the file, or the file system has no locks. The lock lasts until the file is closed.
bool lock(int descriptor);
/// Whether that name still belongs to the open file of the descriptor.
bool names(const std::filesystem::path& file, int descriptor);
/// Gives a new file the owner and the permissions of an older one, as far as the system allows.
void adopt(int descriptor, const FileFacts& older);
/// Removes a name.
bool unlink(const std::filesystem::path& file);
/// Gives an open file its name, in the place of the file that has it.
bool rename(const std::filesystem::path& from, const std::filesystem::path& to);

/// Whether it accepts bytes as they come: a pipe, a device, or a file that a shell has opened (/dev/fd/3).
bool is_stream(const std::filesystem::path& file);
/// Whether this process may write the file, or make files in the folder.
bool may_write(const std::filesystem::path& file);
bool may_write_into(const std::filesystem::path& folder);

/// Whether a descriptor takes bytes within that time; of -1, which takes none, the wait alone.
bool takes_bytes_within(int milliseconds, int descriptor);
/// Whether the pipe that standard output is has lost its reader.
bool output_has_no_reader();

inline constexpr int standard_output = 1, standard_error = 2;  ///< descriptors
bool is_terminal(int descriptor);
/// Bytes that a pipe takes whole once it takes any.
extern const std::size_t pipe_portion;

}  // namespace tyglab::os

// The user's folders, and the environment variables that set them.

namespace tyglab {

/// A variable of the environment, in UTF-8; empty if it is not there.
std::string environment(const char* name);

/// The folder of settings: XDG_CONFIG_HOME or ~/.config; on Windows %APPDATA%. Empty: nowhere.
std::filesystem::path settings_base();
/// The folder of caches: XDG_CACHE_HOME or ~/.cache; on Windows %LOCALAPPDATA%. Empty: nowhere.
std::filesystem::path cache_base();
/// HOME; on Windows %USERPROFILE%. Empty if it is not known.
std::filesystem::path home_folder();

}  // namespace tyglab
