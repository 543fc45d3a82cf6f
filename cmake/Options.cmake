# Compiler options of the project's own code, as one interface target.
add_library(tyglab_options INTERFACE)
target_compile_options(tyglab_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
                       $<$<COMPILE_LANGUAGE:CXX>:-Wnon-virtual-dtor -Woverloaded-virtual>)
# Contraction of a*b+c into one rounding would make results depend on the instruction set and on inlining.
target_compile_options(tyglab_options INTERFACE -ffp-contract=off)
# Neither errno nor floating-point traps are looked at: without them square roots and selects vectorise.
target_compile_options(tyglab_options INTERFACE -fno-math-errno -fno-trapping-math)
# GCC warns falsely about std::string concatenation (its bug 105651, GCC 12) and about the members of a std::variant
# that it does not hold (GCC 14).
target_compile_options(tyglab_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict;-Wno-maybe-uninitialized>)
# Clang sees names of other files of a batch (TYGLAB_BATCHES) as hidden, and std::stable_sort of GCC 12's library calls
# what that library itself deprecates; on 32 bits sizes of files are longer than others.
target_compile_options(tyglab_options INTERFACE $<$<CXX_COMPILER_ID:Clang>:-Wno-shadow;-Wno-deprecated-declarations>)
if("web" IN_LIST TYGLAB_PLATFORM)
  target_compile_options(tyglab_options INTERFACE -Wno-shorten-64-to-32)
endif()
# GCC's own memory is looked through for garbage less often: a tenth of its time, for 200 MB more of memory.
target_compile_options(tyglab_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=524288>)
# Names of files in objects are relative, so that the compiler's cache serves every checkout.
target_compile_options(tyglab_options INTERFACE -ffile-prefix-map=${PROJECT_SOURCE_DIR}=.)
# The version, in a header of its own: a new version recompiles only the few files that print it.
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/tyglab_version.h
     CONTENT "#pragma once\n#define TYGLAB_VERSION \"${PROJECT_VERSION}\"\n")
target_include_directories(tyglab_options INTERFACE ${PROJECT_BINARY_DIR}/generated)
# Builds that check preconditions (assert) check those of the standard library too: indices, empty optionals.
target_compile_definitions(tyglab_options INTERFACE
                           $<$<NOT:$<CONFIG:Release,RelWithDebInfo,MinSizeRel>>:_GLIBCXX_ASSERTIONS>)
# The oldest instruction set that the sweep is compiled for is SSE4, of 2008.
target_compile_definitions(tyglab_options INTERFACE HWY_DISABLED_TARGETS=HWY_SSSE3)
if(TYGLAB_SANITIZE)
  if(TYGLAB_SANITIZE STREQUAL "address")
    if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
      message(FATAL_ERROR "TYGLAB_SANITIZE=address needs Clang, whose fuzzer is built with it: cmake --preset asan")
    endif()
    # One build for the tests and for libFuzzer, which needs the coverage that fuzzer-no-link records.
    add_compile_options(-fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=undefined)
    add_link_options(-fsanitize=address,undefined)
    add_compile_definitions(TYGLAB_ADDRESS_SANITIZED)
  elseif(TYGLAB_SANITIZE STREQUAL "thread")
    add_compile_options(-fsanitize=thread)
    add_link_options(-fsanitize=thread)
  else()
    message(FATAL_ERROR "TYGLAB_SANITIZE is \"${TYGLAB_SANITIZE}\"; it can be address or thread, or empty.")
  endif()
  # Compiled to be run once: little optimizing, and no more debug information than the lines of a report's stack. What
  # GCC asks pointers to point to takes four fifths of its time where vectors are checked.
  add_compile_options(-O1 -g1 -fno-omit-frame-pointer $<$<CXX_COMPILER_ID:GNU>:-fno-tree-pta>)
  add_compile_definitions(TYGLAB_WHOLE_ENGINES)
  # One instruction set, since the other builds run each that the machine has: one with vectors, where it is known that
  # the machine has it, so that reads beyond a row's end are seen.
  add_compile_definitions(HWY_COMPILE_ONLY_STATIC)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    add_compile_options(-msse4.2 -mpclmul -maes)
  endif()
endif()
