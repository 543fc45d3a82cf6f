#include "tests/support/skip.h"

#include <doctest/doctest.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace tyglab::test {
namespace {

/// Whether the case that runs now was skipped, in any of its subcases.
bool present_is_skipped = false;

bool in_ci() {
  const char* ci = std::getenv("CI");
  return ci != nullptr && *ci != '\0' && std::string_view(ci) != "false";
}

/// Tells how many cases were skipped, in a line beside doctest's own that tests/run reads.
class SkipCounter final : public doctest::IReporter {
 public:
  explicit SkipCounter(const doctest::ContextOptions&) {}
  void test_case_start(const doctest::TestCaseData&) override { present_is_skipped = false; }
  void test_case_end(const doctest::CurrentTestCaseStats& stats) override {
    if (present_is_skipped && stats.testCaseSuccess) ++cases_;
  }
  void test_run_end(const doctest::TestRunStats&) override {
    if (cases_ > 0) std::printf("[skip] test cases: %d\n", cases_);
    std::fflush(stdout);
  }
  void report_query(const doctest::QueryData&) override {}
  void test_run_start() override {}
  void test_case_reenter(const doctest::TestCaseData&) override {}
  void test_case_exception(const doctest::TestCaseException&) override {}
  void subcase_start(const doctest::SubcaseSignature&) override {}
  void subcase_end() override {}
  void log_assert(const doctest::AssertData&) override {}
  void log_message(const doctest::MessageData&) override {}
  void test_case_skipped(const doctest::TestCaseData&) override {}

 private:
  int cases_ = 0;
};
REGISTER_LISTENER("skips", 1, SkipCounter);

}  // namespace

void skip(const std::string& why, Missing what) {
  if (what == Missing::package && in_ci()) {
    FAIL_CHECK("not skipped, since CI has all that it needs: " << why);
  } else {
    std::printf("SKIPPED: %s\n", why.c_str());
    present_is_skipped = true;
  }
}

}  // namespace tyglab::test
