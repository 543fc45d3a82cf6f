// The number of particles: halved, doubled or typed. A typed number may mean a finer cloth or more cloth; the row asks
// which, next to the constants, before anything is built.
#pragma once

#include <optional>

#include "core/model/preset.h"

namespace tyglab {

struct Ui;

/// Other rows or columns than the cloth's, until it is said what they mean.
struct ResolutionQuestion {
  Preset more;                      ///< L and m stay: another size
  std::optional<Preset> same_size;  ///< where the cloth's proportions allow it: as large and as heavy as now
};

/// Asks what the change of rows or columns from the present preset means.
void ask_resolution(Ui& ui, const Preset& wanted);
/// The question, while it waits for its answer and still belongs to the present cloth.
std::optional<ResolutionQuestion> resolution_question(const Ui& ui);
/// Answers it, in one change that one undo takes back.
void answer_resolution(Ui& ui, bool same_size);

/// "÷ 2", "× 2", and the question.
void resolution_row(Ui& ui);

}  // namespace tyglab
