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
if(TYGLAB_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
  # One instruction set: the sweep compiled for all of them takes minutes under the sanitizers, and the other builds run
  # each set that the machine has.
  add_compile_definitions(HWY_COMPILE_ONLY_STATIC)
endif()
