#include "tests/support/places.h"

namespace tyglab::test {

const char* const source_dir = TYGLAB_SOURCE_DIR;
const char* const binary = TYGLAB_BINARY;
const char* const assimp = TYGLAB_ASSIMP;

}  // namespace tyglab::test
