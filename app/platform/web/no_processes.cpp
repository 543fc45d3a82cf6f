// A page cannot start processes; requests for one end with an error.
#include "app/process/child.h"
#include "app/process/program_run.h"

namespace tyglab {
namespace {

constexpr auto no_processes = "the browser edition starts no processes; use the desktop edition";

}  // namespace

Child::Child(const Work&, const ChildOptions&) {
  throw ChildError(no_processes);
}
Child::Child(Child&&) noexcept = default;
Child& Child::operator=(Child&&) noexcept = default;
Child::~Child() = default;
bool Child::read() {
  return false;
}
bool Child::overdue() const {
  return process_ >= 0 && most_seconds_ > 0;
}
ChildExit Child::end() {
  return {};
}

ChildExit run_in_child(const Child::Work&, const ChildOptions&) {
  throw ChildError(no_processes);
}

void run_child_cases(const ChildCases&) {
  throw ChildError(no_processes);
}

std::string signal_words(int) {
  return {};
}

std::string print_in_child(void (*print)()) {
  print();
  return {};
}

ProgramExit run_program(const std::string&, std::vector<std::string>, const ProgramOptions&) {
  return {};
}

void probe_drivers_in_child() {}
void try_programs_in_child() {}
void use_all_kernels(const Preset&, bool) {}
void run_programs_once(const Preset&, bool) {}
std::filesystem::path driver_log() {
  return {};
}

}  // namespace tyglab
