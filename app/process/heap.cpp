#include "app/process/process.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace tyglab {

void return_large_blocks() {
#ifdef __GLIBC__
  // A fixed limit of either kind ends the adjustment of both; without the second the heap's end would go up and down in
  // every frame.
  mallopt(M_MMAP_THRESHOLD, int(large_block));
  mallopt(M_TRIM_THRESHOLD, 2 * int(large_block));
#endif
}

}  // namespace tyglab
