// A layer of the OpenCL loader (OPENCL_LAYERS) that lets the devices below it look like graphics cards that share
// buffers with OpenGL (cl_khr_gl_sharing, cl_khr_gl_event). Shared buffers are ordinary ones, whose content goes from
// and to OpenGL's when they are acquired and released. What the extensions forbid ends the program with a sentence.
//
// TYGLAB_GL_DOUBLE, looked at in every call, holds some of these words:
//   no_events       cl_khr_gl_event is not offered: what is written reaches OpenGL with clFinish
//   refuse_context  no context is made together with OpenGL's
//   other_device    OpenGL draws on another device
//   loses_writes    what is written never reaches OpenGL
#define CL_TARGET_OPENCL_VERSION 300
#include "tests/support/gl_sharing_double.h"

#include <CL/cl_gl.h>
#include <CL/cl_layer.h>
#include <EGL/egl.h>
#include <glad/gl.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

namespace {

using Properties = const cl_context_properties*;

const cl_icd_dispatch* below;
cl_icd_dispatch mine;
std::recursive_mutex mutex;

struct Shared {
  cl_context context;
  GLuint name;
  std::size_t bytes;
  bool acquired = false;
};
std::map<cl_mem, Shared> shared;
std::set<cl_context> gl_contexts;
std::map<cl_kernel, std::map<cl_uint, cl_mem>> arguments;
std::vector<cl_mem> released;  ///< not in OpenGL's buffer yet
tyglab::test::GlDoubleCounts counts;

bool told(const char* word) {
  const char* words = std::getenv("TYGLAB_GL_DOUBLE");
  return words != nullptr && std::strstr(words, word) != nullptr;
}

void must(bool right, const char* rule) {
  if (right) return;
  std::fprintf(stderr, "gl_sharing_double: %s\n", rule);
  std::abort();
}

template <class Function>
Function gl(const char* name) {
  const auto function = reinterpret_cast<Function>(eglGetProcAddress(name));
  must(function != nullptr, "OpenGL lacks a function");
  return function;
}

/// OpenGL's buffer bound where the program binds none.
class Bound {
 public:
  explicit Bound(GLuint name) {
    static const auto bind = gl<PFNGLBINDBUFFERPROC>("glBindBuffer");
    bind(GL_COPY_WRITE_BUFFER, name);
  }
  std::size_t bytes() const {
    static const auto get = gl<PFNGLGETBUFFERPARAMETERIVPROC>("glGetBufferParameteriv");
    GLint size = 0;
    get(GL_COPY_WRITE_BUFFER, GL_BUFFER_SIZE, &size);
    return std::size_t(size);
  }
  void read(std::vector<char>& to) const {
    static const auto get = gl<PFNGLGETBUFFERSUBDATAPROC>("glGetBufferSubData");
    get(GL_COPY_WRITE_BUFFER, 0, GLsizeiptr(to.size()), to.data());
  }
  void write(const std::vector<char>& from) const {
    static const auto set = gl<PFNGLBUFFERSUBDATAPROC>("glBufferSubData");
    set(GL_COPY_WRITE_BUFFER, 0, GLsizeiptr(from.size()), from.data());
  }
};

bool is_buffer(GLuint name) {
  static const auto is = gl<PFNGLISBUFFERPROC>("glIsBuffer");
  return is(name) != 0;
}

void must_be_acquired(cl_mem memory) {
  const std::lock_guard lock(mutex);
  const auto object = shared.find(memory);
  must(object == shared.end() || object->second.acquired, "a shared buffer is used that has not been acquired");
}

cl_int answer(const void* value, std::size_t size, std::size_t room, void* to, std::size_t* size_to) {
  if (to != nullptr && room < size) return CL_INVALID_VALUE;
  if (to != nullptr) std::memcpy(to, value, size);
  if (size_to != nullptr) *size_to = size;
  return CL_SUCCESS;
}

cl_int CL_API_CALL device_info(cl_device_id device, cl_device_info what, std::size_t room, void* to,
                               std::size_t* size_to) {
  if (what == CL_DEVICE_TYPE) {
    const cl_device_type type = CL_DEVICE_TYPE_GPU;
    return answer(&type, sizeof type, room, to, size_to);
  }
  if (what == CL_DEVICE_HOST_UNIFIED_MEMORY) {
    const cl_bool no = CL_FALSE;
    return answer(&no, sizeof no, room, to, size_to);
  }
  if (what != CL_DEVICE_EXTENSIONS) return below->clGetDeviceInfo(device, what, room, to, size_to);
  std::size_t size = 0;
  below->clGetDeviceInfo(device, what, 0, nullptr, &size);
  std::string names(size, '\0');
  below->clGetDeviceInfo(device, what, size, names.data(), nullptr);
  names.resize(std::strlen(names.c_str()));
  names += told("no_events") ? " cl_khr_gl_sharing" : " cl_khr_gl_sharing cl_khr_gl_event";
  return answer(names.c_str(), names.size() + 1, room, to, size_to);
}

/// The properties without OpenGL's; whether there were some.
bool take_out_gl(Properties properties, std::vector<cl_context_properties>& rest) {
  bool context = false, display = false;
  for (; properties != nullptr && *properties != 0; properties += 2) {
    if (properties[0] == CL_GL_CONTEXT_KHR) {
      context = properties[1] != 0;
      const EGLContext current = eglGetCurrentContext();
      must(current == EGL_NO_CONTEXT || reinterpret_cast<cl_context_properties>(current) == properties[1],
           "another OpenGL context is named than the current one");
    } else if (properties[0] == CL_EGL_DISPLAY_KHR || properties[0] == CL_GLX_DISPLAY_KHR) {
      display = properties[1] != 0;
    } else {
      rest.insert(rest.end(), {properties[0], properties[1]});
    }
  }
  rest.push_back(0);
  must(context == display, "an OpenGL context and its display are named together or not at all");
  return context;
}

cl_context CL_API_CALL create_context(Properties properties, cl_uint count, const cl_device_id* devices,
                                      void(CL_CALLBACK* notify)(const char*, const void*, std::size_t, void*),
                                      void* data, cl_int* code) {
  std::vector<cl_context_properties> rest;
  const bool with_gl = take_out_gl(properties, rest);
  if (with_gl && told("refuse_context")) {
    *code = CL_INVALID_OPERATION;
    return nullptr;
  }
  cl_context context =
      below->clCreateContext(rest.size() > 1 ? rest.data() : nullptr, count, devices, notify, data, code);
  const std::lock_guard lock(mutex);
  if (with_gl && context != nullptr) gl_contexts.insert(context), ++counts.contexts;
  return context;
}

cl_int CL_API_CALL release_context(cl_context context) {
  const std::lock_guard lock(mutex);
  if (gl_contexts.erase(context) > 0) {
    for (const auto& [memory, object] : shared)
      must(object.context != context, "a context goes before its shared buffers");
    --counts.contexts;
  }
  return below->clReleaseContext(context);
}

cl_int CL_API_CALL gl_context_info(Properties properties, cl_gl_context_info what, std::size_t room, void* to,
                                   std::size_t* size_to) {
  std::vector<cl_context_properties> rest;
  if (!take_out_gl(properties, rest)) return CL_INVALID_GL_SHAREGROUP_REFERENCE_KHR;
  must(rest.size() == 3 && rest[0] == CL_CONTEXT_PLATFORM, "the platform is named");
  std::vector<cl_device_id> devices(8);
  cl_uint count = 0;
  if (!told("other_device"))
    below->clGetDeviceIDs(reinterpret_cast<cl_platform_id>(rest[1]), CL_DEVICE_TYPE_ALL, 8, devices.data(), &count);
  if (what == CL_CURRENT_DEVICE_FOR_GL_CONTEXT_KHR) count = count > 0 ? 1 : 0;
  return answer(devices.data(), count * sizeof(cl_device_id), room, to, size_to);
}

void* CL_API_CALL function_address(cl_platform_id platform, const char* name) {
  if (std::strcmp(name, "clGetGLContextInfoKHR") == 0) return reinterpret_cast<void*>(gl_context_info);
  return below->clGetExtensionFunctionAddressForPlatform(platform, name);
}

cl_mem CL_API_CALL create_from_gl(cl_context context, cl_mem_flags flags, cl_GLuint name, cl_int* code) {
  const std::lock_guard lock(mutex);
  must(gl_contexts.count(context) > 0, "a buffer is shared by a context that was made without OpenGL's");
  must(is_buffer(name), "OpenGL has no such buffer");
  const std::size_t bytes = Bound(name).bytes();
  must(bytes > 0, "OpenGL's buffer has no storage");
  cl_mem memory = below->clCreateBuffer(context, flags, bytes, nullptr, code);
  if (memory != nullptr) shared[memory] = {context, name, bytes}, ++counts.buffers;
  return memory;
}

cl_int CL_API_CALL release_memory(cl_mem memory) {
  const std::lock_guard lock(mutex);
  if (const auto object = shared.find(memory); object != shared.end()) {
    must(!object->second.acquired, "a buffer goes that is still acquired");
    must(is_buffer(object->second.name), "OpenGL's buffer went before the one that shares it");
    for (auto& [kernel, list] : arguments)
      for (auto& [index, argument] : list)
        if (argument == memory) argument = nullptr;
    shared.erase(object), --counts.buffers;
  }
  return below->clReleaseMemObject(memory);
}

Shared& shared_one(cl_mem memory) {
  const auto object = shared.find(memory);
  must(object != shared.end(), "what is acquired or released is a shared buffer");
  return object->second;
}

cl_int CL_API_CALL acquire(cl_command_queue queue, cl_uint count, const cl_mem* objects, cl_uint, const cl_event*,
                           cl_event*) {
  const std::lock_guard lock(mutex);
  for (cl_uint n = 0; n < count; ++n) {
    Shared& object = shared_one(objects[n]);
    must(!object.acquired, "a buffer is acquired twice");
    std::vector<char> content(object.bytes);
    Bound(object.name).read(content);
    below->clEnqueueWriteBuffer(queue, objects[n], CL_TRUE, 0, content.size(), content.data(), 0, nullptr, nullptr);
    object.acquired = true;
  }
  ++counts.acquired;
  return CL_SUCCESS;
}

void hand_over(cl_command_queue queue) {
  for (cl_mem memory : released) {
    const Shared& object = shared_one(memory);
    std::vector<char> content(object.bytes);
    below->clEnqueueReadBuffer(queue, memory, CL_TRUE, 0, content.size(), content.data(), 0, nullptr, nullptr);
    if (!told("loses_writes")) Bound(object.name).write(content);
  }
  released.clear();
}

cl_int CL_API_CALL release(cl_command_queue queue, cl_uint count, const cl_mem* objects, cl_uint, const cl_event*,
                           cl_event*) {
  const std::lock_guard lock(mutex);
  for (cl_uint n = 0; n < count; ++n) {
    Shared& object = shared_one(objects[n]);
    must(object.acquired, "a buffer is released that has not been acquired");
    object.acquired = false;
    released.push_back(objects[n]);
  }
  if (!told("no_events")) hand_over(queue);
  return CL_SUCCESS;
}

cl_int CL_API_CALL finish(cl_command_queue queue) {
  const std::lock_guard lock(mutex);
  const cl_int code = below->clFinish(queue);
  hand_over(queue);
  return code;
}

cl_int CL_API_CALL set_argument(cl_kernel kernel, cl_uint index, std::size_t size, const void* value) {
  const std::lock_guard lock(mutex);
  cl_mem memory = nullptr;
  if (value != nullptr && size == sizeof memory) std::memcpy(&memory, value, size);
  arguments[kernel][index] = shared.count(memory) > 0 ? memory : nullptr;
  return below->clSetKernelArg(kernel, index, size, value);
}

cl_int CL_API_CALL release_kernel(cl_kernel kernel) {
  const std::lock_guard lock(mutex);
  arguments.erase(kernel);
  return below->clReleaseKernel(kernel);
}

cl_int CL_API_CALL start_kernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions, const std::size_t* offset,
                                const std::size_t* global, const std::size_t* local, cl_uint waits,
                                const cl_event* list, cl_event* event) {
  {
    const std::lock_guard lock(mutex);
    for (const auto& [index, memory] : arguments[kernel])
      if (memory != nullptr) must_be_acquired(memory);
  }
  return below->clEnqueueNDRangeKernel(queue, kernel, dimensions, offset, global, local, waits, list, event);
}

cl_int CL_API_CALL read_buffer(cl_command_queue queue, cl_mem memory, cl_bool blocking, std::size_t offset,
                               std::size_t size, void* to, cl_uint waits, const cl_event* list, cl_event* event) {
  must_be_acquired(memory);
  counts.read += size;
  return below->clEnqueueReadBuffer(queue, memory, blocking, offset, size, to, waits, list, event);
}

cl_int CL_API_CALL read_rectangle(cl_command_queue queue, cl_mem memory, cl_bool blocking, const std::size_t* from,
                                  const std::size_t* at, const std::size_t* region, std::size_t pitch,
                                  std::size_t slice, std::size_t host_pitch, std::size_t host_slice, void* to,
                                  cl_uint waits, const cl_event* list, cl_event* event) {
  must_be_acquired(memory);
  counts.read += region[0] * region[1] * region[2];
  return below->clEnqueueReadBufferRect(queue, memory, blocking, from, at, region, pitch, slice, host_pitch, host_slice,
                                        to, waits, list, event);
}

void* CL_API_CALL map_buffer(cl_command_queue queue, cl_mem memory, cl_bool blocking, cl_map_flags flags,
                             std::size_t offset, std::size_t size, cl_uint waits, const cl_event* list, cl_event* event,
                             cl_int* code) {
  must_be_acquired(memory);
  counts.read += size;
  return below->clEnqueueMapBuffer(queue, memory, blocking, flags, offset, size, waits, list, event, code);
}

cl_int CL_API_CALL copy_buffer(cl_command_queue queue, cl_mem from, cl_mem to, std::size_t from_offset,
                               std::size_t to_offset, std::size_t size, cl_uint waits, const cl_event* list,
                               cl_event* event) {
  must_be_acquired(from), must_be_acquired(to);
  return below->clEnqueueCopyBuffer(queue, from, to, from_offset, to_offset, size, waits, list, event);
}

}  // namespace

extern "C" tyglab::test::GlDoubleCounts tyglab_gl_double_counts() {
  const std::lock_guard lock(mutex);
  return counts;
}

extern "C" cl_int clGetLayerInfo(cl_layer_info what, std::size_t room, void* to, std::size_t* size_to) {
  const cl_layer_api_version version = CL_LAYER_API_VERSION_100;
  return what == CL_LAYER_API_VERSION ? answer(&version, sizeof version, room, to, size_to) : CL_INVALID_VALUE;
}

extern "C" cl_int clInitLayer(cl_uint entries, const cl_icd_dispatch* target, cl_uint* own_entries,
                              const cl_icd_dispatch** own) {
  if (entries < sizeof mine / sizeof(void*)) return CL_INVALID_VALUE;
  below = target;
  mine = *target;
  mine.clGetDeviceInfo = device_info;
  mine.clCreateContext = create_context, mine.clReleaseContext = release_context;
  mine.clGetGLContextInfoKHR = gl_context_info;
  mine.clGetExtensionFunctionAddressForPlatform = function_address;
  mine.clCreateFromGLBuffer = create_from_gl, mine.clReleaseMemObject = release_memory;
  mine.clEnqueueAcquireGLObjects = acquire, mine.clEnqueueReleaseGLObjects = release, mine.clFinish = finish;
  mine.clSetKernelArg = set_argument, mine.clReleaseKernel = release_kernel;
  mine.clEnqueueNDRangeKernel = start_kernel;
  mine.clEnqueueReadBuffer = read_buffer, mine.clEnqueueReadBufferRect = read_rectangle;
  mine.clEnqueueMapBuffer = map_buffer, mine.clEnqueueCopyBuffer = copy_buffer;
  *own = &mine;
  *own_entries = sizeof mine / sizeof(void*);
  return CL_SUCCESS;
}
