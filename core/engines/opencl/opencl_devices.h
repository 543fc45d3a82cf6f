// Lists the OpenCL devices and their abilities. It includes no OpenCL header.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/engines/engine.h"
#include "core/forces/force.h"

namespace tyglab {

struct Preset;
struct Scheme;

struct OpenClDevice {
  std::string platform, name, version, driver;
  unsigned compute_units = 0;
  std::uint64_t memory_bytes = 0;
  bool fp64 = false;           ///< computes in double
  bool processor = false;      ///< a CPU: its memory is the program's own
  bool card = false;           ///< a graphics card
  bool shared_memory = false;  ///< the host reads buffers in place, without a copy
  bool gl_sharing = false;     ///< cl_khr_gl_sharing: can use OpenGL's buffers
  bool gl_event = false;       ///< cl_khr_gl_event: it and OpenGL wait for each other
};

/// Calls `ask` where a crash or a hang does no harm, such as in a child process; returns whether it came to its end.
using DriverProbe = std::function<bool(const std::function<void()>& ask)>;
/// Sets how to find out, once, whether the drivers survive being asked for their devices. Without a probe they are
/// trusted.
void set_driver_probe(DriverProbe probe);

/// Builds and runs what an engine is about to, for a preset like that one, where a crash or a hang does no harm.
/// `contacts`: with a program that notes what bodies stop. Returns what the driver did instead; empty if all went well,
/// or if it refused in good order, which the engine will meet itself.
using ProgramTrial = std::function<std::string(const Preset& preset, bool contacts)>;
/// Sets how each program is tried, once for each device, before it is built here: drivers die late, where they lack a
/// linker or room on a disk. Without a trial they are trusted.
void set_program_trial(ProgramTrial trial);
/// Tries the preset's program on its device, unless that has been done; what came of it stays. Throws EngineError if
/// the driver did not survive.
void try_program(const Preset& preset, bool contacts);

/// The devices of all platforms, in the order of their numbers (--engine opencl:NUMBER). Never throws for what a driver
/// does; if the drivers crash the probe, there are no devices.
struct OpenClInventory {
  std::vector<OpenClDevice> devices;
  std::string problem;  ///< why there is none, if that is known
};
OpenClInventory opencl_devices();

/// The number of the default device: the first graphics card's, or else 0.
int preferred_device(const std::vector<OpenClDevice>& devices);
/// Says that there is no device, why (OpenClInventory::problem), and what to do, in sentences.
std::string no_device_words(const std::string& problem);

/// Whether OpenCL devices run the method: it must have a fixed dt and not project.
bool runs_on_opencl(const Scheme& method);
/// A force of the scene that OpenCL devices do not compute with its method, F_s in a cloth that parts; nullptr if there
/// is none.
const Force* missing_on_opencl(const Preset& preset);
/// "F_curl", or "F_air with implicit_euler" where other methods compute it: what is missing, in sentences.
std::string words_of_missing(const Force& force, std::string_view method);

/// Why no OpenCL device computes the preset, and how to go on, a sentence without its end; empty if they do.
std::string opencl_problem(const Preset& preset);

/// Particles of the largest cloth whose linear systems a processor solves in one launch; larger cloths need other
/// kernels.
inline constexpr int most_solved_in_one_launch = 20000;

/// Whether a device really computes in one precision.
struct OpenClProbe {
  bool offered = false;  ///< by the device
  std::string problem;   ///< empty: the test kernel was built and run, and its result was right
};
/// Builds and runs kernels/probe.cl on the device of that number, in float or in double. Never throws.
OpenClProbe probe_opencl_device(int number, bool in_double);

/// Whether the device of that number works in memory of the program's, as processors do, so that it can write into
/// OpenGL's. Never throws.
bool opencl_works_in_place(int number);

/// Whether the device of that number has memory of its own and says that it can share buffers with OpenGL. Such a
/// device should be opened once there is an OpenGL context (GlContextInUse). Never throws.
bool opencl_offers_gl_sharing(int number);
/// Why that device does not share buffers with the OpenGL context in use, as part of a sentence; empty if it does.
std::string opencl_gl_problem(int number);

}  // namespace tyglab

// Creates the OpenCL engine without an OpenCL header.

namespace tyglab::opencl {

/// Throws EngineError where there is no such device, it cannot run the preset, or the program was built without OpenCL.
/// `width`: particles that a work-item works on at a time, 1, 4, 8 or 16; 0: what suits the device (tests try all).
std::unique_ptr<Engine> make_opencl_engine(const Preset& preset, const Lattice& lattice, int width = 0);

}  // namespace tyglab::opencl

// The OpenGL context with which devices share buffers. It includes no header of OpenGL or OpenCL; app provides the
// handles of its window.

namespace tyglab {

/// An OpenGL context by the handles of its window system.
struct GlContext {
  void *context = nullptr, *display = nullptr;  ///< GLXContext and Display*, or EGLContext and EGLDisplay
  bool glx = false;
  std::uint64_t number = 0;  ///< set by GlContextInUse, since another context may get the same address
};

/// While it exists, newly opened devices share buffers with that context if they can. The latest one counts.
class GlContextInUse {
 public:
  explicit GlContextInUse(GlContext context);
  ~GlContextInUse();
  GlContextInUse(const GlContextInUse&) = delete;
  GlContextInUse& operator=(const GlContextInUse&) = delete;

 private:
  std::uint64_t number_;
};

/// The one in use; its number is 0 if there is none.
GlContext gl_context_in_use();

}  // namespace tyglab

// The library that finds OpenCL drivers, and the advice if it or a driver is missing, for each system.

namespace tyglab::opencl {

/// Whether the library is there; until it has been found no function of OpenCL may be called. The program is linked
/// with it on Linux, and takes it at run time on Windows, where a graphics driver brings it.
bool driver_loader_is_there();

/// How one gets a device, a sentence.
std::string_view how_to_get_a_device();
/// What to do where a driver fails at what it should be able to do: an instruction without its full stop.
std::string_view how_to_mend_a_driver();

}  // namespace tyglab::opencl
