// Runs independent measurements on several threads and reports the results in order.
#pragma once

#include <functional>

namespace tyglab {

/// Does work(n) for every n in [0, count), on `threads` threads at a time, until stop() holds; calls finished(n) once n
/// and all before it are done, for one n after the other. What was begun is finished. Rethrows what work or finished
/// threw first.
void in_parallel(int count, int threads, const std::function<void(int)>& work, const std::function<void(int)>& finished,
                 const std::function<bool()>& stop);

}  // namespace tyglab
