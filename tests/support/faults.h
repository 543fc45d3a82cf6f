// Faults on purpose, through one seam: a test arms "the n-th from now on fails", calls what it tests, and looks at what
// is left. It costs the program nothing, since a test program alone is linked with it (tests/faults, CMakeLists.txt):
//
//   allocation  operator new, and malloc and its kin as the project's own code calls them
//   write       files take n bytes more; then the disk is full
//   file        the n-th system call on a file fails: open, read, write, rename, …
//   thread      the n-th std::thread cannot be started
//   driver      the n-th call of OpenCL fails and all that follow, as on a device that is lost (failing_driver.cpp)
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace tyglab::test {

enum class Fault { allocation, write, file, thread, driver };
const char* name_of(Fault kind);

/// Which call fails: the n-th, from 1, alone or (lasting) with all after it. Writes and drivers always last.
struct FaultAt {
  Fault kind;
  std::int64_t n = 0;  ///< 0: none, calls are counted
  bool lasting = false;
};

/// What became of an operation under a fault.
struct Attempt {
  std::int64_t calls = 0;      ///< of that kind; bytes, of writes
  bool met = false;            ///< the fault struck
  bool refused = false;        ///< something was thrown
  bool out_of_memory = false;  ///< which was std::bad_alloc
  std::string sentence;        ///< what() of what was thrown
};

/// Does it under that fault, which ends where it ends or throws.
Attempt attempt(const FaultAt& at, const std::function<void()>& operation);

/// What a process holds and must give back.
struct Resources {
  std::int64_t blocks = 0;  ///< of memory, from operator new
  int descriptors = 0, threads = 0;
  bool operator==(const Resources&) const = default;
};
Resources resources();

/// Whether the layer that lets drivers fail is there: where OPENCL_LAYERS names it, and a driver is installed.
bool driver_faults_there();

/// What an operation works on, made anew for each fault.
class Scene {
 public:
  virtual ~Scene() = default;
  virtual void act() = 0;
  /// Everything that a refused operation has to leave as it is, as text to be compared.
  virtual std::string state() = 0;
  /// What is wrong after a fault that was met; empty if nothing is. As a rule: refused with a sentence, nothing
  /// changed.
  virtual std::string problem(const Attempt& attempt, const std::string& before);
  /// How it goes on, after the operation or without it, as text to be compared; may change the state.
  virtual std::string outcome() { return state(); }
};

/// Lets every call of that kind in the operation fail in turn, and checks each time what the scene says, and that no
/// memory, file or thread is left; then, in turn, that the scene goes on as if nothing had been asked of it, or that
/// the operation succeeds when it is repeated and that it goes on as if nothing had failed. The first `dense` calls
/// each, the last ones too, and of the rest every so many that there are about as many more. Prints "FAULTS
/// <operation>: <kind> <faults tried> <survived>".
struct Campaign {
  const char* operation;
  Fault kind;
  std::int64_t dense = 150;
  bool lasts = false;     ///< of allocations: each fault also as one that lasts
  bool may_pass = false;  ///< the operation may do without what fails, with the same outcome
};
void inject(const Campaign& campaign, const std::function<std::unique_ptr<Scene>()>& make);

}  // namespace tyglab::test
