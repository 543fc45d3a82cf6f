#include "app/platform/headless_context.h"

#include "app/render/graphics_error.h"

namespace tyglab {

HeadlessContext::HeadlessContext() {
  throw GraphicsError("Images without a window cannot be drawn in this edition; open the page, or use the desktop's");
}

HeadlessContext::~HeadlessContext() = default;

}  // namespace tyglab
