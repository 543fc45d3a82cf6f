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
