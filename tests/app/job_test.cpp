// Work beside the frames: no frame waits for what nobody wants any more.
#include "app/studies/job.h"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace tyglab::job_test {
namespace {

/// Work that does not end before it may, as if it got no processor. It gives up after a while, so that who waits for it
/// fails instead of hanging.
class Held {
 public:
  void wait() {
    begun_ = true;
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!free_ && std::chrono::steady_clock::now() < end) std::this_thread::yield();
  }
  void let_go() { free_ = true; }
  void until_begun() const {
    while (!begun_) std::this_thread::yield();
  }

 private:
  std::atomic<bool> begun_ = false, free_ = false;
};

TEST_CASE("a study that is dropped is forgotten at once, though its work goes on until it sees that") {
  Held held;
  Study<int> study;
  bool cancelled = false;
  study.begin(1, [&](Study<int>::Shared&, const JobControl& control) {
    held.wait();
    cancelled = control.cancelled();
  });
  held.until_begun();
  study.drop();
  CHECK(study.working());  // nobody has waited for it
  CHECK_FALSE(study.findings().has_value());
  held.let_go();
  while (study.working()) study.drop();
  CHECK(cancelled);
}

TEST_CASE("what is known of a study is said at once, while its work is changing it") {
  Held held;
  Study<int> study;
  study.begin(1, [&](Study<int>::Shared& shared, const JobControl&) {
    shared.update([](int& found) { found = 2; });
    shared.update([&](int& found) {
      found = 3;
      held.wait();
      found = 4;
    });
  });
  held.until_begun();
  CHECK(study.findings() != 3);
  CHECK(study.findings() != 4);
  CHECK(study.working());  // nobody has waited for it
  held.let_go();
  while (study.working()) std::this_thread::yield();
  CHECK(study.findings() == 4);
}

}  // namespace
}  // namespace tyglab::job_test
