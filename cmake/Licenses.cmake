# tyglab_licenses(<variable> <how> <package>…): appends to a text the license of each Debian package whose code or files
# go along ("compiled in", "included"), as its copyright file states it. Of those that are not installed nothing is said.
function(tyglab_licenses variable how)
  set(all "${${variable}}")
  foreach(package ${ARGN})
    set(theirs /usr/share/doc/${package}/copyright)
    if(EXISTS ${theirs})
      file(READ ${theirs} text)
      string(REGEX REPLACE "." "=" line "${package}, ${how}")
      string(APPEND all "\n\n${package}, ${how}\n${line}\n\n${text}")
    endif()
  endforeach()
  set(${variable} "${all}" PARENT_SCOPE)
endfunction()

# tyglab_boost_license(<variable>): Boost's copyright file lists the authors of each of its files; what counts is the one
# license of those that are used.
function(tyglab_boost_license variable)
  file(GLOB boost /usr/share/doc/libboost1*-dev/copyright)
  foreach(theirs ${boost})
    file(READ ${theirs} text)
    if(text MATCHES "Boost Software License - Version 1.0 .*")
      string(REGEX REPLACE "(DEALINGS IN THE SOFTWARE).*" "\\1." text "${CMAKE_MATCH_0}")
      set(${variable} "${${variable}}\n\nBoost, compiled in\n==================\n\n${text}\n" PARENT_SCOPE)
      return()
    endif()
  endforeach()
endfunction()

# tyglab_own_license(<variable>): Tyglab's own, first.
function(tyglab_own_license variable)
  file(READ ${PROJECT_SOURCE_DIR}/LICENSE text)
  set(${variable} "Tyglab\n======\n\n${text}" PARENT_SCOPE)
endfunction()

# tyglab_license_of(<variable> <name> <file>…): that of something whose source, with its license in these files, is
# compiled in.
function(tyglab_license_of variable name)
  string(REGEX REPLACE "." "=" line "${name}, compiled in")
  set(all "${${variable}}\n\n${name}, compiled in\n${line}\n")
  foreach(file ${ARGN})
    file(READ ${file} text)
    string(APPEND all "\n${text}")
  endforeach()
  set(${variable} "${all}" PARENT_SCOPE)
endfunction()

# tyglab_versions(<variable> <package>…): appends a line for each Debian package; all of them have to be installed.
function(tyglab_versions variable)
  set(all "${${variable}}")
  foreach(package ${ARGN})
    execute_process(COMMAND dpkg-query -W -f=\${Version} ${package} OUTPUT_VARIABLE version RESULT_VARIABLE missing
                    ERROR_QUIET)
    if(missing)
      message(FATAL_ERROR "What is built includes parts of ${package}, which is not installed. Install it with: "
                          "apt-get install ${package}")
    endif()
    string(APPEND all "${package} ${version}\n")
  endforeach()
  set(${variable} "${all}" PARENT_SCOPE)
endfunction()
