#include <windows.h>

#include <array>
#include <bit>
#include <filesystem>

#include "core/analysis/machine.h"

namespace tyglab {

std::string processor_name() {
  std::array<wchar_t, 256> name{};
  auto bytes = DWORD(sizeof(wchar_t) * (name.size() - 1));
  const auto* key = L"HARDWARE\\DESCRIPTION\\System\\CentralProcessor\\0";
  if (::RegGetValueW(HKEY_LOCAL_MACHINE, key, L"ProcessorNameString", RRF_RT_REG_SZ, nullptr, name.data(), &bytes) != 0)
    return "unknown processor";
  return std::filesystem::path(name.data()).string();
}

int processors() {
  // Of the process's group, which has up to 64.
  DWORD_PTR own = 0, all = 0;
  return ::GetProcessAffinityMask(::GetCurrentProcess(), &own, &all) != 0 && own != 0 ? std::popcount(own) : 1;
}

}  // namespace tyglab
