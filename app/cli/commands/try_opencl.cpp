#include "app/cli/commands/try_opencl.h"

#include <iostream>
#include <iterator>
#include <memory>

#include "app/process/memory_limit.h"
#include "app/process/program_trial.h"
#include "core/engines/opencl/opencl_devices.h"
#include "core/io/preset_io.h"

namespace tyglab {

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
