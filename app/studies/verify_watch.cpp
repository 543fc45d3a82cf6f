#include "app/studies/verify_watch.h"

#include "core/verify/gallery.h"

namespace tyglab {
namespace {

VerifiedCase verified(const verify::Outcome& outcome) {
  VerifiedCase one;
  one.name = outcome.of->name;
  one.exact = outcome.exact, one.measured = outcome.measured, one.error = outcome.error, one.ok = outcome.ok();
  if (outcome.order) one.order = outcome.order->measured;
  one.at = outcome.problem.empty() ? outcome.at : outcome.problem;
  one.rows = outcome.picture.rows, one.columns = outcome.picture.columns;
  one.x.assign(outcome.picture.x.begin(), outcome.picture.x.end());
  return one;
}

void measure_gallery(Study<VerifyFindings>::Shared& shared, const JobControl& control) {
  try {
    for (const verify::Case* next : verify::all_cases()) {
      const VerifiedCase one = verified(verify::measure(*next, {[&] { return control.cancelled(); }, {}}));
      shared.update([&](VerifyFindings& findings) { findings.cases.push_back(one); });
    }
    shared.update([](VerifyFindings& findings) { findings.done = true; });
  } catch (const Stopped&) {
  } catch (const std::exception& error) {
    shared.update([&](VerifyFindings& findings) { findings.problem = error.what(), findings.done = true; });
  }
}

}  // namespace

void VerifyWatch::stop() {
  asked_ = false, stopped_ = true;
  work_.cancel();
}

void VerifyWatch::drop() {
  work_.drop();
  asked_ = stopped_ = false;
}

bool VerifyWatch::running() const {
  if (asked_) return true;
  const auto known = findings();
  return known && !known->done && !stopped_;
}

void VerifyWatch::poll(StudyMoment& moment) {
  if (work_.working()) moment.ask_again_in(0.1);
  if (!asked_) return;
  moment.ask_again_in(0.1);
  // The run of before ends soon, but is not waited for.
  if (work_.working()) return work_.cancel();
  asked_ = stopped_ = false;
  work_.begin({}, measure_gallery);
}

}  // namespace tyglab
