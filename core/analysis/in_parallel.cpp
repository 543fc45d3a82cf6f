#include "core/analysis/in_parallel.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace tyglab {

void in_parallel(int count, int threads, const std::function<void(int)>& work, const std::function<void(int)>& finished,
                 const std::function<bool()>& stop) {
  std::mutex mutex;
  std::vector<bool> done(std::size_t(count), false);
  int taken = 0, told = 0;
  std::exception_ptr fault;
  const auto take = [&] {
    const std::lock_guard lock(mutex);
    return fault || taken == count || stop() ? -1 : taken++;
  };
  const auto tell = [&](int n) {
    const std::lock_guard lock(mutex);
    done[std::size_t(n)] = true;
    while (!fault && told < count && done[std::size_t(told)]) finished(told++);
  };
  const auto worker = [&] {
    try {
      for (int n = take(); n >= 0; n = take()) work(n), tell(n);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!fault) fault = std::current_exception();
    }
  };
  std::vector<std::thread> others;
  others.reserve(std::size_t(std::max(threads, 1)));
  try {
    for (int n = 1; n < std::min(threads, count); ++n) others.emplace_back(worker);
  } catch (const std::system_error&) {
    // The system gives no more threads: fewer do the work.
  }
  worker();
  for (std::thread& other : others) other.join();
  if (fault) std::rethrow_exception(fault);
}

}  // namespace tyglab
