#include "app/cli/commands/commands.h"

#include <algorithm>
#include <iostream>
#include <memory>

#include "app/base/experiment_file.h"
#include "app/base/text.h"
#include "app/cli/preset_argument.h"
#include "core/engines/engine.h"
#include "core/io/json_tree.h"
#include "core/io/output_file.h"
#include "core/io/preset_io.h"
#include "core/io/terminal.h"
#include "core/model/notation.h"

namespace tyglab {
namespace {

int list() {
  const std::vector<std::string> names = shipped_presets();
  std::size_t width = 0;
  for (const std::string& name : names) width = std::max(width, name.size());
  for (const std::string& name : names) {
    const Preset preset = load_preset(find_preset(name).file);
    std::cout << name << std::string(width - name.size() + 2, ' ') << preset.name << ". " << preset.description << '\n';
  }
  std::cout << "\nNext: `tyglab NAME` opens one, `tyglab presets show NAME` prints it.\n";
  return exit_done;
}

int show(const std::string& word) {
  const auto read = [&] {
    if (is_link(word)) return linked_preset(read_link(word));
    const std::filesystem::path file = find_preset(word).file;
    return is_experiment(file) ? read_preset(file) : load_preset(file);  // the latter leaves the texture as it is named
  };
  write_output("-", preset_to_json(read()));
  return exit_done;
}

int check(const std::string& word) {
  const Preset preset = is_link(word) ? linked_preset(read_link(word)) : read_preset(find_preset(word).file);
  warn_of_texture(preset);
  std::cout << in_one_line(word) << " is a valid preset: " << printable(preset.name) << ", "
            << (preset.kind == Kind::one_weight
                    ? std::string("mass on a spring")
                    : std::to_string(preset.rows) + " x " + std::to_string(preset.columns) + " particles")
            << ", " << preset.integrator << " (preset hash " << preset_hash(preset) << ").";
  if (const std::string problem = engine_problem(preset); !problem.empty()) std::cout << " But: " << problem << '.';
  std::cout << '\n';
  return exit_done;
}

}  // namespace

void add_presets_command(CLI::App& program, Action& action) {
  auto word = std::make_shared<std::string>();
  CLI::App* command = program.add_subcommand("presets", "List the shipped presets, show one, or check a file");
  command->require_subcommand(0, 1);
  command->footer("Example: tyglab presets show denim > my_denim.json");
  command->callback([&action, command] {
    if (command->get_subcommands().empty()) action = list;
  });

  CLI::App* show_one = command->add_subcommand("show", "Print a preset as JSON, every key with its value");
  show_one->add_option("NAME", *word, "A shipped preset's name, a preset file or a link")->required();
  show_one->footer("Example: tyglab presets show denim > my_denim.json");
  show_one->callback([word, &action] { action = [word] { return show(*word); }; });

  CLI::App* table = command->add_subcommand("notation", "Print the notation table: every constant and variable");
  table->footer("Example: tyglab presets notation > docs/notation.md");
  table->callback([&action] {
    action = [] {
      std::cout << notation_markdown();
      return int(exit_done);
    };
  });

  CLI::App* check_one = command->add_subcommand("check", "Check a preset file: every key, type and range");
  check_one->add_option("FILE", *word, "A preset file, a shipped preset's name or a link")->required();
  check_one->footer("Example: tyglab presets check my_denim.json");
  check_one->callback([word, &action] { action = [word] { return check(*word); }; });
}

}  // namespace tyglab
