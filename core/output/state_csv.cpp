#include "core/output/state_csv.h"

#include "core/io/preset_io.h"
#include "core/io/text.h"

namespace tyglab {

std::string state_csv(const Lattice& lattice, const State& state, const StateStamp& stamp) {
  std::string text = "# tyglab state, t = ";
  append_number(text, stamp.t);
  text += ", steps = " + std::to_string(stamp.steps) + ", preset hash " + stamp.preset_hash + "\n";
  text += "i,j,x,y,z,vx,vy,vz\n";
  constexpr std::size_t characters_a_row = 150;  // six numbers of at most 24 characters, and the indices
  text.reserve(text.size() + std::size_t(lattice.size()) * characters_a_row);
  for (int i = 0; i < lattice.rows; ++i)
    for (int j = 0; j < lattice.columns; ++j) {
      const std::size_t p = std::size_t(i) * lattice.columns + j;
      text += std::to_string(i) + ',' + std::to_string(j);
      for (const VectorField<double>* field : {&state.x, &state.v})
        for (const double value : {field->x[p], field->y[p], field->z[p]}) {
          text += ',';
          append_number(text, value);
        }
      text += '\n';
    }
  return text;
}

std::string state_csv(Simulation& simulation) {
  return state_csv(simulation.lattice(), simulation.read_raw(),
                   {simulation.time(), simulation.steps(), preset_hash(simulation.preset())});
}

}  // namespace tyglab
