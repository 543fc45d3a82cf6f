#include "core/io/preset_io.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "core/io/system_files.h"

namespace tyglab {
namespace {

/// A descriptor that closes itself.
struct Opened {
  explicit Opened(const std::filesystem::path& file) : descriptor(os::open_to_read(file)) {}
  ~Opened() {
    if (descriptor >= 0) os::close(descriptor);
  }
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;
  const int descriptor;
};

std::string in_mebibytes(std::uintmax_t bytes) {
  return std::to_string(bytes >> 20) + " MiB";
}

}  // namespace

std::string read_input(const std::filesystem::path& file, const std::string& kind, std::uintmax_t most_bytes) {
  const auto refuse = [&](const std::string& why) { throw InputError(file.string() + ": " + why); };
  const auto check = [&](const os::FileFacts& facts) {
    if (facts.folder) refuse("is a folder; name a file in it");
    if (!facts.regular) refuse("is not a file, so it cannot be read as a " + kind);
    if (facts.size > most_bytes) refuse("too large for a " + kind + " (" + in_mebibytes(most_bytes) + " at most)");
  };
  // Asked by its name first: to open some devices is to do something to them.
  auto facts = os::facts_of(file);
  if (!facts)
    refuse(errno == ENOENT || errno == ENOTDIR ? "there is no such file"
                                               : std::string("cannot be read: ") + std::strerror(errno));
  check(*facts);
  const Opened opened(file);
  if (opened.descriptor >= 0) facts = os::facts_of(opened.descriptor);
  if (opened.descriptor < 0 || !facts) refuse("cannot be read; check its permissions");
  check(*facts);
  // Nor is more read than that of a file that grows, or that tells no size, as those of /proc.
  std::string text;
  constexpr std::size_t portion = 1 << 16;
  while (text.size() <= most_bytes) {
    const std::size_t before = text.size();
    text.resize(before + portion);
    const std::int64_t n = os::read(opened.descriptor, text.data() + before, portion);
    text.resize(before + std::size_t(std::max<std::int64_t>(n, 0)));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) refuse(std::string("cannot be read: ") + std::strerror(errno));
    if (n == 0) return text;
  }
  refuse("too large for a " + kind + " (" + in_mebibytes(most_bytes) + " at most)");
  return {};
}

}  // namespace tyglab
