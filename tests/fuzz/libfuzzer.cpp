// Clang's libFuzzer over one of the targets, which TYGLAB_FUZZ names. Without a target it lists them; with
// TYGLAB_FUZZ_SEEDS=FOLDER it writes the target's seeds there instead of fuzzing. tests/fuzz/run does all of it.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/fuzz/targets.h"

namespace {

const tyglab::fuzz::Target* chosen = nullptr;

void choose(const char* name) {
  for (const tyglab::fuzz::Target& target : tyglab::fuzz::targets()) {
    if (name == nullptr) std::printf("%s\n", std::string(target.name).c_str());
    if (name != nullptr && target.name == name) chosen = &target;
  }
  if (chosen == nullptr) std::exit(name == nullptr ? 0 : 2);
}

void write_seeds(const std::filesystem::path& folder) {
  int number = 0;
  for (const std::string& seed : chosen->seeds())
    std::ofstream(folder / ("seed" + std::to_string(number++)), std::ios::binary) << seed;
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  choose(std::getenv("TYGLAB_FUZZ"));
  if (const char* folder = std::getenv("TYGLAB_FUZZ_SEEDS"); folder != nullptr) write_seeds(folder), std::exit(0);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  chosen->read({reinterpret_cast<const char*>(data), size});
  return 0;
}
