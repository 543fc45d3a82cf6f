#include "core/io/files.h"

#include "core/io/destination.h"

namespace tyglab {

void write_atomically(const std::filesystem::path& file, std::string_view text) {
  write_output(file == "-" ? "./-" : file, text);
}

}  // namespace tyglab
