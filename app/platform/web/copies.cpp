#include "app/platform/platform.h"

#include <emscripten.h>
#include <emscripten/threading.h>

#include <map>
#include <string>
#include <utility>

// Of app/platform/web/library.js.
extern "C" {
void tyglab_start_copy(int number, void* parts);
void tyglab_end_copy(int number);
void tyglab_report(const char* bytes, int count);
void* sbrk(long bytes);
}

namespace tyglab {

struct Copy::Parts {
  std::function<void(const Report& report)> work;
  Report take;
  int number = 0;

  /// Those that go on, by their numbers.
  static std::map<int, Parts*>& all() {
    static std::map<int, Parts*> parts;
    return parts;
  }
};

bool works_in_copies() {
  return !emscripten_has_threading_support();
}

Copy::Copy(std::function<void(const Report& report)> work, Report take)
    : parts_(std::make_unique<Parts>(std::move(work), std::move(take))) {
  static int last = 0;
  parts_->number = ++last;
  Parts::all().emplace(parts_->number, parts_.get());
  tyglab_start_copy(parts_->number, parts_.get());
}

Copy::~Copy() {
  Parts::all().erase(parts_->number);
  tyglab_end_copy(parts_->number);
}

/// Called by library.js: in the copy, to work; in the page, with what it reports.
struct CopyCalls {
  static void run(void* parts) {
    static_cast<Copy::Parts*>(parts)->work(
        [](std::string_view bytes) { tyglab_report(bytes.data(), int(bytes.size())); });
  }
  static void take(int number, const char* bytes, int count) {
    const auto parts = Copy::Parts::all().find(number);
    if (parts == Copy::Parts::all().end()) return;
    const Copy::Report take = parts->second->take;  // which may end the copy
    take({bytes, std::size_t(count)});
  }
};

}  // namespace tyglab

extern "C" {
/// Where the memory that is in use ends.
EMSCRIPTEN_KEEPALIVE void* tyglab_memory_end() {
  return sbrk(0);
}

EMSCRIPTEN_KEEPALIVE void tyglab_run_copy(void* parts) {
  tyglab::CopyCalls::run(parts);
}

EMSCRIPTEN_KEEPALIVE void tyglab_on_report(int number, const char* bytes, int count) {
  tyglab::CopyCalls::take(number, bytes, count);
}
}
