// Commands that open the cards of the plots column.
#include <imgui.h>

#include "app/ui/cards/cards.h"
#include "app/ui/frame/commands.h"
#include "app/ui/frame/panels.h"

namespace tyglab {
namespace {

template <const char* const& name>
void show(Ui& ui) {
  show_card(ui, name);
}

/// Of a card that is not always there: brings it into sight, or closes it where it is in sight already, which is where
/// what it wants is wanted.
template <const char* const& name, bool Layout::*there, bool Wants::*wants>
void toggle_card(Ui& ui) {
  bool& open = ui.settings.layout.*there;
  open = !(open && layout_wants(ui, ImGui::GetIO().DisplaySize).*wants);
  if (open) show_card(ui, name);
}

/// The same of the card of exact answers, which no session remembers.
void toggle_verification(Ui& ui) {
  bool& open = ui.plots.verification;
  open = !(open && layout_wants(ui, ImGui::GetIO().DisplaySize).verification);
  if (open) show_card(ui, card_name::verification);
}

std::string no_weight(const Ui& ui) {
  return ui.session.preset().kind == Kind::one_weight ? "" : "That needs the mass on a spring; this is a cloth.";
}

std::string no_copies(const Ui& ui) {
  return ui.session.copies.lockstep.empty() ? "There is no copy; add one first." : "";
}

void toggle_overlaid(Ui& ui) {
  ui.session.copies.overlaid = !ui.session.copies.overlaid;
  ui.scene.redraw = true;
}

void remove_all_copies(Ui& ui) {
  for (std::size_t n = ui.session.copies.lockstep.size(); n-- > 0;) ui.session.request(request::RemoveCopy{n});
}

/// Opens the card that shows it, where it is measured from the present moment on.
void show_convergence(Ui& ui) {
  show_card(ui, card_name::accuracy);
  ui.session.studies.convergence.drop();
  ui.plots.accuracy = AccuracySide::convergence;
}

/// Opens the card where they are searched for.
void show_settings_finder(Ui& ui) {
  show_card(ui, card_name::accuracy);
  ui.plots.accuracy = AccuracySide::settings;
}

}  // namespace

std::vector<CommandRow> card_rows() {
  return {
      {"show_forces", "Forces card", "", {}, "", "plot curves particle", show<card_name::forces>},
      {"show_height", "Height card", "", {}, "", "plot curve weight figure", show<card_name::height>, no_weight},
      {"toggle_inside",
       "Inside a step",
       "I",
       {{GLFW_KEY_I, 0}},
       "shows a step of the picked particle in formulas",
       "formula springs particle",
       toggle_card<card_name::step, &Layout::inside, &Wants::step>,
       nullptr,
       {},
       [](const Ui& ui) { return ui.settings.layout.inside; }},
      {"show_copies", "Copies card", "", {}, "", "compare lockstep beside add a copy", show<card_name::copies>},
      {"show_distances",
       "Distances of the copies",
       "",
       {},
       "",
       "plot card compare lockstep apart",
       show<card_name::distances>,
       no_copies},
      {"toggle_overlaid",
       "Copies overlaid",
       "",
       {},
       "",
       "split view side by side compare lockstep wireframe",
       toggle_overlaid,
       no_copies,
       {},
       [](const Ui& ui) { return ui.session.copies.overlaid; }},
      {"remove_copies", "Remove all copies", "", {}, "", "delete clear compare lockstep", remove_all_copies, no_copies},
      {"show_stability", "Stability card", "", {}, "", "growth spectral radius limit dt", show<card_name::stability>},
      {"toggle_map",
       "Map of k_s and dt",
       "M",
       {{GLFW_KEY_M, 0}},
       "maps the zones of stability over k_s and dt",
       "stability card",
       toggle_card<card_name::map, &Layout::map, &Wants::map>,
       nullptr,
       {},
       [](const Ui& ui) { return ui.settings.layout.map; }},
      {"show_accuracy", "Accuracy card", "", {}, "", "error reference cost", show<card_name::accuracy>},
      {"measure_convergence", "Order of convergence", "", {}, "", "accuracy error dt slope measured", show_convergence},
      {"find_settings",
       "Find settings for an error",
       "",
       {},
       "",
       "accuracy tolerance target method integrator dt cheapest fastest",
       show_settings_finder},
      {"toggle_verification",
       "Verification: exact answers",
       "",
       {},
       "",
       "verify proof gallery published test correct card",
       toggle_verification,
       nullptr,
       {},
       [](const Ui& ui) { return ui.plots.verification; }},
      {"show_energy", "Energy card", "", {}, "", "ledger work kinetic potential", show<card_name::energy>},
      {"show_performance",
       "Performance card",
       "",
       {},
       "",
       "speed memory frame cost features",
       show<card_name::performance>}};
}

}  // namespace tyglab
