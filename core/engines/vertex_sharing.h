// Brings the positions of an engine with arrays on a device to OpenGL, with as few copies as possible. Engines that
// step in the program's own memory do not have this: a copy of their positions is drawn.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "core/engines/engine.h"
#include "core/engines/gl_vertices.h"

namespace tyglab {

/// A second face of an engine (Engine::vertex_sharing()), for the code that draws its cloth.
class VertexSharing {
 public:
  VertexSharing() = default;
  VertexSharing(const VertexSharing&) = delete;
  VertexSharing& operator=(const VertexSharing&) = delete;

  /// Whether the device has memory of its own, so that Engine::positions() copies the arrays from there.
  virtual bool remote() const = 0;
  /// Bytes of positions and velocities copied from the device into main memory so far, for whatever purpose.
  virtual std::uint64_t bytes_read() const = 0;

  /// Size of a slot of PositionMemory in which the engine could keep its positions, so that they can be drawn where
  /// they lie, in bytes; 0: it has such memory already, or cannot use any.
  virtual std::size_t wanted_slot_bytes() const = 0;
  /// Keeps the positions, or float copies of them for drawn_positions(), in that memory from now on. Returns false and
  /// changes nothing if the device cannot; it does not ask again then. Not while another thread reads.
  virtual bool use_memory(std::shared_ptr<PositionMemory> memory) = 0;
  /// The positions to draw: Engine::positions(), but in float in the memory lent by use_memory(), if there is any.
  virtual PositionView drawn_positions() = 0;

  /// Whether the device shares buffers with the OpenGL context in use, which share() and write() require. Both must be
  /// called in the thread in which that context is current.
  virtual GlSharing gl_sharing() const = 0;
  /// Opens OpenGL's buffers on the device, for write(). Throws EngineError.
  virtual std::unique_ptr<GlVertices> share(const GlBuffers& buffers) const = 0;
  /// Writes positions in float, and normals if requested, which OpenGL may draw at once. Returns nothing and writes
  /// nothing if the buffers are shared with another device or for another precision. Throws EngineError.
  virtual std::optional<VertexBox> write(GlVertices& vertices, const VertexRequest& request) = 0;

  /// Why OpenGL needs a copy of the positions, as part of a sentence; empty if the engine knows no reason.
  virtual std::string copy_reason() const = 0;

 protected:
  ~VertexSharing() = default;
};

/// Whether any engine's positions are copied from a device's own memory to be read.
inline bool is_remote(const Engine& engine) {
  const VertexSharing* sharing = engine.vertex_sharing();
  return sharing != nullptr && sharing->remote();
}

/// The positions to draw, of any engine.
inline PositionView drawn_positions(Engine& engine) {
  VertexSharing* sharing = engine.vertex_sharing();
  return sharing != nullptr ? sharing->drawn_positions() : engine.positions();
}

/// Bytes that any engine has copied from a device; 0 for one that runs on none.
inline std::uint64_t bytes_read(const Engine& engine) {
  const VertexSharing* sharing = engine.vertex_sharing();
  return sharing != nullptr ? sharing->bytes_read() : 0;
}

}  // namespace tyglab
