
#include "app/cli/commands/commands.h"

#include <iostream>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "app/platform/platform.h"
#include "app/process/child.h"
#include "app/process/process.h"
#include "app/process/program_run.h"
#include "app/render/gl_objects.h"
#include "app/render/mapped_buffer.h"
#include "app/render/written_vertices.h"
#include "core/analysis/machine.h"
#include "core/engines/engine.h"
#include "core/engines/opencl/opencl_devices.h"
#include "core/integrators/scheme.h"
#include "core/io/output_file.h"
#include "core/io/preset_io.h"
#include "core/model/notation.h"
#include "core/model/words.h"
#include "core/simulation.h"

namespace tyglab {
namespace {

void print_cpu() {
  const Machine machine = this_machine();
  std::cout << "CPU engine (--engine cpu)\n";
  for (const Precision precision : {Precision::float_, Precision::double_})
    std::cout << "  " << name_of(precision) << ": " << machine.instruction_set << ", up to "
              << counted(machine.cores, "thread") << '\n';
  std::cout << "  OpenGL: positions are copied into its vertex buffer in every frame in which they moved\n";
}

std::string verdict(const OpenClProbe& probe) {
  if (!probe.offered) return "not offered";
  return probe.problem.empty() ? "works (a test kernel was built, run and checked)" : "fails: " + probe.problem;
}

/// Whether OpenGL here, without a window, lends memory of its own.
bool opengl_lends_memory() {
  try {
    const HeadlessContext context;
    return gl::MappedBuffer::available();
  } catch (const GraphicsError&) {
    return false;
  }
}

/// Has a device write a small cloth into OpenGL's buffer, here without a window. Why that does not work, a part of a
/// sentence; empty: it does.
std::string shared_buffer_problem(int number) {
  try {
    const HeadlessContext context;
    if (const std::string problem = opencl_gl_problem(number); !problem.empty()) return problem;
    Preset preset;
    preset.rows = preset.columns = 8;
    preset.engine = EngineKind::opencl, preset.device = number;
    Simulation simulation(preset);
    WrittenVertices vertices;
    std::size_t looked_at = 0;
    vertices.write(*simulation.engine().vertex_sharing(), {{simulation.lattice(), 1}, true}, looked_at);
    return {};
  } catch (const GraphicsError& error) {
    return std::string("OpenGL is not available without a window: ") + error.what();
  } catch (const EngineError& error) {
    return error.what();
  }
}

/// How positions come to where OpenGL draws them.
std::string sharing(const OpenClDevice& device, int number) {
  static const bool lends = opengl_lends_memory();
  if (opencl_works_in_place(number))
    return lends ? "shared memory: kernels write into its vertex buffer (ARB_buffer_storage), and nothing is copied"
                 : "positions are copied in every frame in which they moved, since this OpenGL has no "
                   "ARB_buffer_storage";
  const std::string problem =
      device.gl_sharing ? shared_buffer_problem(number) : "the device does not support cl_khr_gl_sharing";
  return problem.empty() ? std::string("a shared buffer: kernels write into its vertex buffer (cl_khr_gl_sharing, ") +
                               (device.gl_event ? "ordered by cl_khr_gl_event" : "OpenGL finishes first") +
                               "), and nothing is copied"
                         : "positions are read back and copied in every frame in which they moved: " + problem;
}

void print_device(const OpenClDevice& device, int number) {
  const OpenClProbe single = probe_opencl_device(number, false), twice = probe_opencl_device(number, true);
  std::cout << "\nOpenCL device " << number << ": " << device.name << " (--engine opencl:" << number
            << ")\n  platform: " << device.platform << "\n  version: " << device.version << ", driver " << device.driver
            << "\n  compute units: " << device.compute_units << ", memory: " << (device.memory_bytes >> 20)
            << " MiB\n  float: " << verdict(single) << "\n  double: " << verdict(twice)
            << "\n  OpenGL: " << sharing(device, number) << '\n';
}

std::string names_of_methods(bool that_run) {
  std::vector<std::string_view> names;
  for (const Scheme& method : schemes())
    if (runs_on_opencl(method) == that_run) names.push_back(method.name);
  return joined(names);
}

void print_opencl() {
  const OpenClInventory inventory = opencl_devices();
  for (int n = 0; n < int(inventory.devices.size()); ++n) print_device(inventory.devices[std::size_t(n)], n);
  if (inventory.devices.empty())
    std::cout << '\n' << no_device_words(inventory.problem) << '\n';
  else
    std::cout << "\nOpenCL devices step with " << names_of_methods(true) << ".\nOnly the CPU engine has "
              << names_of_methods(false) << ".\n";
}

int devices() {
  print_cpu();
  if (const std::string death = print_in_child(print_opencl); !death.empty())
    std::cout << "\nAn OpenCL driver of this system crashed (" << death
              << ") while its devices were listed and tested. Pocl does so if /sys is not mounted, if there is no "
                 "linker (apt-get install binutils), or without room in its cache folder. Its output is in "
              << driver_log().string() << ".\n";
  return exit_done;
}

}  // namespace

void add_devices_command(CLI::App& program, Action& action) {
  CLI::App* command = program.add_subcommand("devices", "List the engines and OpenCL devices found, each tested");
  command->footer("Example: tyglab devices");
  command->callback([&action] { action = devices; });
}

void add_try_opencl_command(CLI::App& program, Action& action) {
  struct Options {
    int device = -1;
    bool contacts = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("try-opencl", "Use all kernels for the preset on standard input once");
  command->group("");
  command->add_option("--device", options->device, "Number of the device");
  command->add_flag("--contacts", options->contacts, "With steps that note what bodies stop");
  command->callback([options, &action] {
    action = [options] {
      leave_crashes_to_parent();
      set_program_trial({});  // this is it
      const std::string text{std::istreambuf_iterator<char>(std::cin), {}};
      Preset preset = parse_preset(text, "standard input");
      preset.device = options->device;
      use_all_kernels(preset, options->contacts);
      return int(exit_done);
    };
  });
}

}  // namespace tyglab
