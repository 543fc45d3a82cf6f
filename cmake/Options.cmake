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
# GCC's own memory is looked through for garbage less often: a tenth of its time, for 200 MB more of memory.
target_compile_options(tyglab_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=524288>)
if(TYGLAB_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
  # Compiled to be run once: little optimising, no more debug information than the lines of a report's stack, and checks
  # of addresses by calls, which take a third less to compile than checks in place and hardly longer to run.
  add_compile_options(-O1 -g1 $<$<CXX_COMPILER_ID:GNU>:--param=asan-instrumentation-with-call-threshold=0>)
  add_compile_definitions(TYGLAB_WHOLE_ENGINES)
  # One instruction set, since the other builds run each that the machine has: one with vectors, where it is known that
  # the machine has it, so that reads beyond a row's end are seen.
  add_compile_definitions(HWY_COMPILE_ONLY_STATIC)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    add_compile_options(-msse4.2 -mpclmul -maes)
  endif()
endif()
