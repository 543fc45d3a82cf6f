// The gallery of `tyglab verify`: cases whose answer is exact or published, each measured with the code that everything
// else runs. A new case is a function and a row in the file of its topic (motion.cpp, methods.cpp, statics.cpp,
// vibration.cpp, bending.cpp, contact.cpp, tearing.cpp, self.cpp); everything else follows from the row: the command,
// its JSON, the tests and docs/verification.md, which docs/make_verification writes.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/preset.h"

namespace tyglab::verify {

class Trial;

/// A row of the gallery. Texts of formulas are TeX, as in docs/.
struct Case {
  std::string_view name;      ///< on the command line: "free_fall"
  std::string_view title;     ///< a few words
  std::string_view sentence;  ///< what happens, and what is measured
  std::string_view formula;   ///< the answer
  std::string_view source;    ///< a publication, an equation of the report, or "derived in …"
  std::string_view unit;      ///< of the exact and the measured value; empty: a number
  double allowed;             ///< error: |measured - exact| over |exact|; |measured| where exact is 0
  double order_within;        ///< how far a measured order may be from the expected one; 0: none is measured
  void (*measure)(Trial&);    ///< calls compare() at least once, and converges() where an order is measured
};

/// The cases of one topic.
struct Topic {
  std::string_view name;
  std::span<const Case> cases;
};
/// All of them, in the order in which they are shown.
std::span<const Topic> topics();
std::span<const Case> motion_cases();
std::span<const Case> method_cases();
std::span<const Case> statics_cases();
std::span<const Case> vibration_cases();
std::span<const Case> bending_cases();
std::span<const Case> contact_cases();
std::span<const Case> tearing_cases();
std::span<const Case> self_cases();

/// The cases of all topics, one after the other.
std::vector<const Case*> all_cases();
/// The case of that name, or nullptr.
const Case* find_case(std::string_view name);

/// What a measurement runs under.
struct Conditions {
  Stop stop = {};  ///< ends it with Stopped
  /// Changes the constants of everything that is simulated, behind the back of the case: tests see each case fail so.
  std::function<void(Preset&)> disturb = {};
};

/// An order of convergence, from errors at h, h/2, …
struct Refinement {
  double expected = 0, measured = 0;
  std::string of;              ///< which method or setting
  std::vector<double> errors;  ///< relative, coarsest first
};

/// A cloth (or a mass on a spring) at a moment of a case, with at most `most` of its rows and columns.
struct Picture {
  static constexpr int most = 25;
  int rows = 0, columns = 0;
  std::vector<glm::dvec3> x;  ///< row by row, m
  std::vector<int> pinned;    ///< which of them
  std::vector<Body> bodies;   ///< as they are at that moment
};

/// What a case has measured. Of several comparisons and orders the worst is told.
struct Outcome {
  const Case* of = nullptr;
  double exact = 0, measured = 0;
  double error = 0;  ///< infinite where nothing was measured
  std::string at;    ///< which of several comparisons this is: "rk4"
  int comparisons = 0;
  std::optional<Refinement> order;
  Picture picture;      ///< of the last motion
  double seconds = 0;   ///< of one processor
  std::string problem;  ///< why nothing more was measured; empty: all was
  bool ok() const;
};

/// Measures a case. Throws Stopped; other errors become the outcome's problem.
Outcome measure(const Case& of, const Conditions& conditions = {});

}  // namespace tyglab::verify
