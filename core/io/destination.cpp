#include "core/io/destination.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <utility>

#include "core/io/files.h"
#include "core/io/system_files.h"
#include "core/io/terminal.h"

namespace tyglab {

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

}  // namespace tyglab
