#include "app/cli/size_option.h"

#include <algorithm>
#include <charconv>

#include "app/cli/command_line.h"

namespace tyglab {

PictureSize parse_size(const std::string& text, PictureSize least) {
  constexpr int most = 8192;
  PictureSize size;
  const char* end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width);
  const bool cross = width.ec == std::errc{} && width.ptr != end && *width.ptr == 'x';
  const auto height = std::from_chars(cross ? width.ptr + 1 : end, end, size.height);
  const bool whole = cross && height.ec == std::errc{} && height.ptr == end;
  if (!whole || size.width < least.width || size.height < least.height || std::max(size.width, size.height) > most)
    throw UsageError("--size " + text + ": must be WIDTHxHEIGHT in pixels, such as 1280x720; at least " +
                     std::to_string(least.width) + "x" + std::to_string(least.height) + ", and each at most " +
                     std::to_string(most));
  return size;
}

}  // namespace tyglab
