#include "app/process/program_run.h"

#include <io.h>
#include <windows.h>

#include <algorithm>
#include <filesystem>

#include "core/io/system_files.h"

namespace tyglab {
namespace {

/// A file in memory or on disk that a child may use, and that is gone once it is closed.
class SharedFile {
 public:
  SharedFile() : descriptor_(os::open_temporary()) {
    if (descriptor_ >= 0) ::SetHandleInformation(handle(), HANDLE_FLAG_INHERIT, HANDLE_FLAG_INHERIT);
  }
  ~SharedFile() {
    if (descriptor_ >= 0) os::close(descriptor_);
  }
  SharedFile(const SharedFile&) = delete;
  SharedFile& operator=(const SharedFile&) = delete;
  HANDLE handle() const { return reinterpret_cast<HANDLE>(::_get_osfhandle(descriptor_)); }
  void fill(const std::string& text) const {
    os::write(descriptor_, text.data(), text.size());
    ::_lseeki64(descriptor_, 0, SEEK_SET);
  }
  std::string text() const {
    std::string bytes(65536, '\0');
    bytes.resize(std::size_t(std::max<std::int64_t>(os::read_at(descriptor_, bytes.data(), bytes.size(), 0), 0)));
    return bytes;
  }

 private:
  int descriptor_;
};

/// An argument as a program finds it again in its command line.
std::wstring quoted(const std::string& argument) {
  std::wstring words = L"\"";
  std::size_t slashes = 0;
  for (const wchar_t letter : std::filesystem::path(argument).native()) {
    // Before a quotation mark, and at the end, a backslash stands for itself only when it is doubled.
    if (letter == L'"') words.append(slashes + 1, L'\\');
    slashes = letter == L'\\' ? slashes + 1 : 0;
    words += letter;
  }
  return words.append(slashes, L'\\') + L'"';
}

}  // namespace

ProgramExit run_program(const std::string& path, std::vector<std::string> arguments, const ProgramOptions& options) {
  std::wstring line;
  for (const std::string& argument : arguments) line += (line.empty() ? L"" : L" ") + quoted(argument);
  const SharedFile input, output;
  input.fill(options.input);
  STARTUPINFOW start = {};
  start.cb = sizeof start, start.dwFlags = STARTF_USESTDHANDLES;
  start.hStdInput = input.handle(), start.hStdOutput = start.hStdError = output.handle();
  PROCESS_INFORMATION process = {};
  ProgramExit exit;
  const std::filesystem::path file(path);
  // Without a dialog of the system if it crashes.
  ::SetErrorMode(SEM_FAILCRITICALERRORS | SEM_NOGPFAULTERRORBOX);
  if (::CreateProcessW(file.c_str(), line.data(), nullptr, nullptr, TRUE, CREATE_NO_WINDOW, nullptr, nullptr, &start,
                       &process) == 0)
    return exit;
  const DWORD most = options.most_seconds > 0 ? DWORD(1e3 * options.most_seconds) : INFINITE;
  exit.timed_out = ::WaitForSingleObject(process.hProcess, most) == WAIT_TIMEOUT;
  if (exit.timed_out) ::TerminateProcess(process.hProcess, 1);
  ::WaitForSingleObject(process.hProcess, INFINITE);
  DWORD code = 0;
  ::GetExitCodeProcess(process.hProcess, &code);
  constexpr DWORD exceptions = 0xC0000000;
  if (code >= exceptions)
    exit.signal = int(code);
  else if (!exit.timed_out)
    exit.code = int(code);
  ::CloseHandle(process.hThread), ::CloseHandle(process.hProcess);
  exit.output = output.text();
  return exit;
}

}  // namespace tyglab
