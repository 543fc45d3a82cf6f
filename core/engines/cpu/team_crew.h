// Lets the threads of a team help the thread that solves, instead of waiting for it.
#pragma once

#include "core/engines/cpu/team.h"
#include "core/engines/cpu/thread_governor.h"
#include "core/engines/implicit/crew.h"

namespace tyglab::cpu {

/// Within Team::run(): one thread solves and dismisses the others at last; they help() meanwhile. All of them do, or
/// one, whichever is quicker.
class TeamCrew final : public implicit::Crew {
 public:
  explicit TeamCrew(Team& team) : team_(team) {}
  int size() const override { return all_ || governor_.threads() > 1 ? team_.size() : 1; }
  void run(const Work& work) override {
    if (size() == 1) return work(0);
    work_ = &work;
    team_.barrier();
    work(0);
    team_.barrier();
  }
  void barrier() override { team_.barrier(); }
  void worked(double seconds) override {
    if (team_.size() > 1) governor_.worked(1, seconds);
  }
  void help(int number) {
    for (team_.barrier(); work_ != nullptr; team_.barrier()) {
      (*work_)(number);
      team_.barrier();
    }
  }
  void dismiss() {
    work_ = nullptr;
    team_.barrier();
  }
  /// Whether all work whether that pays or not. For tests.
  void insist(bool all) { all_ = all; }

 private:
  Team& team_;
  const Work* work_ = nullptr;
  ThreadGovernor governor_{2, 1};  ///< 2: all
  bool all_ = false;
};

}  // namespace tyglab::cpu
