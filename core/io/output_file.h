// Writes every output under a temporary name and renames it once it is complete.
#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/model/preset.h"

namespace tyglab {

/// The completeness of an output, which determines whether it takes its name.
enum class Reach {
  whole,      ///< takes its name, and the place of an older file
  stopped,    ///< complete in itself, but from interrupted work: takes its name unless an older file exists
  cut_short,  ///< an incomplete output: does not take its name
};

/// Called now and then while an output waits for a pipe without a reader or with a slow one; true ends the wait with an
/// OutputError.
void stop_waiting_outputs_when(Stop stop);

/// Throws OutputError, with a sentence that says what to do, unless an output of that name can be written: where it
/// names a folder, its folder is missing or closed, or a read-only file stands there. Nothing is touched.
void check_output(const std::filesystem::path& file);

/// The absolute path to which an output of that name goes, through links, including links to missing files.
std::filesystem::path output_place(const std::filesystem::path& file);

/// The file with the part of an output that was written before an interrupt; empty if there is none.
std::filesystem::path incomplete_file(const std::filesystem::path& file);

/// One output while it is written. A file grows beside its name as FILE.incomplete, so that an older file stays as it
/// is until the new one is whole, whatever ends the program. It then takes the older one's place with its permissions
/// and, where the system allows it, its owner; a new file gets those of the process (umask). Of a symbolic link the
/// file that it leads to is replaced; other hard links of a replaced file keep the older content. Standard output
/// ("-"), pipes and devices take the bytes as they come.
class OutputFile {
 public:
  enum class Order {
    front_to_back,
    any,  ///< earlier bytes are written again: standard output gets all at the end, and a pipe is refused
  };

  /// Throws OutputError; also where another program is writing the same output.
  explicit OutputFile(const std::filesystem::path& file, Order order = Order::front_to_back);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  /// Without end(): FILE.incomplete stays with what keep() covers, and is removed if that is nothing.
  ~OutputFile();

  /// Appends. Throws OutputError.
  void write(std::string_view bytes);
  /// Writes over earlier bytes (Order::any). Throws OutputError.
  void write_at(std::uint64_t offset, std::string_view bytes);
  /// Marks everything written so far as useful by itself: it is kept if the output ends here.
  void keep() { kept_ = size_; }
  /// No more is written. Throws OutputError; FILE.incomplete stays then, as far as keep() covers it.
  void end(Reach reach = Reach::whole);

  /// Where the bytes are: FILE once it has taken its name, FILE.incomplete otherwise; what was named, of a stream.
  std::filesystem::path path() const { return kind_ == Kind::beside ? beside_ : file_; }

 private:
  enum class Kind { standard_output, gathered, stream, beside, placed };

  [[noreturn]] void fail(int error) const;
  void open_stream(Order order);
  void open_beside();
  void put(std::uint64_t offset, std::string_view bytes);
  /// To standard output.
  void send(std::string_view bytes) const;
  void send_gathered();
  void take_place();

  std::filesystem::path file_;    ///< as it was named
  std::filesystem::path target_;  ///< where links lead
  std::filesystem::path beside_;
  Kind kind_ = Kind::standard_output;
  int descriptor_ = -1;
  std::uint64_t size_ = 0, kept_ = 0;  ///< bytes
};

// Files that are written completely or not at all.

/// A file could not be written.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Writes a file as a whole (OutputFile); "-" is a file's name here. Throws OutputError.
void write_atomically(const std::filesystem::path& file, std::string_view text);

// The destination of an output: a file, or standard output, written as "-".

/// Whether that name means standard output: "-", or "/dev/stdout", which would else be opened a second time.
bool is_standard_output(const std::filesystem::path& file);

/// Its name in a sentence: "standard output", or the file.
std::string output_name(const std::filesystem::path& file);

/// The sentence for an output that could not be written, with errno `error` (0: unknown).
std::string lost_output(const std::filesystem::path& file, int error);

/// Writes an output in one go (OutputFile). Returns where the bytes are. Throws OutputError.
std::filesystem::path write_output(const std::filesystem::path& file, std::string_view bytes,
                                   Reach reach = Reach::whole);

/// Flushes std::cout and stdout. Throws OutputError if any output was lost.
void flush_standard_output();

}  // namespace tyglab
