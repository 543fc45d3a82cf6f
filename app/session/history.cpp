#include "app/session/history.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "app/base/text.h"
#include "core/integrators/scheme.h"
#include "core/model/fabric.h"
#include "core/model/fields.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

std::size_t state_bytes(const std::vector<HistoryEntry>& list) {
  std::size_t total = 0;
  for (const HistoryEntry& entry : list) {
    if (entry.state) total += entry.state->bytes();
    if (entry.copy && entry.copy->motion) total += entry.copy->motion->bytes();
  }
  return total;
}

/// The value to be read; none where that takes more than a number or a word.
std::optional<std::string> value_text(const Preset& preset, const PresetField& field) {
  if (field.row != nullptr && is_absent(*field.row, preset)) return "as " + std::string(field.row->otherwise);
  if (const auto* number = std::get_if<double Preset::*>(&field.member)) return short_number(preset.**number);
  if (const auto* whole = std::get_if<int Preset::*>(&field.member)) return std::to_string(preset.**whole);
  if (const auto* word = std::get_if<std::string Preset::*>(&field.member))
    return *word == &Preset::integrator ? std::string(scheme(preset.integrator).title) : preset.**word;
  if (std::holds_alternative<Precision Preset::*>(field.member)) return std::string(name_of(preset.precision));
  if (std::holds_alternative<EngineKind Preset::*>(field.member)) return std::string(title_of(preset.engine));
  return std::nullopt;
}

/// As it stands beside the constant; of one without a symbol its name.
std::string name_of(const PresetField& field) {
  return std::string(field.row != nullptr && !field.row->symbol.empty() ? field.row->symbol : field.key);
}

std::vector<const PresetField*> changed_fields(const Preset& before, const Preset& after) {
  std::vector<const PresetField*> fields;
  for (const PresetField& field : preset_fields())
    if (!std::visit([&](auto member) { return before.*member == after.*member; }, field.member))
      fields.push_back(&field);
  return fields;
}

std::string in_words(const PresetField& field, const Preset& before, const Preset& after) {
  std::string text = name_of(field);
  const auto from = value_text(before, field), to = value_text(after, field);
  if (!from) return text;
  text += " " + *from + " → " + *to;
  if (field.row != nullptr && !field.row->unit.empty() && !is_absent(*field.row, after))
    text += " " + std::string(field.row->unit);
  return text;
}

/// "fabric Jeans, 11 oz → Paper, 100 g/m²", where one was chosen, or that is taken back; otherwise empty.
std::string fabric_in_words(const Preset& before, const Preset& after) {
  const auto name_in = [](const Preset& preset) {
    const auto chosen = std::find_if(fabrics().begin(), fabrics().end(),
                                     [&](const Fabric& fabric) { return is_fabric(preset, fabric); });
    return std::string(chosen != fabrics().end() ? chosen->name : "none");
  };
  const bool chosen = std::any_of(fabrics().begin(), fabrics().end(), [&](const Fabric& fabric) {
    return with_fabric(before, fabric) == after || with_fabric(after, fabric) == before;
  });
  return chosen ? "fabric " + name_in(before) + " → " + name_in(after) : "";
}

}  // namespace

void History::record(HistoryEntry before, unsigned gesture) {
  assert(!before.too_large || before.state == nullptr);
  redo_.clear();
  if (!begins(gesture)) return;
  gesture_ = gesture;
  undo_.push_back(std::move(before));
  // Whatever lies before an entry that is gone can no longer be undone in its turn.
  while (undo_.size() > most || (undo_.size() > 1 && state_bytes(undo_) > most_bytes)) undo_.erase(undo_.begin());
}

std::string History::what(bool backwards, const Preset& present) const {
  assert(next(backwards) != nullptr);
  const HistoryEntry& entry = *next(backwards);
  if (!entry.what.empty()) return entry.what;
  return backwards ? change_in_words(entry.constants, present) : change_in_words(present, entry.constants);
}

HistoryEntry History::take(bool backwards, HistoryEntry now) {
  auto& from = backwards ? undo_ : redo_;
  auto& to = backwards ? redo_ : undo_;
  assert(!from.empty() && (!now.too_large || now.state == nullptr));
  gesture_ = 0;
  HistoryEntry entry = std::move(from.back());
  from.pop_back();
  to.push_back(std::move(now));
  return entry;
}

void History::go_back(double t) {
  std::erase_if(undo_, [&](const HistoryEntry& entry) { return (entry.state || entry.too_large) && entry.t > t; });
  redo_.clear();
  gesture_ = 0;
}

const Preset* History::before(double t) const {
  const auto first = std::find_if(undo_.begin(), undo_.end(), [&](const HistoryEntry& entry) { return entry.t > t; });
  return first != undo_.end() ? &first->constants : nullptr;
}

std::size_t History::bytes() const {
  std::size_t total = state_bytes(undo_) + state_bytes(redo_);
  for (const auto* list : {&undo_, &redo_})
    for (const HistoryEntry& entry : *list) {
      const Preset& p = entry.constants;
      total += sizeof entry + p.name.size() + p.description.size() + p.bodies.size() * sizeof(Body) +
               p.pins.list.size() * sizeof(Pins::Site);
      for (const Pins::Motion& motion : p.pins.motions)
        total += sizeof motion + motion.list.size() * sizeof(Pins::Site) + motion.path.size() * sizeof(PathKey);
    }
  return total;
}

std::string change_in_words(const Preset& before, const Preset& after) {
  const std::vector<const PresetField*> fields = changed_fields(before, after);
  if (fields.empty()) return "nothing";
  const std::string first = in_words(*fields.front(), before, after);
  const std::size_t more = fields.size() - 1;
  if (more == 0) return first;
  if (const std::string fabric = fabric_in_words(before, after); !fabric.empty()) return fabric;
  return first + " and " + std::to_string(more) + (more == 1 ? " more constant" : " more constants");
}

std::string only_change(const Preset& before, const Preset& after) {
  const std::vector<const PresetField*> fields = changed_fields(before, after);
  return fields.size() == 1 ? name_of(*fields.front()) : std::string();
}

}  // namespace tyglab
