# The folder for Windows, by `cmake --install`: the program, its files and fonts in data/, a page of first steps, and the
# versions and licenses of everything inside. Text files have Windows' ends of lines.
include(cmake/Licenses.cmake)
set(fonts fonts-inter fonts-stix fonts-jetbrains-mono fonts-fork-awesome fonts-dejavu-core)
# Built from their source packages, whose copyright files are those of the packages with their headers.
set(compiled_in libimgui-dev libglfw3-dev libhwy-dev libjpeg62-turbo-dev libglm-dev libstb-dev nlohmann-json3-dev
                libcli11-dev opencl-c-headers python3-glad)
# The libraries of the compiler: C++, threads, and what starts a program.
set(runtime g++-mingw-w64-x86-64-posix mingw-w64-x86-64-dev)

tyglab_own_license(licenses)
tyglab_licenses(licenses "compiled in" ${compiled_in} ${runtime})
tyglab_boost_license(licenses)
tyglab_licenses(licenses "included" ${fonts})

set(versions "Tyglab ${PROJECT_VERSION}, built by GCC ${CMAKE_CXX_COMPILER_VERSION} for 64-bit Windows 10 and 11, with what \
these Debian packages hold:\n\n")
tyglab_versions(versions ${compiled_in} libboost-dev ${runtime} ${fonts})

file(READ ${PROJECT_SOURCE_DIR}/cmake/windows/README.txt first_steps)
set(texts ${PROJECT_BINARY_DIR}/package)
file(CONFIGURE OUTPUT ${texts}/README.txt CONTENT "${first_steps}" @ONLY NEWLINE_STYLE WIN32)
# Not as templates, since licenses may hold an @ or a semicolon.
foreach(pair LICENSES:licenses VERSIONS:versions)
  string(REPLACE ":" ";" pair ${pair})
  list(GET pair 0 name)
  list(GET pair 1 text)
  string(REPLACE "\n" "\r\n" text "${${text}}")
  file(WRITE ${texts}/${name}.txt "${text}")
endforeach()
install(FILES ${texts}/README.txt ${texts}/LICENSES.txt ${texts}/VERSIONS.txt DESTINATION . COMPONENT program)

foreach(name Inter-Regular.otf Inter-SemiBold.otf STIXGeneral-Italic.otf JetBrainsMono-Regular.ttf
        forkawesome-webfont.ttf DejaVuSans.ttf DejaVuSansMono.ttf)
  file(GLOB_RECURSE found FOLLOW_SYMLINKS /usr/share/fonts/*/${name} /usr/share/fonts-fork-awesome/${name})
  if(NOT found)
    message(FATAL_ERROR "The font ${name} was not found. Install the fonts with: apt-get install fonts-inter fonts-stix "
                        "fonts-jetbrains-mono fonts-fork-awesome fonts-dejavu-core")
  endif()
  list(GET found 0 file)
  file(REAL_PATH ${file} file)
  install(FILES ${file} DESTINATION data/fonts RENAME ${name} COMPONENT program)
endforeach()
