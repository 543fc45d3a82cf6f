// Controls how the C library's heap returns memory.
#pragma once

#include <cstddef>

namespace tyglab {

/// From this size on a block is returned to the system as soon as it is freed.
inline constexpr std::size_t large_block = std::size_t(4) << 20;

/// Keeps it so for the rest of the process, where the C library is glibc. By itself that raises its limit to the size
/// of the largest block that was freed, up to 32 MB, and puts later blocks of that size among the small ones: pictures
/// of fonts, arrays of cloths and studies then leave holes that small blocks fill, and a window that is used for
/// minutes keeps most of what it ever needed at once. To be called while there is one thread.
void return_large_blocks();

}  // namespace tyglab
