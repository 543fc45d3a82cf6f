// Vertex buffers that are written directly: engines store their positions in them, normals are computed into them.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/render/mapped_buffer.h"
#include "core/engines/vertex_sharing.h"

namespace tyglab {

/// The place of a vector in OpenGL: a buffer, and the offset in bytes.
struct VertexSource {
  GLuint buffer = 0;
  std::size_t offset = 0;
};

/// Memory of vertex buffers that is lent to engines, of all cloths of a window. It stays until the engine is gone, even
/// where the cloth is not drawn any more.
class PositionLoans {
 public:
  struct Loan {
    gl::MappedBuffer buffer;
    std::shared_ptr<PositionMemory> memory;
  };
  /// Lends memory to an engine that wants some, where OpenGL has such buffers; otherwise its positions are copied.
  void lend(Engine& engine);
  /// The loan that these positions lie in; null: none.
  std::shared_ptr<Loan> find(const float* positions) const;
  /// Frees the memory of engines that are gone, unless it is drawn.
  void take_back();
  std::size_t bytes() const;
  /// Why OpenGL has no memory to lend, part of a sentence; empty if it has, or none was requested.
  const std::string& problem() const { return problem_; }

 private:
  std::vector<std::shared_ptr<Loan>> loans_;
  std::string problem_;
};

/// A cloth's positions in lent memory: sees that its engine does not write what is being drawn.
class LentPositions {
 public:
  explicit LentPositions(std::shared_ptr<PositionLoans> loans) : loans_(std::move(loans)) {}
  void lend(Engine& engine) { loans_->lend(engine); }
  /// Where positions lie that are to be drawn next, if they are in lent memory: they stay as they are until others are
  /// shown.
  std::optional<VertexSource> show(const float* positions);
  /// What is shown has been drawn.
  void drawn();
  const std::string& problem() const { return loans_->problem(); }

 private:
  std::shared_ptr<PositionLoans> loans_;
  std::shared_ptr<PositionLoans::Loan> shown_;
};

/// Memory for normals, beside lent positions.
class MappedNormals {
 public:
  /// Where that many bytes of normals are to be written that will be drawn next; null where there is no room.
  float* next(std::size_t bytes);
  VertexSource source() const { return {buffer_->id(), *buffer_->offset_of(buffer_->slot(slot_))}; }
  void drawn();
  /// They are somewhere else now.
  void free() { buffer_.reset(); }
  std::size_t bytes() const { return buffer_ ? buffer_->bytes() : 0; }
  /// Why there is no room, part of a sentence; empty if there is.
  const std::string& problem() const { return problem_; }

 private:
  std::unique_ptr<gl::MappedBuffer> buffer_;
  int slot_ = 0;
  std::string problem_;
};

}  // namespace tyglab
