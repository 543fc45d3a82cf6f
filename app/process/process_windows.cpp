
#include "app/process/process.h"

#include <fcntl.h>
#include <io.h>
#include <shellapi.h>
#include <windows.h>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <memory>
#include <sstream>

// Last, since it needs the other.

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

namespace {

std::ostringstream* last_words = nullptr;  ///< since the console was left

/// Whether what is printed is lost: without a console, or with one that was made for this program alone.
bool has_no_reader() {
  const HANDLE error = ::GetStdHandle(STD_ERROR_HANDLE);
  if (error == nullptr || error == INVALID_HANDLE_VALUE) return true;
  DWORD mode = 0, processes[2] = {};
  return ::GetConsoleMode(error, &mode) != 0 && ::GetConsoleProcessList(processes, 2) == 1;
}

}  // namespace

void leave_own_console() {
  if (last_words != nullptr || !has_no_reader()) return;
  ::FreeConsole();
  last_words = new std::ostringstream;  // until the process ends, as std::cerr
  std::cerr.rdbuf(last_words->rdbuf());
}

void show_last_words(int exit_code) {
  if (exit_code == 0 || last_words == nullptr || last_words->str().empty()) return;
  const std::wstring words = std::filesystem::path(last_words->str()).native();
  ::MessageBoxW(nullptr, words.c_str(), L"Tyglab", MB_OK | MB_ICONERROR);
}

void end_at_once(std::string_view sentence, int exit_code) {
  DWORD written = 0;
  ::WriteFile(::GetStdHandle(STD_ERROR_HANDLE), sentence.data(), DWORD(sentence.size()), &written, nullptr);
  ::TerminateProcess(::GetCurrentProcess(), unsigned(exit_code));
  std::terminate();
}

// There is no such limit.
std::string memory_limit_words() {
  return {};
}

CrashExplainer::CrashExplainer() = default;
CrashExplainer::~CrashExplainer() = default;

void leave_crashes_to_parent() {}

}  // namespace tyglab
