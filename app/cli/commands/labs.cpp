#include "app/cli/commands/commands.h"

#include <algorithm>
#include <iostream>
#include <memory>

#include "app/session/lab_state.h"

namespace tyglab {
namespace {

int list_labs() {
  std::vector<std::string> problems;
  const std::vector<Lab> labs = read_labs(problems);
  std::size_t width = 0;
  for (const Lab& lab : labs) width = std::max(width, lab.label.size());
  for (const Lab& lab : labs)
    std::cout << lab.label << std::string(width - lab.label.size() + 2, ' ') << lab.title << " ("
              << counted(std::int64_t(lab.steps.size()), "step")
              << (lab.minutes > 0 ? ", about " + counted(lab.minutes, "minute") : "") << ")\n";
  for (const std::string& problem : problems) std::cerr << "tyglab: " << problem << '\n';
  std::cout << "\nNext: open the sandbox with `tyglab` and choose one with Ctrl+L.\n";
  return problems.empty() ? exit_done : exit_input;
}

int check_lab(const std::string& name_or_file) {
  const Lab lab = load_lab(find_lab_file(name_or_file));
  const auto checks = [&] {
    std::size_t count = 0;
    for (const LabStep& step : lab.steps) count += step.checks.size();
    return std::int64_t(count);
  };
  std::cout << name_or_file << " is a valid lab: " << lab.title << ", "
            << counted(std::int64_t(lab.steps.size()), "step") << ", " << counted(checks(), "check") << ".\n";
  return exit_done;
}

}  // namespace

void add_labs_command(CLI::App& program, Action& action) {
  auto file = std::make_shared<std::string>();
  CLI::App* command = program.add_subcommand("labs", "List the labs, or check a lab file");
  command->require_subcommand(0, 1);
  command->footer("Example: tyglab labs check my_lab.md");
  command->callback([&action, command] {
    if (command->get_subcommands().empty()) action = list_labs;
  });
  CLI::App* check_one = command->add_subcommand("check", "Check a lab file: its steps, presets, answers and checks");
  check_one->add_option("FILE", *file, "A Markdown file with a lab, or a shipped lab's name")->required();
  check_one->footer("Example: tyglab labs check my_lab.md");
  check_one->callback([file, &action] { action = [file] { return check_lab(*file); }; });
}

}  // namespace tyglab
