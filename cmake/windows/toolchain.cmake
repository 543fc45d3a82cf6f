# Tyglab for 64-bit Windows, by Debian's MinGW-w64 with its threads of C++ (the posix model). Libraries come from the
# folder TYGLAB_WINDOWS_LIBRARIES, which cmake/windows/libraries fills.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(prefix x86_64-w64-mingw32)
set(CMAKE_C_COMPILER ${prefix}-gcc-posix)
set(CMAKE_CXX_COMPILER ${prefix}-g++-posix)
set(CMAKE_RC_COMPILER ${prefix}-windres)

list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES TYGLAB_WINDOWS_LIBRARIES)
set(CMAKE_FIND_ROOT_PATH ${TYGLAB_WINDOWS_LIBRARIES} /usr/${prefix})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(ENV{PKG_CONFIG_LIBDIR} ${TYGLAB_WINDOWS_LIBRARIES}/lib/pkgconfig)

# The stack of 64-bit Windows is aligned to 16 bytes, and GCC spills vectors of 32 and 64 to it as if it were aligned to
# those (its bug 54412): the assembler writes the moves that need no alignment, which are as fast. Paths of this machine
# stay out of what is built.
string(CONCAT flags "-Wa,-muse-unaligned-vector-move -D_WIN32_WINNT=0x0A00 "
       "-ffile-prefix-map=${TYGLAB_WINDOWS_LIBRARIES}=libraries")
set(CMAKE_C_FLAGS_INIT "${flags}")
set(CMAKE_CXX_FLAGS_INIT "${flags}")
# One file, without libraries beside it, and without the time of the build in it.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static -Wl,--no-insert-timestamp")
