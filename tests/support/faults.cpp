#include "tests/support/faults.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <new>
#include <system_error>
#include <thread>

#include "tests/support/failing_driver.h"

namespace tyglab::test {
namespace {

std::atomic<bool> armed = false;
std::atomic<std::int64_t> calls = 0, blocks = 0;
std::atomic<bool> met = false;
FaultAt planned{};

/// Counts a call; whether it is one that fails.
bool strikes(Fault kind) {
  if (!armed.load(std::memory_order_acquire) || planned.kind != kind) return false;
  const std::int64_t n = ++calls;
  if (planned.n == 0 || (planned.lasting ? n < planned.n : n != planned.n)) return false;
  met = true;
  return true;
}

/// Of that many bytes, how many the disk takes.
std::size_t room_for(std::size_t bytes) {
  if (!armed.load(std::memory_order_acquire) || planned.kind != Fault::write) return bytes;
  const std::int64_t before = calls;
  if (planned.n == 0 || before + std::int64_t(bytes) < planned.n) {
    calls += std::int64_t(bytes);
    return bytes;
  }
  met = true;
  const auto taken = std::size_t(std::max<std::int64_t>(planned.n - 1 - before, 0));
  calls += std::int64_t(taken);
  return taken;
}

void arm(const FaultAt& at) {
  planned = at;
  calls = 0, met = false;
  if (at.kind == Fault::driver) fail_driver_from(at.n);
  armed.store(true, std::memory_order_release);
}

/// What has been counted, once.
void disarm(Attempt& result) {
  if (!armed.exchange(false)) return;
  result.calls = calls, result.met = met;
  if (planned.kind != Fault::driver) return;
  result.calls = driver_calls();
  result.met = planned.n > 0 && result.calls >= planned.n;
  fail_driver_from(0);
}

int entries(const char* folder) {
  return int(std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator()));
}

}  // namespace

const char* name_of(Fault kind) {
  switch (kind) {
    case Fault::allocation:
      return "allocation";
    case Fault::write:
      return "write";
    case Fault::file:
      return "file";
    case Fault::thread:
      return "thread";
    case Fault::driver:
      return "driver";
  }
  return "";
}

Attempt attempt(const FaultAt& at, const std::function<void()>& operation) {
  Attempt result;
  arm(at);
  try {
    operation();
  } catch (const std::bad_alloc& error) {
    disarm(result);
    result.refused = result.out_of_memory = true, result.sentence = error.what();
  } catch (const std::exception& error) {
    disarm(result);
    result.refused = true, result.sentence = error.what();
  }
  disarm(result);
  return result;
}

Resources resources() {
  const std::int64_t now = blocks;  // before those that are needed to look
  return {now, entries("/proc/self/fd"), entries("/proc/self/task")};
}

bool driver_faults_there() {
  return driver_layer_loaded();
}

std::string Scene::problem(const Attempt& attempt, const std::string& before) {
  if (!attempt.refused) return "nothing was refused";
  if (attempt.sentence.empty()) return "refused without a word";
  if (attempt.sentence.find("nternal error") != std::string::npos) return attempt.sentence;
  if (const std::string after = state(); after != before)
    return "it is not as before: " + after.substr(0, 200) + " instead of " + before.substr(0, 200);
  return {};
}

namespace {

/// Threads that are joined have left the process's list a moment later.
bool given_back(const Resources& before) {
  Resources now = resources();
  for (int n = 0; n < 200 && now.threads > before.threads; ++n) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    now = resources();
  }
  return now.blocks == before.blocks && now.descriptors == before.descriptors && now.threads <= before.threads;
}

using Make = std::function<std::unique_ptr<Scene>()>;

/// How a scene goes on where nothing fails.
struct Wanted {
  std::string untouched, done;
};

std::string differs(const char* what, const std::string& is, const std::string& wanted) {
  return is == wanted ? "" : std::string(what) + ": " + is.substr(0, 300) + " instead of " + wanted.substr(0, 300);
}

/// What was wrong; empty if nothing was.
std::string one_fault(const Campaign& campaign, const Make& make, const FaultAt& at, const Wanted& wanted,
                      Attempt& result) {
  const std::unique_ptr<Scene> scene = make();
  const std::string before = scene->state();
  result = attempt(at, [&] { scene->act(); });
  if (!result.met) return {};
  if (campaign.may_pass && !result.refused) return differs("done without it", scene->outcome(), wanted.done);
  if (std::string wrong = scene->problem(result, before); !wrong.empty()) return wrong;
  if (at.n % 2 == 0) return differs("it goes on otherwise", scene->outcome(), wanted.untouched);
  const Attempt again = attempt({campaign.kind}, [&] { scene->act(); });
  if (again.refused) return "refused when it was repeated: " + again.sentence;
  return differs("it goes on otherwise once it was repeated", scene->outcome(), wanted.done);
}

}  // namespace

void inject(const Campaign& campaign, const Make& make) {
  Attempt counted;
  Wanted wanted;
  // Twice: what is made once in a process, such as tables, is none of the operation's.
  for (int n = 0; n < 2; ++n) {
    wanted.untouched = make()->outcome();
    const std::unique_ptr<Scene> scene = make();
    counted = attempt({campaign.kind}, [&] { scene->act(); });
    REQUIRE_MESSAGE(!counted.refused, std::string(campaign.operation) << ", without a fault: " << counted.sentence);
    wanted.done = scene->outcome();
  }
  constexpr std::int64_t last = 20;  // where what has been made takes the place of what was there
  const std::int64_t all = counted.calls, dense = std::min(all, campaign.dense);
  const std::int64_t stride = std::max<std::int64_t>((all - dense) / std::max<std::int64_t>(campaign.dense, 1), 1);
  std::int64_t tried = 0, survived = 0;
  const auto inject_at = [&](std::int64_t n, bool lasting) {
    const FaultAt at{campaign.kind, n, lasting};
    Attempt result;
    const Resources before = resources();
    std::string wrong = one_fault(campaign, make, at, wanted, result);
    const bool was_met = result.met;
    std::string().swap(result.sentence);  // with its memory
    if (!was_met) return;
    if (wrong.empty() && campaign.kind != Fault::driver && !given_back(before)) {
      const Resources now = resources();
      wrong = "left behind: " + std::to_string(now.blocks - before.blocks) + " blocks, " +
              std::to_string(now.descriptors - before.descriptors) + " descriptors, " +
              std::to_string(now.threads - before.threads) + " threads";
    }
    ++tried, survived += wrong.empty();
    const std::string which = std::string(campaign.operation) + ", " + name_of(campaign.kind) + " " +
                              std::to_string(n) + " of " + std::to_string(all) + (lasting ? " and on: " : ": ");
    CHECK_MESSAGE(wrong.empty(), which << wrong);
  };
  const bool lasts = campaign.kind == Fault::write || campaign.kind == Fault::driver;
  for (std::int64_t n = 1; n <= all; n += n < dense || n + last >= all ? 1 : stride) {
    inject_at(n, lasts);
    if (campaign.lasts) inject_at(n, true);
  }
  std::printf("FAULTS %s: %s %lld %lld\n", campaign.operation, name_of(campaign.kind), static_cast<long long>(tried),
              static_cast<long long>(survived));
  std::fflush(stdout);
}

}  // namespace tyglab::test

// What the linker puts in the place of what the project's own code calls (--wrap): __real_ is the system's.
namespace test = tyglab::test;
using test::Fault;

extern "C" {
void* __real_malloc(std::size_t bytes);
void* __real_calloc(std::size_t count, std::size_t bytes);
void* __real_realloc(void* block, std::size_t bytes);
void* __real_aligned_alloc(std::size_t alignment, std::size_t bytes);

void* __wrap_malloc(std::size_t bytes) {
  return test::strikes(Fault::allocation) ? nullptr : __real_malloc(bytes);
}
void* __wrap_calloc(std::size_t count, std::size_t bytes) {
  return test::strikes(Fault::allocation) ? nullptr : __real_calloc(count, bytes);
}
void* __wrap_realloc(void* block, std::size_t bytes) {
  return test::strikes(Fault::allocation) ? nullptr : __real_realloc(block, bytes);
}
void* __wrap_aligned_alloc(std::size_t alignment, std::size_t bytes) {
  return test::strikes(Fault::allocation) ? nullptr : __real_aligned_alloc(alignment, bytes);
}

ssize_t __real_write(int file, const void* bytes, std::size_t count);
ssize_t __real_pwrite(int file, const void* bytes, std::size_t count, off_t offset);
ssize_t __real_read(int file, void* bytes, std::size_t count);
int __real_open(const char* name, int flags, ...);
int __real_rename(const char* from, const char* to);
int __real_dup(int file);
int __real_fstat(int file, struct stat* status);
int __real_stat(const char* name, struct stat* status);

ssize_t __wrap_write(int file, const void* bytes, std::size_t count) {
  if (test::strikes(Fault::file)) return errno = EIO, -1;
  const std::size_t taken = test::room_for(count);
  return taken == 0 && count > 0 ? (errno = ENOSPC, -1) : __real_write(file, bytes, taken);
}
ssize_t __wrap_pwrite(int file, const void* bytes, std::size_t count, off_t offset) {
  if (test::strikes(Fault::file)) return errno = EIO, -1;
  const std::size_t taken = test::room_for(count);
  return taken == 0 && count > 0 ? (errno = ENOSPC, -1) : __real_pwrite(file, bytes, taken, offset);
}
ssize_t __wrap_read(int file, void* bytes, std::size_t count) {
  return test::strikes(Fault::file) ? (errno = EIO, -1) : __real_read(file, bytes, count);
}
int __wrap_open(const char* name, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? mode_t(va_arg(rest, int)) : 0;
  va_end(rest);
  return test::strikes(Fault::file) ? (errno = EMFILE, -1) : __real_open(name, flags, mode);
}
int __wrap_rename(const char* from, const char* to) {
  return test::strikes(Fault::file) ? (errno = EIO, -1) : __real_rename(from, to);
}
int __wrap_dup(int file) {
  return test::strikes(Fault::file) ? (errno = EMFILE, -1) : __real_dup(file);
}
int __wrap_fstat(int file, struct stat* status) {
  return test::strikes(Fault::file) ? (errno = EIO, -1) : __real_fstat(file, status);
}
int __wrap_stat(const char* name, struct stat* status) {
  return test::strikes(Fault::file) ? (errno = EIO, -1) : __real_stat(name, status);
}

// std::thread::_M_start_thread(unique_ptr<_State>, void (*)()), which fails in this way where the system has no thread
// to give.
#define TYGLAB_START_THREAD(prefix) \
  prefix##_ZNSt6thread15_M_start_threadESt10unique_ptrINS_6_StateESt14default_deleteIS1_EEPFvvE
void TYGLAB_START_THREAD(__real_)(void* thread, void* state, void (*depend)());
void TYGLAB_START_THREAD(__wrap_)(void* thread, void* state, void (*depend)()) {
  if (test::strikes(Fault::thread))
    throw std::system_error(std::make_error_code(std::errc::resource_unavailable_try_again),
                            "Enable multithreading to use std::thread");
  TYGLAB_START_THREAD(__real_)(thread, state, depend);
}
}

namespace {

void* block_of(std::size_t bytes) noexcept {
  void* const block = test::strikes(Fault::allocation) ? nullptr : __real_malloc(std::max<std::size_t>(bytes, 1));
  if (block != nullptr) ++test::blocks;
  return block;
}

void* aligned_block_of(std::size_t bytes, std::align_val_t alignment) noexcept {
  const auto line = std::size_t(alignment);
  void* const block = test::strikes(Fault::allocation)
                          ? nullptr
                          : __real_aligned_alloc(line, (std::max<std::size_t>(bytes, 1) + line - 1) / line * line);
  if (block != nullptr) ++test::blocks;
  return block;
}

void* or_throw(void* block) {
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

void give_back(void* block) noexcept {
  if (block != nullptr) --test::blocks;
  std::free(block);
}

}  // namespace

void* operator new(std::size_t bytes) {
  return or_throw(block_of(bytes));
}
void* operator new[](std::size_t bytes) {
  return or_throw(block_of(bytes));
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  return block_of(bytes);
}
void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept {
  return block_of(bytes);
}
void* operator new(std::size_t bytes, std::align_val_t line) {
  return or_throw(aligned_block_of(bytes, line));
}
void* operator new[](std::size_t bytes, std::align_val_t line) {
  return or_throw(aligned_block_of(bytes, line));
}
void* operator new(std::size_t bytes, std::align_val_t line, const std::nothrow_t&) noexcept {
  return aligned_block_of(bytes, line);
}
void* operator new[](std::size_t bytes, std::align_val_t line, const std::nothrow_t&) noexcept {
  return aligned_block_of(bytes, line);
}
void operator delete(void* block) noexcept {
  give_back(block);
}
void operator delete[](void* block) noexcept {
  give_back(block);
}
void operator delete(void* block, std::size_t) noexcept {
  give_back(block);
}
void operator delete[](void* block, std::size_t) noexcept {
  give_back(block);
}
void operator delete(void* block, const std::nothrow_t&) noexcept {
  give_back(block);
}
void operator delete[](void* block, const std::nothrow_t&) noexcept {
  give_back(block);
}
void operator delete(void* block, std::align_val_t) noexcept {
  give_back(block);
}
void operator delete[](void* block, std::align_val_t) noexcept {
  give_back(block);
}
void operator delete(void* block, std::size_t, std::align_val_t) noexcept {
  give_back(block);
}
void operator delete[](void* block, std::size_t, std::align_val_t) noexcept {
  give_back(block);
}
void operator delete(void* block, std::align_val_t, const std::nothrow_t&) noexcept {
  give_back(block);
}
void operator delete[](void* block, std::align_val_t, const std::nothrow_t&) noexcept {
  give_back(block);
}
