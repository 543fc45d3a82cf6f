#include "core/engines/opencl/device.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>
#include <optional>
#include <utility>

#include "core/engines/opencl/program_text.h"

namespace tyglab::opencl {
namespace {

/// Text of a device or platform, without the closing zero and spaces that some drivers leave.
std::string trimmed(std::string text) {
  const auto last = text.find_last_not_of(std::string("\0 \n", 3));
  text.resize(last == std::string::npos ? 0 : last + 1);
  return text;
}

std::string text_of(cl_platform_id platform, cl_platform_info what) {
  std::size_t size = 0;
  if (clGetPlatformInfo(platform, what, 0, nullptr, &size) != CL_SUCCESS) return {};
  std::string text(size, '\0');
  clGetPlatformInfo(platform, what, size, text.data(), nullptr);
  return trimmed(text);
}

std::string text_of(cl_device_id device, cl_device_info what) {
  std::size_t size = 0;
  if (clGetDeviceInfo(device, what, 0, nullptr, &size) != CL_SUCCESS) return {};
  std::string text(size, '\0');
  clGetDeviceInfo(device, what, size, text.data(), nullptr);
  return trimmed(text);
}

template <class T>
T number_of(cl_device_id device, cl_device_info what) {
  T number{};
  clGetDeviceInfo(device, what, sizeof number, &number, nullptr);
  return number;
}

/// All devices; `problem`: why there is none.
std::vector<DeviceId> ask_drivers(std::string& problem) {
  constexpr cl_int no_platform = -1001;  // CL_PLATFORM_NOT_FOUND_KHR
  cl_uint count = 0;
  const cl_int code = driver_loader_is_there() ? clGetPlatformIDs(0, nullptr, &count) : no_platform;
  if (code == no_platform || count == 0) problem = "no OpenCL driver is installed";
  if (code != CL_SUCCESS || count == 0) return {};
  std::vector<cl_platform_id> platforms(count);
  if (clGetPlatformIDs(count, platforms.data(), nullptr) != CL_SUCCESS) return {};
  std::vector<DeviceId> found;
  for (cl_platform_id platform : platforms) {
    cl_uint devices = 0;
    // A platform without devices says so by an error; the others still count.
    if (clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 0, nullptr, &devices) != CL_SUCCESS || devices == 0) continue;
    std::vector<cl_device_id> ids(devices);
    if (clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, devices, ids.data(), nullptr) != CL_SUCCESS) continue;
    for (cl_device_id id : ids) found.push_back({platform, id});
  }
  if (found.empty())
    problem = "the OpenCL drivers of this system offer no device, as with pocl if its cache folder is not writable";
  return found;
}

OpenClDevice facts_of(const DeviceId& found) {
  OpenClDevice facts;
  facts.platform = text_of(found.platform, CL_PLATFORM_NAME);
  facts.name = text_of(found.id, CL_DEVICE_NAME);
  facts.version = text_of(found.id, CL_DEVICE_VERSION);
  facts.driver = text_of(found.id, CL_DRIVER_VERSION);
  facts.compute_units = number_of<cl_uint>(found.id, CL_DEVICE_MAX_COMPUTE_UNITS);
  facts.memory_bytes = number_of<cl_ulong>(found.id, CL_DEVICE_GLOBAL_MEM_SIZE);
  const std::string extensions = text_of(found.id, CL_DEVICE_EXTENSIONS);
  facts.fp64 = extensions.find("cl_khr_fp64") != std::string::npos;
  facts.gl_sharing = extensions.find("cl_khr_gl_sharing") != std::string::npos;
  facts.gl_event = extensions.find("cl_khr_gl_event") != std::string::npos;
  const auto type = number_of<cl_device_type>(found.id, CL_DEVICE_TYPE);
  facts.processor = (type & CL_DEVICE_TYPE_CPU) != 0, facts.card = (type & CL_DEVICE_TYPE_GPU) != 0;
  facts.shared_memory = facts.processor || number_of<cl_bool>(found.id, CL_DEVICE_HOST_UNIFIED_MEMORY) != 0;
  return facts;
}

// Held while drivers are asked for their devices: pocl tells a second thread of devices that it is still starting in a
// first one, and crashes when that asks for their names.
std::mutex drivers_mutex;

std::mutex probe_mutex;  // of what follows
DriverProbe driver_probe;
std::optional<bool> probed_crash;

/// Whether asking the drivers for their devices crashes, as it does with pocl where /sys is not mounted.
bool drivers_crash() {
  const std::lock_guard lock(probe_mutex);
  const auto ask = [] {
    std::string problem;
    for (const DeviceId& found : ask_drivers(problem)) facts_of(found);
  };
  // Twice: a child that is forked while another thread holds a lock of a library can fail though the drivers are well.
  if (!probed_crash) probed_crash = driver_probe && !driver_probe(ask) && !driver_probe(ask);
  return *probed_crash;
}

std::vector<DeviceId> find_devices(std::string& problem) {
  if (!drivers_crash()) return ask_drivers(problem);
  problem =
      "an OpenCL driver of this system crashes while listing its devices, as pocl does if /sys is not "
      "mounted";
  return {};
}

constexpr const char* suggested_fix = "; use the CPU engine (--engine cpu); `tyglab devices` lists the devices";

}  // namespace

std::string words_of(cl_int code) {
  const auto named = [code](const char* name) { return std::string(name) + " (error " + std::to_string(code) + ")"; };
  switch (code) {
    case CL_DEVICE_NOT_AVAILABLE:
      return named("the device is not available");
    case CL_MEM_OBJECT_ALLOCATION_FAILURE:
      return named("the device does not have enough memory");
    case CL_OUT_OF_RESOURCES:
      return named("the device is out of resources, or was lost");
    case CL_OUT_OF_HOST_MEMORY:
      return named("the driver is out of memory");
    case CL_INVALID_BUFFER_SIZE:
      return named("a buffer is larger than the device allows");
    case CL_BUILD_PROGRAM_FAILURE:
      return named("the program does not build");
    default:
      return "error " + std::to_string(code);
  }
}

void check(cl_int code, const char* what) {
  if (code == CL_SUCCESS) return;
  const bool memory =
      code == CL_MEM_OBJECT_ALLOCATION_FAILURE || code == CL_OUT_OF_HOST_MEMORY || code == CL_INVALID_BUFFER_SIZE;
  throw EngineError(std::string("OpenCL, ") + what + ": " + words_of(code) +
                    (memory ? "; use fewer rows and columns, or the CPU engine (--engine cpu)"
                            : "; use the CPU engine (--engine cpu)"));
}

Kernel Program::kernel(const char* name) const {
  cl_int code = CL_SUCCESS;
  Kernel kernel(clCreateKernel(program_.get(), name, &code));
  check(code, name);
  return kernel;
}

Device::Device(OpenClDevice facts, const DeviceId& which, const GlContext& gl)
    : facts_(std::move(facts)), id_(which.id), gl_number_(gl.number) {
  cl_int code = CL_SUCCESS;
  context_ = context_with(which.platform, gl);
  if (!context_) context_ = Context(clCreateContext(nullptr, 1, &id_, nullptr, nullptr, &code));
  check(code, "opening the device");
  queue_ = Queue(clCreateCommandQueue(context_.get(), id_, 0, &code));
  check(code, "opening the device");
}

int Device::width(std::size_t bytes) const {
  if (!facts_.processor) return 1;
  const auto what = bytes == sizeof(float) ? CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT : CL_DEVICE_NATIVE_VECTOR_WIDTH_DOUBLE;
  const cl_uint native = number_of<cl_uint>(id_, what);
  constexpr std::array<int, 3> widths{16, 8, 4};
  for (const int width : widths)
    if (cl_uint(width) <= native) return width;
  return 4;
}

std::shared_ptr<const Program> Device::program(const std::string& text, const std::string& options) {
  const std::string key = facts_.platform + '\n' + facts_.name + '\n' + facts_.version + '\n' + facts_.driver + '\n' +
                          options + '\n' + text;
  {
    const std::lock_guard lock(mutex_);
    if (const auto known = programs_.find(key); known != programs_.end()) return known->second;
  }
  auto made = std::make_shared<const Program>(build(text, options, key));  // nobody who has one waits for it
  const std::lock_guard lock(mutex_);
  return programs_.emplace(key, std::move(made)).first->second;
}

void Device::note_run(const std::string& program) {
  const std::lock_guard lock(mutex_);
  run_.insert(program);
}

bool Device::has_run(const std::string& program) {
  const std::lock_guard lock(mutex_);
  return run_.count(program) > 0;
}

ProgramHandle Device::build(const std::string& text, const std::string& options, const std::string& key) const {
  cl_int code = CL_SUCCESS, loaded = CL_SUCCESS;
  // Pocl keeps what it has built by itself, and to be asked for it makes it build every kernel a second time.
  const bool caches = facts_.platform != "Portable Computing Language";
  if (const std::string binary = caches ? kept_on_disk(key) : ""; !binary.empty()) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(binary.data());
    const std::size_t size = binary.size();
    ProgramHandle program(clCreateProgramWithBinary(context_.get(), 1, &id_, &size, &bytes, &loaded, &code));
    if (code == CL_SUCCESS && loaded == CL_SUCCESS &&
        clBuildProgram(program.get(), 1, &id_, options.c_str(), nullptr, nullptr) == CL_SUCCESS)
      return program;
  }
  const char* source = text.c_str();
  ProgramHandle program(clCreateProgramWithSource(context_.get(), 1, &source, nullptr, &code));
  check(code, "making a program");
  code = clBuildProgram(program.get(), 1, &id_, options.c_str(), nullptr, nullptr);
  if (code == CL_BUILD_PROGRAM_FAILURE) {
    constexpr std::size_t most = 600;  // the start of the log: enough to see what is wrong
    std::size_t size = 0;
    clGetProgramBuildInfo(program.get(), id_, CL_PROGRAM_BUILD_LOG, 0, nullptr, &size);
    std::string log(size, '\0');
    clGetProgramBuildInfo(program.get(), id_, CL_PROGRAM_BUILD_LOG, size, log.data(), nullptr);
    throw EngineError("The kernels do not build for " + facts_.name + ": " + trimmed(log).substr(0, most) +
                      suggested_fix);
  }
  check(code, "building a program");
  if (!caches) return program;
  std::size_t size = 0;
  clGetProgramInfo(program.get(), CL_PROGRAM_BINARY_SIZES, sizeof size, &size, nullptr);
  std::string binary(size, '\0');
  auto* bytes = reinterpret_cast<unsigned char*>(binary.data());
  if (size > 0 && clGetProgramInfo(program.get(), CL_PROGRAM_BINARIES, sizeof bytes, &bytes, nullptr) == CL_SUCCESS)
    keep_on_disk(key, binary);
  return program;
}

Memory Device::zeros(std::size_t bytes) const {
  cl_int code = CL_SUCCESS;
  // On a processor the buffer is memory that the program can read where it is.
  const cl_mem_flags where = facts_.shared_memory ? CL_MEM_ALLOC_HOST_PTR : 0;
  Memory memory(clCreateBuffer(context_.get(), CL_MEM_READ_WRITE | where, bytes, nullptr, &code));
  check(code, "allocating a buffer");
  const cl_uint zero = 0;
  const std::size_t whole = bytes / sizeof zero * sizeof zero;
  check(clEnqueueFillBuffer(queue_.get(), memory.get(), &zero, sizeof zero, 0, whole, 0, nullptr, nullptr),
        "clearing a buffer");
  return memory;
}

Memory Device::in_place(void* memory, std::size_t bytes) const {
  cl_int code = CL_SUCCESS;
  Memory buffer(clCreateBuffer(context_.get(), CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR, bytes, memory, &code));
  if (code != CL_SUCCESS) return {};
  void* at = clEnqueueMapBuffer(queue_.get(), buffer.get(), CL_TRUE, CL_MAP_READ, 0, bytes, 0, nullptr, nullptr, &code);
  if (code != CL_SUCCESS) return {};
  clEnqueueUnmapMemObject(queue_.get(), buffer.get(), at, 0, nullptr, nullptr);
  return facts_.processor && at == memory ? std::move(buffer) : Memory();
}

std::shared_ptr<Device> open_device(int number) {
  static std::map<int, std::weak_ptr<Device>> opened;
  std::string problem;
  const std::lock_guard lock(drivers_mutex);
  const std::vector<DeviceId> found = find_devices(problem);
  if (found.empty()) throw EngineError(no_device_words(problem) + " Or use the CPU engine (--engine cpu)");
  if (number >= int(found.size()))
    throw EngineError("There is no OpenCL device " + std::to_string(number) +
                      (found.size() == 1 ? ": the only one is 0"
                                         : ": they are numbered from 0 to " + std::to_string(found.size() - 1)) +
                      suggested_fix);
  if (number < 0) {
    std::vector<OpenClDevice> devices;
    std::transform(found.begin(), found.end(), std::back_inserter(devices), facts_of);
    number = preferred_device(devices);
  }
  auto device = opened[number].lock();
  const GlContext gl = gl_context_in_use();
  if (!device || !device->suits(gl)) {
    const DeviceId& which = found[std::size_t(number)];
    device = std::make_shared<Device>(facts_of(which), which, gl);
    opened[number] = device;
  }
  return device;
}

}  // namespace tyglab::opencl

namespace tyglab {

std::string no_device_words(const std::string& problem) {
  return "No OpenCL device was found" + (problem.empty() ? "" : " (" + problem + ")") + ". " +
         std::string(opencl::how_to_get_a_device());
}

void set_driver_probe(DriverProbe probe) {
  const std::lock_guard lock(opencl::probe_mutex);
  opencl::driver_probe = std::move(probe), opencl::probed_crash.reset();
}

OpenClInventory opencl_devices() {
  OpenClInventory inventory;
  const std::lock_guard lock(opencl::drivers_mutex);
  for (const auto& found : opencl::find_devices(inventory.problem))
    inventory.devices.push_back(opencl::facts_of(found));
  return inventory;
}

}  // namespace tyglab
