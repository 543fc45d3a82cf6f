#include "app/viewport/vertex_memory.h"

#include <atomic>

namespace tyglab {

void LentPositions::lend(Engine& engine) {
  const std::size_t wanted = engine.wants_memory();
  if (wanted == 0 || no_room_ || !gl::MappedBuffer::available()) return;
  try {
    auto loan = std::unique_ptr<Loan>(new Loan{{PositionMemory::count, wanted}, std::make_shared<PositionMemory>()});
    for (int n = 0; n < PositionMemory::count; ++n) loan->memory->slots[std::size_t(n)] = loan->buffer.slot(n);
    loan->memory->bytes = loan->buffer.slot_bytes();
    if (engine.take_memory(loan->memory)) loans_.push_back(std::move(loan));
  } catch (const GraphicsError&) {
    no_room_ = true;  // positions are copied, as ever
  }
}

std::optional<VertexSource> LentPositions::show(const float* positions) {
  Loan* next = nullptr;
  std::optional<std::size_t> offset;
  for (const auto& loan : loans_)
    if (const auto at = loan->buffer.offset_of(positions)) next = loan.get(), offset = at;
  const int slot = next != nullptr ? next->buffer.slot_of(positions) : -1;
  if (shown_ != nullptr && (shown_ != next || shown_->memory->shown != slot)) {
    shown_->buffer.wait(shown_->memory->shown);
    shown_->memory->shown = -1;
  }
  shown_ = next;
  if (next != nullptr) next->memory->shown = slot;
  give_back(next);
  return next != nullptr ? std::optional(VertexSource{next->buffer.id(), *offset}) : std::nullopt;
}

void LentPositions::drawn() {
  if (shown_ != nullptr) shown_->buffer.drawn(shown_->memory->shown);
}

/// Frees the memory of engines that are gone.
void LentPositions::give_back(Loan* but) {
  std::erase_if(loans_, [but](const auto& loan) { return loan.get() != but && loan->memory.use_count() == 1; });
  std::atomic_thread_fence(std::memory_order_acquire);  // the engine may have ended in another thread
}

std::size_t LentPositions::bytes() const {
  std::size_t total = 0;
  for (const auto& loan : loans_) total += loan->buffer.bytes();
  return total;
}

float* MappedNormals::next(std::size_t bytes) {
  if (no_room_) return nullptr;
  try {
    if (!buffer_ || buffer_->slot_bytes() < bytes) buffer_ = std::make_unique<gl::MappedBuffer>(2, bytes);
  } catch (const GraphicsError&) {
    no_room_ = true;  // they are copied, as ever
    return nullptr;
  }
  slot_ = 1 - slot_;
  buffer_->wait(slot_);
  return reinterpret_cast<float*>(buffer_->slot(slot_));
}

void MappedNormals::drawn() {
  if (buffer_) buffer_->drawn(slot_);
}

}  // namespace tyglab
