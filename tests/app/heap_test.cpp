// Large blocks of memory go back to the system, however often they are needed.
#include "app/process/process.h"

#include <doctest/doctest.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <vector>

#include "tests/support/sanitized.h"
#include "tests/support/skip.h"

namespace tyglab::heap_test {

#ifdef __GLIBC__
/// Bytes of blocks that stand for themselves, not in the heap.
std::size_t mapped() {
  return mallinfo2().hblkhd;
}

TEST_CASE("a large block stands for itself, also when one of its size was freed before") {
  if (test::sanitized) return test::skip("the sanitizers bring a heap of their own", test::Missing::of_machine);
  return_large_blocks();
  const std::size_t before = mapped();
  // Earlier tests may have left holes of that size in the heap: they are filled first.
  std::vector<std::vector<char>> blocks;
  while (mapped() == before && blocks.size() < 32) blocks.emplace_back(2 * large_block);
  blocks.pop_back();
  for (int n = 0; n < 3; ++n) {
    CAPTURE(n);
    const std::vector<char> block(2 * large_block);
    CHECK(mapped() >= before + block.size());
  }
  CHECK(mapped() == before);
}
#endif

}  // namespace tyglab::heap_test
