// Replaces the OpenCL engine in a build without it (TYGLAB_OPENCL=OFF): there is no device, and a request for one is an
// error that names the reason.
#include "core/engines/opencl/opencl_devices.h"

namespace tyglab {
namespace {

constexpr const char* no_opencl = "this tyglab was built without OpenCL";

}  // namespace

void set_driver_probe(DriverProbe) {}

OpenClInventory opencl_devices() {
  return {{}, no_opencl};
}

std::string no_device_words(const std::string& problem) {
  return "No OpenCL device was found (" + problem + "). Build it with -DTYGLAB_OPENCL=ON.";
}

OpenClProbe probe_opencl_device(int, bool) {
  return {false, no_opencl};
}

bool opencl_works_in_place(int) {
  return false;
}

bool opencl_offers_gl_sharing(int) {
  return false;
}

std::string opencl_gl_problem(int) {
  return no_opencl;
}

std::unique_ptr<Engine> opencl::make_opencl_engine(const Preset&, const Lattice&, int) {
  throw EngineError(no_device_words(no_opencl) + " Or use the CPU engine (--engine cpu)");
}

}  // namespace tyglab
