// The destination of an output: a file, or standard output, written as "-".
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/io/files.h"
#include "core/io/output_file.h"

namespace tyglab {

/// Whether that name means standard output: "-", or "/dev/stdout", which would else be opened a second time.
bool is_standard_output(const std::filesystem::path& file);

/// What to call it in a sentence: "standard output", or the file.
std::string output_name(const std::filesystem::path& file);

/// What to say of an output that could not be written, errno being `error` (0: not known).
std::string lost_output(const std::filesystem::path& file, int error);

/// Writes an output in one go (OutputFile). Returns where the bytes are. Throws OutputError.
std::filesystem::path write_output(const std::filesystem::path& file, std::string_view bytes,
                                   Reach reach = Reach::whole);

/// Sends what std::cout and stdout still hold on its way. Throws OutputError if any of it was lost.
void flush_standard_output();

}  // namespace tyglab
