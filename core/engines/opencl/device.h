// An open OpenCL device with its queue and its built programs, and a function to find one.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/engines/gl_vertices.h"
#include "core/engines/opencl/handles.h"
#include "core/engines/opencl/opencl_devices.h"

namespace tyglab::opencl {

/// A program for one device. Each caller has kernels of its own, since they hold arguments.
class Program {
 public:
  explicit Program(ProgramHandle program) : program_(std::move(program)) {}
  Kernel kernel(const char* name) const;

 private:
  ProgramHandle program_;
};

/// A device of a platform.
struct DeviceId {
  cl_platform_id platform;
  cl_device_id id;
};

/// An open device, shared by all engines that run on it; programs are built once for all of them.
class Device {
 public:
  /// Shares buffers with that OpenGL context where both can, see gl_sharing().
  Device(OpenClDevice facts, const DeviceId& which, const GlContext& gl);

  const OpenClDevice& facts() const { return facts_; }
  /// How it shares buffers with the OpenGL context that is in use now.
  GlSharing gl_sharing() const;
  /// Why it shares no buffers with the OpenGL context with which it was opened; empty if it does.
  const std::string& gl_problem() const { return gl_problem_; }
  /// Whether it was opened with that context, or opening it so would change nothing.
  bool suits(const GlContext& gl) const { return !could_share() || gl.number == gl_number_; }
  cl_context context() const { return context_.get(); }
  cl_command_queue queue() const { return queue_.get(); }
  /// How many numbers of that size a work-item should process: as many as a processor's SIMD vector holds; 1 on
  /// graphics cards.
  int width(std::size_t bytes) const;
  /// The program of that text and those build options: from memory, from disk, or newly built. Throws EngineError with
  /// the start of the compiler's log.
  std::shared_ptr<const Program> program(const std::string& text, const std::string& options);
  /// Records that a program of that name has made steps here: drivers finish building kernels when they are first used.
  void note_run(const std::string& program);
  bool has_run(const std::string& program);
  /// A buffer of zeros. Throws EngineError if there is not enough memory.
  Memory zeros(std::size_t bytes) const;
  /// A buffer in the program's own memory, which must outlive it; none if the device would work on a copy.
  Memory in_place(void* memory, std::size_t bytes) const;
  /// The OpenGL buffer of that name.
  Memory shared(unsigned gl_name) const;

 private:
  bool could_share() const { return facts_.gl_sharing && !facts_.processor; }
  Context context_with(cl_platform_id platform, const GlContext& gl);
  ProgramHandle build(const std::string& text, const std::string& options, const std::string& key) const;

  OpenClDevice facts_;
  cl_device_id id_;
  Context context_;
  Queue queue_;
  std::uint64_t gl_number_ = 0;  ///< of the OpenGL context that it was opened with
  std::string gl_problem_;
  std::mutex mutex_;  ///< of what follows
  std::map<std::string, std::shared_ptr<const Program>> programs_;
  std::set<std::string> run_;
};

/// The device of that number among opencl_devices(); -1: the first graphics card, or else the first device. Throws
/// EngineError, which says what to do.
std::shared_ptr<Device> open_device(int number);

}  // namespace tyglab::opencl

// Arguments of kernels. Include this only in this folder.

namespace tyglab::opencl {

/// Sets consecutive arguments from number `at` on; returns the number of the next.
template <class... T>
int set_arguments(const Kernel& kernel, int at, const T&... values) {
  // Buffers are arguments as their handles, which are pointers.
  // NOLINTNEXTLINE(bugprone-sizeof-expression)
  (check(clSetKernelArg(kernel.get(), cl_uint(at++), sizeof values, &values), "setting an argument"), ...);
  return at;
}

}  // namespace tyglab::opencl
