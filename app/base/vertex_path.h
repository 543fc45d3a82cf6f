// The path of a cloth's positions to OpenGL.
//
// `tyglab devices` reports the path for each device; the Performance card and --time-report (positions_come_by,
// copied_because) report the path in use. The motion has identical bits on every path.
//
// shared_buffer, on graphics cards with cl_khr_gl_sharing (app/render/written_vertices.h). So far tested only with a
// simulated device (tests/support/gl_sharing_double.cpp, `ctest -R gl_sharing`), which shows that the program follows
// the rules, not that a driver does. In each drawn frame the engine writes positions, as float, and normals into two
// buffers of OpenGL. The device's OpenCL context must be created with the OpenGL context (GlContextInUse); if a driver
// refuses, the device gets an ordinary context, stores the reason (Device::gl_problem) and copies.
//
// shared_memory, on processors: a vertex buffer stays mapped (ARB_buffer_storage) and is lent to the engine as three
// slots of plain memory (core/engines/engine.h), from which it makes OpenCL buffers. One slot is being drawn
// and is never written; the other two are enough for any number of launches. A slot is free again once another is shown
// and OpenGL has passed the fence after the last drawing from it. Normals are computed directly into a second such
// buffer. In double, the state stays in the engine's own arrays, and a kernel writes it as float into the lent memory
// once per frame (Engine::shown).
//
// copied, in all other cases: from the CPU engine, whose steps are made in place and would have to wait for the
// drawing; from cards that do not share; if OpenGL lacks the extension or memory; and, except for shared_buffer, for
// cloths finer than the picture, of which only every n-th row and column is drawn. RenderWork::copied counts these
// bytes. RenderWork::read counts what others read of a card's arrays, such as plots, snapshots for rewinding and the
// pointer.
#pragma once

#include <string_view>

namespace tyglab {

/// How positions reach OpenGL.
enum class VertexPath {
  shared_buffer,  ///< the device writes OpenGL's own buffer (cl_khr_gl_sharing)
  shared_memory,  ///< the device, a processor, works in OpenGL's memory (ARB_buffer_storage)
  copied,         ///< the program copies them, once a frame
};

/// "shared_buffer", as written in files.
constexpr std::string_view name_of(VertexPath path) {
  return path == VertexPath::shared_buffer   ? "shared_buffer"
         : path == VertexPath::shared_memory ? "shared_memory"
                                             : "copied";
}

}  // namespace tyglab
