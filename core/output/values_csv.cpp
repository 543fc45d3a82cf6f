#include "core/output/values_csv.h"

#include <vector>

#include "core/fields/particle_field.h"
#include "core/io/preset_io.h"
#include "core/io/text.h"

namespace tyglab {

std::string values_csv(Simulation& cloth, Simulation* reference) {
  std::string text = "# tyglab values, t = ";
  append_number(text, cloth.time());
  text += ", steps = " + std::to_string(cloth.steps()) + ", preset hash " + preset_hash(cloth.preset()) + "\ni,j";
  std::vector<std::vector<float>> columns;
  for (const FieldInfo& field : particle_fields()) {
    const bool of_springs = field.field == ParticleField::tension || field.field == ParticleField::strain;
    if (of_springs && cloth.preset().kind == Kind::one_weight) continue;  // its spring is none of the lattice's
    if (field.field == ParticleField::distance && reference == nullptr) continue;
    text += "," + std::string(field.name) + (field.unit.empty() ? "" : " [" + std::string(field.unit) + "]");
    read_field(field.field, cloth, reference, {cloth.lattice(), 1}, columns.emplace_back());
  }
  text += '\n';
  const Lattice& lattice = cloth.lattice();
  for (int i = 0; i < lattice.rows; ++i)
    for (int j = 0; j < lattice.columns; ++j) {
      text += std::to_string(i) + ',' + std::to_string(j);
      for (const auto& column : columns) {
        text += ',';
        append_number(text, double(column[std::size_t(i) * std::size_t(lattice.columns) + std::size_t(j)]));
      }
      text += '\n';
    }
  return text;
}

}  // namespace tyglab
