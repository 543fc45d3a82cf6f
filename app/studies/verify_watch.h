// Measures the gallery of `tyglab verify` in the background, on request.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/studies/job.h"
#include "app/studies/moment.h"

namespace tyglab {

/// A measured case.
struct VerifiedCase {
  std::string name;
  double exact = 0, measured = 0, error = 0;
  std::optional<double> order;
  bool ok = false;
  std::string at;  ///< what is wrong, or which comparison is told
  int rows = 0, columns = 0;
  std::vector<glm::vec3> x = {};  ///< the cloth of its last motion, row by row, m
};

/// The results of a run, in the order of the gallery.
struct VerifyFindings {
  std::vector<VerifiedCase> cases;
  std::string problem;  ///< why there are no more
  bool done = false;
};

template <class Visit>
void visit_parts(Visit&& visit, VerifiedCase& one) {
  auto& [name, exact, measured, error, order, ok, at, rows, columns, x] = one;
  visit(name, exact, measured, error, order, ok, at, rows, columns, x);
}
template <class Visit>
void visit_parts(Visit&& visit, VerifyFindings& findings) {
  auto& [cases, problem, done] = findings;
  visit(cases, problem, done);
}

class VerifyWatch {
 public:
  /// Asks for a run of all cases, from the next poll on; what an earlier one found is forgotten then.
  void ask() { asked_ = true; }
  /// Ends the run; its findings are kept.
  void stop();
  /// Called in every frame in which it is wanted.
  void poll(StudyMoment& moment);
  /// Stops, and forgets the findings.
  void drop();
  /// Whether a run is asked for that has not ended.
  bool running() const;
  /// A copy of the results; none before the first run.
  std::optional<VerifyFindings> findings() const { return work_.findings(); }

 private:
  Study<VerifyFindings> work_;
  bool asked_ = false;    ///< and not begun yet
  bool stopped_ = false;  ///< by stop()
};

}  // namespace tyglab
