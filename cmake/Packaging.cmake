# Debian packages, by `cpack -G DEB` in a build folder; app/release does it. tyglab is the program, python3-tyglab the
# module, where it is built.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR "The Tyglab authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "cloth simulation sandbox for courses in numerical methods")
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "The Tyglab authors <tyglab@localhost>")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)

set(CPACK_COMPONENTS_ALL program)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME tyglab)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION
    "Take a simulated cloth in your hands, tune every constant of its model while
it runs, and see what each method of integration makes of it: stability,
accuracy, energy and cost. For courses in modelling and numerical methods,
with labs, and with commands for simulations, pictures, experiments and
benchmarks.")
# GLFW loads OpenGL when it opens a window.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS
    "libgl1, fonts-inter, fonts-stix, fonts-jetbrains-mono, fonts-fork-awesome, fonts-dejavu-core")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "libgl1-mesa-dri, pocl-opencl-icd | opencl-icd")

if(TYGLAB_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-tyglab)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_DESCRIPTION
      "This is the Python module.
Presets, simulations with positions and velocities as NumPy arrays, grabbing
and cutting, energies, stability and error studies, with the same results as
the program, to the bit.")
  # A module fits one version of CPython.
  find_package(Python3 COMPONENTS Interpreter)
  math(EXPR next_python "${Python3_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "tyglab (= ${PROJECT_VERSION}), python3-numpy, python3 (>= ${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}), \
python3 (<< ${Python3_VERSION_MAJOR}.${next_python})")
endif()
include(CPack)

# Code of these Debian packages is compiled in: their licenses go along with Tyglab's own.
set(compiled_in libimgui-dev libglm-dev libstb-dev nlohmann-json3-dev libcli11-dev libhwy-dev python3-glad)
if(TYGLAB_PYTHON)
  list(APPEND compiled_in pybind11-dev)
endif()
include(cmake/Licenses.cmake)
tyglab_own_license(licenses)
tyglab_licenses(licenses "compiled in" ${compiled_in})
tyglab_boost_license(licenses)
file(WRITE ${PROJECT_BINARY_DIR}/package/copyright "${licenses}")

# Debian's own kind of changelog, which points to ours; of SOURCE_DATE_EPOCH where that is set.
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE ${PROJECT_BINARY_DIR}/package/changelog
     "tyglab (${PROJECT_VERSION}) unstable; urgency=medium\n\n  * See CHANGELOG.md.\n\n"
     " -- ${CPACK_DEBIAN_PACKAGE_MAINTAINER}  ${now}\n")
# Compressed as Debian wants it, without the time.
find_program(GZIP gzip)
foreach(source ${PROJECT_BINARY_DIR}/package/changelog ${PROJECT_SOURCE_DIR}/app/desktop/tyglab.1)
  cmake_path(GET source FILENAME name)
  execute_process(COMMAND ${GZIP} -9nc ${source} OUTPUT_FILE ${PROJECT_BINARY_DIR}/package/${name}.gz)
endforeach()
install(FILES ${PROJECT_BINARY_DIR}/package/tyglab.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
foreach(component ${CPACK_COMPONENTS_ALL})
  string(TOUPPER ${component} upper)
  install(FILES ${PROJECT_BINARY_DIR}/package/copyright ${PROJECT_BINARY_DIR}/package/changelog.gz
          ${PROJECT_SOURCE_DIR}/CHANGELOG.md
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME} COMPONENT ${component})
endforeach()
