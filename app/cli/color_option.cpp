#include "app/cli/color_option.h"

#include "core/fields/particle_field.h"
#include "core/model/readable.h"

namespace tyglab {

void add_color_option(CLI::App& command, std::string& name, bool copies) {
  std::vector<std::string> names;
  for (const FieldInfo& field : particle_fields()) {
    if (field.field == ParticleField::distance && !copies) continue;
    names.emplace_back(field.name);
  }
  command.add_option("--color", name, "Colors the cloth by a value of each particle, with a legend")
      ->type_name(joined(names, "|"))
      ->check(CLI::IsMember(names).description(""));
}

}  // namespace tyglab
