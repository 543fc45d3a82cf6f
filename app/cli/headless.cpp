#include "app/cli/film.h"

#include <iostream>

#include "app/base/frame_costs.h"
#include "app/cli/command_line.h"
#include "app/cli/stepping.h"
#include "app/process/interrupt.h"
#include "core/io/output_file.h"
#include "core/io/terminal.h"
#include "core/output/obj.h"
#include "core/output/state_csv.h"

namespace tyglab {
namespace fs = std::filesystem;
namespace {

constexpr double usual_seconds = 4;
constexpr double frames_a_second = 60;  // of the window that is not there
constexpr int pictures = 5;             // the first at the start, the last at the end

/// Makes the first of tyglab-out, tyglab-out-2, … that is not there yet.
fs::path new_folder() {
  fs::path folder = "tyglab-out";
  std::error_code error;
  for (int n = 2; !fs::create_directory(folder, error); ++n) {
    if (!fs::exists(fs::symlink_status(folder)))
      throw OutputError(folder.string() + ": the folder cannot be created: " + error.message());
    folder = "tyglab-out-" + std::to_string(n);
  }
  return folder;
}

}  // namespace

int run_headless(const SandboxOptions& options, std::ostream& out) {
  const double seconds = options.frames > 0 ? options.frames / frames_a_second : usual_seconds;
  const std::int64_t steps = Length{seconds, {}}.in_steps(options.preset.dt, seconds);
  const PictureSize size = options.width > 0 ? PictureSize{options.width, options.height} : PictureSize();
  Film film(options.preset, 0, size, options.color);
  Simulation simulation(options.preset, options.threads);
  const fs::path folder = new_folder();
  std::cerr << "There is no display here, so Tyglab runs without a window: it simulates and draws '"
            << in_one_line(options.preset_label) << "' into the new folder " << folder.string() << ".\n";
  if (options.frames > 0)
    std::cerr << "--frames " << options.frames << " is interpreted as " << seconds << " s of simulated time, at "
              << frames_a_second << " frames per second.\n";
  const InterruptGuard guard;
  Stepper stepper(simulation, steps, options.preset_label, options.auto_dt);
  FrameCosts costs;

  bool going = true;
  for (int k = 0; k < pictures && going; ++k) {
    const FrameCosts::Timer frame(costs, Part::frame);
    {
      const FrameCosts::Timer simulate(costs, Part::simulate);
      const std::int64_t before = simulation.steps();
      do {
        going = stepper.advance_to(stepper.timeline().step_at(seconds * k / (pictures - 1)));
      } while (stepper.changed());
      costs.add_steps(simulation.steps() - before);
    }
    if (stepper.interrupted() && takes_long_to_show(simulation))
      end_interrupted("The last picture and the state were left out, since a cloth of this size takes long to show.");
    const FrameCosts::Timer draw(costs, Part::draw_cloth);
    const fs::path file = folder / frame_name(options.preset_label, k, pictures, "png");
    film.shoot(simulation, file);
    out << "Wrote " << output_name(file) << " (t = " << simulation.time() << " s)." << std::endl;
  }
  const fs::path state = folder / (options.preset_label + ".csv");
  write_output(state, state_csv(simulation));
  out << "Wrote " << output_name(state) << ", the last state." << std::endl;
  if (!options.screenshot.empty()) {
    film.shoot(simulation, options.screenshot);
    out << "Wrote " << output_name(options.screenshot) << '.' << std::endl;
  }
  if (!options.time_report.empty()) {
    write_output(options.time_report,
                 costs.json(size.width, size.height, simulation.engine().name(), options.preset_label));
    out << "Wrote " << output_name(options.time_report) << '.' << std::endl;
  }
  if (simulation.divergence())
    std::cerr << "tyglab: " << in_one_line(options.preset_label) << ' ' << simulation.divergence()->in_words() << '\n';
  if (!stepper.interrupted()) return exit_done;
  std::cerr << "tyglab: Interrupted; the files named above are complete.\n";
  return exit_interrupted;
}

}  // namespace tyglab
