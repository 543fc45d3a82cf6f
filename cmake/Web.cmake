# What the page is built of, by Emscripten: libraries from their sources, which app/run web has put into TYGLAB_WEB_LIBRARIES
# with the headers of the others, since there are no Debian packages of them for WebAssembly.
set(TYGLAB_WEB_LIBRARIES "" CACHE PATH "Folder with include/, imgui/, highway/ and libjpeg-turbo/ for the page (app/run web makes it)")
if(NOT EXISTS ${TYGLAB_WEB_LIBRARIES}/imgui/imgui.h)
  message(FATAL_ERROR "TYGLAB_WEB_LIBRARIES is to name the folder of libraries that app/run web makes. Build the page with: app/run web")
endif()
# Objects compiled for threads also link without them, so both programs are linked from one set of objects: one program for
# pages whose server allows shared memory, one for all others.
add_compile_options(-msimd128 -fwasm-exceptions -pthread)
add_link_options(-fwasm-exceptions)

foreach(header glm json cli11 boost stb)
  add_library(tyglab::${header} INTERFACE IMPORTED GLOBAL)
  target_include_directories(tyglab::${header} SYSTEM INTERFACE ${TYGLAB_WEB_LIBRARIES}/include)
endforeach()

set(hwy_dir ${TYGLAB_WEB_LIBRARIES}/highway)
add_library(tyglab_hwy STATIC ${hwy_dir}/hwy/abort.cc ${hwy_dir}/hwy/aligned_allocator.cc ${hwy_dir}/hwy/per_target.cc
            ${hwy_dir}/hwy/targets.cc)
target_include_directories(tyglab_hwy SYSTEM PUBLIC ${hwy_dir})
add_library(tyglab::hwy ALIAS tyglab_hwy)

if(NOT TYGLAB_APP)
  return()
endif()

# The loader's header is ours; the functions are Emscripten's.
add_library(tyglab_glad INTERFACE)
target_include_directories(tyglab_glad SYSTEM INTERFACE ${PROJECT_SOURCE_DIR}/app/platform/web/include)
add_library(tyglab::glad ALIAS tyglab_glad)
# Of GLFW the names of keys, which Emscripten has; a page needs no library of a window system.
foreach(absent glfw window_system)
  add_library(tyglab::${absent} INTERFACE IMPORTED GLOBAL)
endforeach()

set(imgui_dir ${TYGLAB_WEB_LIBRARIES}/imgui)
add_library(tyglab_imgui STATIC ${imgui_dir}/imgui.cpp ${imgui_dir}/imgui_draw.cpp ${imgui_dir}/imgui_tables.cpp
            ${imgui_dir}/imgui_widgets.cpp ${imgui_dir}/backends/imgui_impl_opengl3.cpp)
target_include_directories(tyglab_imgui SYSTEM PUBLIC ${imgui_dir} ${TYGLAB_WEB_LIBRARIES}/include)
target_compile_definitions(tyglab_imgui PUBLIC IMGUI_IMPL_OPENGL_ES3 IMGUI_DISABLE_DEMO_WINDOWS IMGUI_DISABLE_DEBUG_TOOLS)
target_compile_options(tyglab_imgui PRIVATE -O2)
add_library(tyglab::imgui ALIAS tyglab_imgui)

# cmake/web/build builds this library next to its sources, once per machine.
add_library(tyglab_jpeg INTERFACE)
target_include_directories(tyglab_jpeg SYSTEM INTERFACE ${TYGLAB_WEB_LIBRARIES}/libjpeg-turbo ${TYGLAB_WEB_LIBRARIES}/jpeg-build)
target_link_libraries(tyglab_jpeg INTERFACE ${TYGLAB_WEB_LIBRARIES}/jpeg-build/libjpeg.a)
add_library(tyglab::jpeg ALIAS tyglab_jpeg)
