// --size WxH: the size of pictures and of the window.
#pragma once

#include <string>

#include "app/cli/film.h"

namespace tyglab {

/// "1280x720". Throws UsageError naming the option unless it is at least that large, and no side over 8192 pixels.
PictureSize parse_size(const std::string& text, PictureSize least);

}  // namespace tyglab
