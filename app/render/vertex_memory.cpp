#include "app/render/vertex_memory.h"

#include <atomic>

namespace tyglab {

void PositionLoans::lend(Engine& engine) {
  VertexSharing* const sharing = engine.vertex_sharing();
  const std::size_t wanted = sharing != nullptr ? sharing->wanted_slot_bytes() : 0;
  if (wanted == 0 || !problem_.empty()) return;
  try {
    auto loan = std::shared_ptr<Loan>(new Loan{{PositionMemory::count, wanted}, std::make_shared<PositionMemory>()});
    for (int n = 0; n < PositionMemory::count; ++n) loan->memory->slots[std::size_t(n)] = loan->buffer.slot(n);
    loan->memory->bytes = loan->buffer.slot_bytes();
    if (sharing->use_memory(loan->memory)) loans_.push_back(std::move(loan));
  } catch (const GraphicsError& error) {
    problem_ = error.what();  // positions are copied, as ever
  }
}

std::shared_ptr<PositionLoans::Loan> PositionLoans::find(const float* positions) const {
  for (const auto& loan : loans_)
    if (loan->buffer.offset_of(positions)) return loan;
  return nullptr;
}

void PositionLoans::take_back() {
  std::erase_if(loans_, [](const auto& loan) { return loan.use_count() == 1 && loan->memory.use_count() == 1; });
  std::atomic_thread_fence(std::memory_order_acquire);  // the engine may have ended in another thread
}

std::size_t PositionLoans::bytes() const {
  std::size_t total = 0;
  for (const auto& loan : loans_) total += loan->buffer.bytes();
  return total;
}

std::optional<VertexSource> LentPositions::show(const float* positions) {
  auto next = loans_->find(positions);
  const int slot = next ? next->buffer.slot_of(positions) : -1;
  if (shown_ && (shown_ != next || shown_->memory->shown != slot)) {
    shown_->buffer.wait(shown_->memory->shown);
    shown_->memory->shown = -1;
  }
  shown_ = std::move(next);
  loans_->take_back();
  if (!shown_) return std::nullopt;
  shown_->memory->shown = slot;
  return VertexSource{shown_->buffer.id(), *shown_->buffer.offset_of(positions)};
}

void LentPositions::drawn() {
  if (shown_) shown_->buffer.drawn(shown_->memory->shown);
}

float* MappedNormals::next(std::size_t bytes) {
  if (!problem_.empty()) return nullptr;
  try {
    if (!buffer_ || buffer_->slot_bytes() < bytes) buffer_ = std::make_unique<gl::MappedBuffer>(2, bytes);
  } catch (const GraphicsError& error) {
    problem_ = error.what();  // they are copied, as ever
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
