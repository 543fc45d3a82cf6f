// Background work without threads: the memory of a page belongs to one thread, but a worker can receive a copy of it,
// and with it of the whole running program. The results of the copy return as bytes.
#pragma once

#include <functional>
#include <memory>
#include <string_view>

namespace tyglab {

/// Whether this platform works so, in place of threads.
bool works_in_copies();

/// A copy of the program that does one piece of work.
class Copy {
 public:
  using Report = std::function<void(std::string_view bytes)>;

  /// Begins `work(report)` in a copy; `take` is called here, between frames, with each report, in order. What the work
  /// changes elsewhere, the copy alone sees. Only where works_in_copies().
  Copy(std::function<void(const Report& report)> work, Report take);
  /// Ends the work, wherever it is.
  ~Copy();
  Copy(const Copy&) = delete;
  Copy& operator=(const Copy&) = delete;

 private:
  friend struct CopyCalls;
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace tyglab
