// How a cloth's positions come to where OpenGL draws them.
//
// `tyglab devices` says which way each device goes, the Performance card and --time-report (positions_come_by,
// copied_because) which one is in use. Motion has the same bits whichever it is.
//
// shared_buffer, on graphics cards with cl_khr_gl_sharing (app/render/written_vertices.h). Only run against a double of
// such a device (tests/support/gl_sharing_double.cpp, `ctest -R gl_sharing`), which shows that the program keeps to the
// rules, not that a driver does. In each frame that is drawn the engine writes positions, as float, and normals into
// two buffers of OpenGL. The device's OpenCL context has to be made with the OpenGL context (GlContextInUse); where a
// driver refuses, the device gets an ordinary one, keeps the reason (Device::gl_problem) and copies.
//
// shared_memory, on processors: a vertex buffer stays mapped (ARB_buffer_storage) and is lent to the engine as three
// slots of plain memory (core/engines/position_memory.h), of which it makes OpenCL buffers. One slot is drawn from and
// never written, the two others are enough for any number of launches; a slot is free again once another is shown and
// OpenGL has passed the fence behind the last drawing from it. Normals are computed straight into a second such buffer.
// In double the state stays in the engine's own arrays, and a kernel writes it as float into the lent memory once a
// frame (Engine::shown).
//
// copied, everywhere else: from the CPU engine, whose steps are made in place, so that it would have to wait for the
// drawing; from cards that do not share; where OpenGL lacks the extension or room; and, but for shared_buffer, of
// cloths finer than the picture, of which only every n-th row and column is taken. RenderWork::copied counts these
// bytes, RenderWork::read what others read of a card's arrays, such as plots, snapshots for rewinding and the pointer.
#pragma once

#include <string_view>

namespace tyglab {

enum class VertexWay {
  shared_buffer,  ///< the device writes OpenGL's own buffer (cl_khr_gl_sharing)
  shared_memory,  ///< the device, a processor, works in OpenGL's memory (ARB_buffer_storage)
  copied,         ///< the program copies them, once a frame
};

/// "shared_buffer", as files have it.
constexpr std::string_view name_of(VertexWay way) {
  return way == VertexWay::shared_buffer   ? "shared_buffer"
         : way == VertexWay::shared_memory ? "shared_memory"
                                           : "copied";
}

}  // namespace tyglab
