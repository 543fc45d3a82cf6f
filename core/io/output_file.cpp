
#include "core/io/output_file.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <optional>
#include <thread>
#include <utility>

#include "core/io/system_files.h"
#include "core/io/terminal.h"

namespace tyglab {
namespace {

namespace fs = std::filesystem;

/// Where a link points in the end, whether that is there yet or not; a link still if they go round in a circle.
fs::path followed(fs::path file) {
  constexpr int most_links = 40;  // as many as Linux follows
  std::error_code error;
  for (int n = 0; n < most_links && fs::is_symlink(file, error); ++n)
    file = file.parent_path() / fs::read_symlink(file, error);
  return file;
}

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

Stop stop_waiting;

/// Waits until the descriptor takes bytes (-1: for no descriptor, a moment). Throws OutputError where somebody stops
/// it.
void wait_for_reader(const fs::path& file, int descriptor) {
  constexpr int moment = 50;  // ms
  while (!os::takes_bytes_within(moment, descriptor)) {
    if (stop_waiting && stop_waiting())
      throw OutputError(output_name(file) + ": it has no reader, so the output is lost");
    if (descriptor < 0) return;
  }
}

bool is_regular(int descriptor) {
  const auto facts = os::facts_of(descriptor);
  return facts && facts->regular;
}

/// What a file is called while it is written.
fs::path beside(fs::path target) {
  return target += ".incomplete";
}

/// Whether nobody else has it, who is given half a second. True too where the file system knows no locks.
bool locked(int descriptor) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::milliseconds(500);
  while (!os::lock(descriptor)) {
    if (Clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

}  // namespace

void stop_waiting_outputs_when(Stop stop) {
  stop_waiting = std::move(stop);
}

fs::path output_place(const fs::path& file) {
  std::error_code error;
  return fs::weakly_canonical(followed(fs::absolute(file, error)), error);
}

fs::path incomplete_file(const fs::path& file) {
  std::error_code error;
  if (file.empty() || os::is_stream(file)) return {};
  const fs::path part = beside(followed(file));
  return fs::is_regular_file(part, error) ? part : fs::path();
}

void check_output(const fs::path& file) {
  if (is_standard_output(file)) return;
  const auto refuse = [&](const std::string& why) { throw OutputError(file.string() + ": " + why); };
  std::error_code error;
  if (fs::is_directory(file, error)) refuse("is a folder; name a file in it");
  if (!file.has_filename()) refuse("is the name of a folder; name a file in it");
  if (os::is_stream(file)) {
    if (!os::may_write(file)) refuse("is not writable; choose another name");
    return;
  }
  const fs::path target = followed(file);
  if (fs::is_symlink(target, error)) refuse("is a link that leads back to itself; choose another name");
  const fs::path folder = folder_of(target);
  if (!fs::is_directory(folder, error))
    refuse("the folder " + folder.string() + " does not exist; create it first (mkdir -p)");
  if (!os::may_write_into(folder)) refuse("the folder " + folder.string() + " is not writable; choose another");
  // An administrator may write everything; a file that nobody may write is meant to stay all the same.
  constexpr unsigned any_write = 0222;
  if (const auto older = os::facts_of(target); older && ((older->mode & any_write) == 0 || !os::may_write(target)))
    refuse("is read-only, so it is not replaced; choose another name, or make it writable (chmod u+w)");
}

OutputFile::OutputFile(const fs::path& file, Order order) : file_(file) {
  check_output(file);
  if (is_standard_output(file)) {
    if (order == Order::front_to_back) return;
    kind_ = Kind::gathered;
    descriptor_ = os::open_temporary();
    if (descriptor_ < 0) fail(errno);
  } else if (os::is_stream(file)) {
    open_stream(order);
  } else {
    open_beside();
  }
}

void OutputFile::open_stream(Order order) {
  kind_ = Kind::stream;
  // A pipe without a reader is no error: one may come.
  while ((descriptor_ = os::open_stream(file_)) < 0) {
    if (errno != ENXIO) fail(errno);
    wait_for_reader(file_, -1);
  }
  if (order == Order::front_to_back || os::can_seek(descriptor_)) return;
  os::close(descriptor_);
  throw OutputError(file_.string() +
                    ": the beginning of this output is written last, so it cannot be piped; name "
                    "a file, or -");
}

void OutputFile::open_beside() {
  kind_ = Kind::beside;
  target_ = followed(file_);
  beside_ = target_;
  beside_ = beside(target_);
  const auto older = os::facts_of(target_);
  while (true) {
    // Nobody may read in the new file what nobody may read in the older one.
    const int made = os::open_new(beside_, older.has_value());
    if (made < 0 && errno != EEXIST) fail(errno);
    const int opened = made >= 0 ? made : os::open_present(beside_);
    if (opened < 0 && errno == ENOENT) continue;  // it has just taken its name
    const bool mine = opened >= 0 && locked(opened), still_there = mine && os::names(beside_, opened);
    if (made >= 0 && still_there) {
      descriptor_ = made;
      if (older) os::adopt(descriptor_, *older);
      return;
    }
    // What an earlier run left there, which nobody writes any more, makes room.
    const bool in_the_way = opened < 0 || (still_there && (!is_regular(opened) || !os::unlink(beside_)));
    if (opened >= 0) os::close(opened);
    if (in_the_way) throw OutputError(beside_.string() + ": blocks a new file; remove it, or choose another name");
    if (!mine)
      throw OutputError(file_.string() + ": another program is writing it; wait until it ends, or choose another name");
  }
}

OutputFile::~OutputFile() {
  if (kind_ == Kind::beside && descriptor_ >= 0) {
    if (kept_ == 0 && os::names(beside_, descriptor_)) os::unlink(beside_);
    // Without the part of a row that a full disk may leave.
    if (kept_ > 0 && kept_ < size_) os::truncate(descriptor_, kept_);
  }
  if (descriptor_ >= 0) os::close(descriptor_);
}

void OutputFile::fail(int error) const {
  if (kind_ == Kind::gathered)
    throw OutputError("standard output is collected in a temporary file in " + os::temporary_folder().string() +
                      ", which failed: " + std::strerror(error) + "; name a file instead of -");
  std::string what = lost_output(file_, error);
  if (kind_ == Kind::beside && kept_ > 0) what += "; what was complete before is kept in " + beside_.string();
  throw OutputError(what);
}

void OutputFile::put(std::uint64_t offset, std::string_view bytes) {
  while (!bytes.empty()) {
    const std::int64_t n = kind_ == Kind::stream && offset == size_
                               ? os::write(descriptor_, bytes.data(), bytes.size())
                               : os::write_at(descriptor_, bytes.data(), bytes.size(), offset);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0 && errno == EAGAIN) {
      wait_for_reader(file_, descriptor_);
      continue;
    }
    if (n <= 0) {
      size_ = std::max(size_, offset);
      fail(n < 0 ? errno : ENOSPC);
    }
    offset += std::uint64_t(n);
    bytes.remove_prefix(std::size_t(n));
    size_ = std::max(size_, offset);
  }
}

void OutputFile::write(std::string_view bytes) {
  if (kind_ != Kind::standard_output) return put(size_, bytes);
  send(bytes);
}

void OutputFile::write_at(std::uint64_t offset, std::string_view bytes) {
  put(offset, bytes);
}

void OutputFile::end(Reach reach) {
  if (kind_ == Kind::gathered) return send_gathered();
  if (kind_ == Kind::stream) {
    if (!os::close_written(std::exchange(descriptor_, -1))) fail(errno);
    return;
  }
  if (kind_ != Kind::beside) return;
  const bool stands = os::facts_of(target_).has_value();
  if (reach == Reach::whole || (reach == Reach::stopped && !stands)) return take_place();
  keep();
}

void OutputFile::send(std::string_view bytes) const {
  while (!bytes.empty()) {
    const std::string_view part = bytes.substr(0, os::pipe_portion);  // a pipe that takes bytes takes as many
    wait_for_reader(file_, os::standard_output);
    file_output().write(part.data(), std::streamsize(part.size()));
    flush_standard_output();
    bytes.remove_prefix(part.size());
  }
}

void OutputFile::send_gathered() {
  std::string part(std::size_t{1} << 20, '\0');
  for (std::uint64_t at = 0; at < size_;) {
    const std::int64_t n = os::read_at(descriptor_, part.data(), part.size(), at);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) fail(errno);
    send({part.data(), std::size_t(n)});
    at += std::uint64_t(n);
  }
}

void OutputFile::take_place() {
  check_output(file_);  // much may have happened since
  if (!os::names(beside_, descriptor_))
    throw OutputError(file_.string() + ": cannot be written: another program removed " + beside_.string());
  if (const auto older = os::facts_of(target_)) os::adopt(descriptor_, *older);
  if (!os::arrived(descriptor_)) fail(errno);
  if (!os::rename(beside_, target_)) fail(errno);
  kind_ = Kind::placed;
}

bool is_standard_output(const std::filesystem::path& file) {
  return file == "-" || file == "/dev/stdout";
}

std::string output_name(const std::filesystem::path& file) {
  return is_standard_output(file) ? "standard output" : in_one_line(file.string());
}

std::string lost_output(const std::filesystem::path& file, int error) {
  if (error == EPIPE || (error == 0 && is_standard_output(file) && os::output_has_no_reader()))
    return output_name(file) + ": its reader has closed it, so the rest of the output is lost";
  const std::string why = error != 0 ? std::string(": ") + std::strerror(error) : std::string();
  const std::string cure = error == ENAMETOOLONG ? "; choose a shorter name, to which .incomplete can be added"
                           : error == EFBIG  ? "; raise the limit of a file's size (ulimit -f), or write it elsewhere"
                           : error == ENOSPC ? "; free disk space, or write it elsewhere"
                                             : "; write it elsewhere";
  return output_name(file) + ": cannot be written" + why + cure;
}

std::filesystem::path write_output(const std::filesystem::path& file, std::string_view bytes, Reach reach) {
  OutputFile out(file);
  out.write(bytes);
  std::filesystem::path named = file;  // with its memory, before an older file is replaced
  out.end(reach);
  return reach == Reach::whole ? std::move(named) : out.path();
}

void flush_standard_output() {
  errno = 0;
  file_output().flush();
  std::cout.flush();
  std::fflush(stdout);
  if (file_output().good() && std::cout.good() && std::ferror(stdout) == 0) return;
  // An earlier write may be the one that failed: then errno says nothing of it.
  throw OutputError(lost_output("-", errno));
}

void write_atomically(const std::filesystem::path& file, std::string_view text) {
  write_output(file == "-" ? "./-" : file, text);
}

}  // namespace tyglab
