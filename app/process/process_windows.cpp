#include "app/process/process.h"

#include <fcntl.h>
#include <io.h>
#include <windows.h>
// After windows.h, which it needs.
#include <shellapi.h>

#include <cstdio>
#include <filesystem>
#include <memory>

namespace tyglab {

void secure_standard_streams() {
  // Files are written as they are: what is printed has the same bytes on every system.
  for (std::FILE* const stream : {stdin, stdout, stderr}) {
    const int descriptor = ::_fileno(stream);
    if (descriptor >= 0) ::_setmode(descriptor, _O_BINARY);
  }
  ::SetConsoleOutputCP(CP_UTF8);
  ::SetConsoleCP(CP_UTF8);
}

std::vector<std::string> program_arguments(int, char**) {
  int count = 0;
  const std::unique_ptr<wchar_t*, decltype(&::LocalFree)> words(::CommandLineToArgvW(::GetCommandLineW(), &count),
                                                                ::LocalFree);
  std::vector<std::string> arguments;
  for (int n = 1; n < count; ++n) arguments.push_back(std::filesystem::path(words.get()[n]).string());
  return arguments;
}

bool display_is_named() {
  return true;
}

void lower_thread_priority() {
  ::SetThreadPriority(::GetCurrentThread(), THREAD_PRIORITY_LOWEST);
}

void end_at_once(std::string_view sentence, int exit_code) {
  DWORD written = 0;
  ::WriteFile(::GetStdHandle(STD_ERROR_HANDLE), sentence.data(), DWORD(sentence.size()), &written, nullptr);
  ::TerminateProcess(::GetCurrentProcess(), unsigned(exit_code));
  std::terminate();
}

}  // namespace tyglab
