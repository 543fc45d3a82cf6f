// Vertex buffers that are written where they lie: engines keep their positions in them, normals are computed into them.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "app/viewport/mapped_buffer.h"
#include "core/engines/engine.h"

namespace tyglab {

/// Where OpenGL finds a vector: a buffer, and how many bytes behind its beginning.
struct VertexSource {
  GLuint buffer = 0;
  std::size_t offset = 0;
};

/// Lends engines memory of vertex buffers, and sees that they do not write what is being drawn.
class LentPositions {
 public:
  /// Lends memory to an engine that wants some, where OpenGL has such buffers; otherwise its positions are copied.
  void lend(Engine& engine);
  /// Where positions lie that are to be drawn next, if they are in lent memory: they stay as they are until others are
  /// shown.
  std::optional<VertexSource> show(const float* positions);
  /// What is shown has been drawn.
  void drawn();
  std::size_t bytes() const;

 private:
  struct Loan {
    gl::MappedBuffer buffer;
    std::shared_ptr<PositionMemory> memory;
  };
  void give_back(Loan* but);

  std::vector<std::unique_ptr<Loan>> loans_;
  Loan* shown_ = nullptr;
  bool no_room_ = false;
};

/// Memory for normals, beside lent positions.
class MappedNormals {
 public:
  /// Where so many bytes of normals are to be written that will be drawn next; null where there is no room.
  float* next(std::size_t bytes);
  VertexSource source() const { return {buffer_->id(), *buffer_->offset_of(buffer_->slot(slot_))}; }
  void drawn();
  /// They are somewhere else now.
  void free() { buffer_.reset(); }
  std::size_t bytes() const { return buffer_ ? buffer_->bytes() : 0; }

 private:
  std::unique_ptr<gl::MappedBuffer> buffer_;
  int slot_ = 0;
  bool no_room_ = false;
};

}  // namespace tyglab
