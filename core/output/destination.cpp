#include "core/output/destination.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>

#include "core/notation/preset_io.h"

namespace tyglab {

bool is_standard_output(const std::filesystem::path& file) {
  return file == "-" || file == "/dev/stdout";
}

std::string output_name(const std::filesystem::path& file) {
  return is_standard_output(file) ? "standard output" : file.string();
}

void write_output(const std::filesystem::path& file, std::string_view bytes) {
  if (!is_standard_output(file)) return write_atomically(file, bytes);
  std::cout.write(bytes.data(), std::streamsize(bytes.size()));
  flush_standard_output();
}

void flush_standard_output() {
  errno = 0;
  std::cout.flush();
  std::fflush(stdout);
  if (std::cout.good() && std::ferror(stdout) == 0) return;
  // An earlier write may be the one that failed: then errno says nothing of it.
  const std::string why = errno != 0 ? std::string(": ") + std::strerror(errno) : std::string();
  throw OutputError("standard output: cannot be written" + why + "; send it elsewhere, or make room");
}

}  // namespace tyglab
