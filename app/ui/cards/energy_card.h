// The card of the energy ledger: the cloth's energies, the work on it, and the energy that the integrator added.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/ui/state/ui.h"
#include "core/energy/ledger.h"

namespace tyglab {

enum class EnergyKind { has, works, unexplained };

struct EnergyRow {
  EnergyKind kind;
  std::string_view name, help;
  double joule;
};
/// Rows of the card, in its order.
std::vector<EnergyRow> energy_rows(const LedgerReading& reading);

/// "0.013 % of the scene's energy": what stands beside the unexplained energy.
std::string share_text(const LedgerReading& reading);

/// The card in the plots column, closed unless the user has opened it, and its height (pixels).
void energy_card(Ui& ui, float height);
float energy_card_height(const Ui& ui, float width);

}  // namespace tyglab
