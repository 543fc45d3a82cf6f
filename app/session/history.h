// Undo and redo of constants: whole presets, one for each gesture.
#pragma once

#include <optional>
#include <vector>

#include "core/model/preset.h"

namespace tyglab {

class History {
 public:
  /// Remembers what stood before a change. Changes of the same gesture (not 0) that follow each other count as one.
  void record(const Preset& before, unsigned gesture) {
    redo_.clear();
    if (gesture != 0 && gesture == gesture_) return;
    gesture_ = gesture;
    undo_.push_back(before);
    if (undo_.size() > most) undo_.erase(undo_.begin());
  }
  /// The next change is a gesture of its own.
  void end_gesture() { gesture_ = 0; }
  bool can_undo() const { return !undo_.empty(); }
  /// What an undo would bring back; null: nothing.
  const Preset* last() const { return undo_.empty() ? nullptr : &undo_.back(); }
  bool can_redo() const { return !redo_.empty(); }
  std::optional<Preset> undo(const Preset& present) { return move(undo_, redo_, present); }
  std::optional<Preset> redo(const Preset& present) { return move(redo_, undo_, present); }
  /// Of all presets that it keeps.
  std::size_t bytes() const {
    std::size_t total = 0;
    for (const auto* list : {&undo_, &redo_})
      for (const Preset& p : *list)
        total += sizeof p + p.name.size() + p.description.size() + p.bodies.size() * sizeof(Body) +
                 p.pins.list.size() * sizeof(Pins::Site);
    return total;
  }
  void clear() { undo_.clear(), redo_.clear(), gesture_ = 0; }

 private:
  static constexpr std::size_t most = 200;
  std::optional<Preset> move(std::vector<Preset>& from, std::vector<Preset>& to, const Preset& present) {
    gesture_ = 0;
    if (from.empty()) return std::nullopt;
    to.push_back(present);
    Preset preset = std::move(from.back());
    from.pop_back();
    return preset;
  }
  std::vector<Preset> undo_, redo_;
  unsigned gesture_ = 0;
};

}  // namespace tyglab
