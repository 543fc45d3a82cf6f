# The versions and licenses of everything inside the page, for cmake/web/pack. What is built from the sources of Debian's
# packages has its license there; the licenses of Emscripten's own libraries (C, C++, OpenGL) are in its package.
include(cmake/Licenses.cmake)
set(compiled_in libglm-dev libstb-dev nlohmann-json3-dev libcli11-dev emscripten)
set(fonts fonts-inter fonts-stix fonts-jetbrains-mono fonts-fork-awesome)
tyglab_own_license(licenses)
tyglab_license_of(licenses imgui ${TYGLAB_WEB_LIBRARIES}/imgui/LICENSE.txt)
tyglab_license_of(licenses highway ${TYGLAB_WEB_LIBRARIES}/highway/LICENSE-BSD3)
tyglab_license_of(licenses libjpeg-turbo ${TYGLAB_WEB_LIBRARIES}/libjpeg-turbo/LICENSE.md
                  ${TYGLAB_WEB_LIBRARIES}/libjpeg-turbo/README.ijg)
tyglab_licenses(licenses "compiled in" ${compiled_in})
tyglab_boost_license(licenses)
tyglab_licenses(licenses "included, as far as their glyphs are shown" ${fonts})

set(versions "Tyglab ${PROJECT_VERSION} for browsers, with what these Debian packages and sources hold:\n\n")
tyglab_versions(versions ${compiled_in} libboost-dev ${fonts})
file(GLOB sources ${TYGLAB_WEB_LIBRARIES}/download/*.orig.tar.*)
foreach(source ${sources})
  cmake_path(GET source FILENAME name)
  string(REGEX REPLACE "^(.*)_(.*)\\.orig\\..*$" "\\1 \\2" name ${name})
  string(APPEND versions "${name}\n")
endforeach()
file(WRITE ${PROJECT_BINARY_DIR}/package/LICENSES.txt "${licenses}")
file(WRITE ${PROJECT_BINARY_DIR}/package/VERSIONS.txt "${versions}")
