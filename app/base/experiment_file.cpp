#include "app/base/experiment_file.h"

#include <charconv>

#include "app/base/image.h"
#include "core/io/preset_io.h"

namespace tyglab {
namespace {

/// A line that says what the file is, and one with the size of its text in bytes, precede the packed text.
constexpr std::string_view head = "tyglab experiment\n";
constexpr std::uintmax_t most_packed = 32 << 20;
constexpr std::size_t most_text = 128 << 20;
constexpr double best_ratio = 1032;  // of deflate

std::string packed_text(const std::string& text) {
  return std::string(head) + std::to_string(text.size()) + "\n" + packed(text);
}

}  // namespace

bool is_experiment(const std::filesystem::path& file) {
  return file.extension() == ".tyglab";
}

std::string experiment_bytes(const Experiment& experiment) {
  return packed_text(experiment_text(experiment));
}

Experiment experiment_from(std::string_view bytes, std::string_view source) {
  const auto fail = [&](const std::string& why) -> void { throw PresetError(std::string(source) + ": " + why); };
  if (bytes.starts_with("{")) return parse_experiment(bytes, source);
  if (!bytes.starts_with(head)) fail("is not an experiment of Tyglab");
  bytes.remove_prefix(head.size());
  std::size_t size = 0;
  const auto [end, error] = std::from_chars(bytes.data(), bytes.data() + bytes.size(), size);
  if (error != std::errc() || end == bytes.data() + bytes.size() || *end != '\n') fail("is damaged or cut short");
  bytes.remove_prefix(std::size_t(end - bytes.data()) + 1);
  if (size > most_text) fail("is too large: its text has more than 128 MiB");
  // No memory is taken for what cannot be in it.
  if (double(size) > best_ratio * double(bytes.size()) + 64) fail("is damaged or cut short");
  const auto text = unpacked(bytes, size);
  if (!text || text->size() != size) fail("is damaged or cut short");
  return parse_experiment(*text, source);
}

Experiment load_experiment(const std::filesystem::path& file) {
  try {
    return experiment_from(read_input(file, "experiment", most_packed), file.string());
  } catch (const InputError& error) {
    throw PresetError(error.what());
  }
}

std::filesystem::path save_experiment(const Experiment& experiment, const std::filesystem::path& file, Reach reach) {
  const std::string text = experiment_text(experiment);
  const std::string bytes = text.size() <= most_text ? packed_text(text) : "";
  if (bytes.empty() || bytes.size() > most_packed)
    throw OutputError("The experiment " + file.string() +
                      " is not written: it would be larger than what Tyglab reads, 32 MiB, or 128 MiB of text.");
  return write_output(file, bytes, reach);
}

}  // namespace tyglab
