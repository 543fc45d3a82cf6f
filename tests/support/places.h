// Where the tests find things. Paths stand in one object file, so that the compiler's cache serves every checkout.
#pragma once

namespace tyglab::test {

extern const char* const source_dir;  ///< top of the source tree
extern const char* const binary;      ///< the built tyglab
extern const char* const assimp;      ///< an independent reader of OBJ files

}  // namespace tyglab::test
