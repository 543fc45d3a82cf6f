#include "app/cli/commands/commands.h"

#include <filesystem>
#include <iostream>
#include <memory>

#include "app/cli/command_line.h"
#include "app/cli/film.h"
#include "app/cli/outputs.h"
#include "app/cli/preset_argument.h"
#include "app/cli/stepping.h"
#include "app/process/interrupt.h"
#include "core/io/output_file.h"
#include "core/io/system_files.h"
#include "core/io/terminal.h"
#include "core/output/obj.h"

namespace tyglab {
namespace fs = std::filesystem;
namespace {

constexpr PictureSize smallest_picture{16, 16};

struct RenderOptions {
  PresetArgument preset;
  Length length;
  int view = 0;
  std::string size = "1280x720";
  std::string png, color;
  std::optional<double> fps;

  /// Where it names one picture.
  std::vector<Output> outputs() const { return {{"--png", png, true}}; }
};

/// Whether --png names a folder for a sequence, rather than one picture.
bool wants_sequence(const RenderOptions& options) {
  if ((is_standard_output(options.png) || os::is_stream(options.png)) && !options.fps) return false;
  const fs::path path(options.png);
  std::error_code error;
  const bool picture = path.extension() == ".png" && !fs::is_directory(path, error);
  if (picture && options.fps)
    throw UsageError("--png " + options.png + ": with --fps, give a folder for the numbered images");
  if (!picture && !options.fps && !path.extension().empty() && !fs::is_directory(path, error))
    throw UsageError("--png " + options.png + ": images are written as F.png; for a sequence give a folder and --fps");
  return !picture;
}

int render(const RenderOptions& options) {
  const ResolvedPreset scene = options.preset.resolve({}, {}, options.length.seconds);
  const std::string& label = scene.source.label;
  if (!options.color.empty() && scene.preset.kind != Kind::cloth)
    throw UsageError("--color: " + in_one_line(label) +
                     " is a mass on a spring, without a cloth to color; leave the option out");
  const RunLength length = length_of(options.length, scene.preset, scene.experiment.get());
  options.length.warn_if_too_short(scene.preset.dt);
  const PictureSize size = parse_size(options.size, smallest_picture);
  const bool sequence = wants_sequence(options);
  FramePlan plan(sequence ? options.fps : std::nullopt, scene.preset.dt, length.of_first_dt);
  if (sequence) {
    make_output_folder("--png", options.png);
  } else {
    check_outputs(options.outputs(), scene.inputs());
  }

  Film film(scene.preset, options.view, size, field_called(options.color));
  Simulation simulation(scene.preset, scene.threads);  // whose device may share buffers with the film's OpenGL
  const InterruptGuard guard;
  std::optional<Playback> playback;
  if (scene.experiment) playback.emplace(scene.experiment->recording);
  Stepper stepper(simulation, length.steps, label, scene.auto_dt, playback ? &*playback : nullptr);
  std::int64_t frame = 0;
  fs::path written = options.png;
  if (sequence) {
    while (frame < plan.count()) {
      const bool there = stepper.advance_to(plan.step_of(frame));
      if (stepper.changed()) {
        plan.follow(stepper.timeline());
        continue;
      }
      if (!there) break;
      film.shoot(simulation, fs::path(options.png) / frame_name(label, frame, plan.count(), "png"));
      ++frame;
    }
  } else {
    do {
      stepper.advance_to(stepper.end());
    } while (stepper.changed());
    if (stepper.interrupted() && takes_long_to_show(simulation))
      end_interrupted("The picture was left out, since a cloth of this size takes long to draw.");
    written = film.shoot(simulation, options.png, stepper.interrupted() ? Reach::stopped : Reach::whole);
  }

  std::ostream& out = people(options.outputs());
  out << in_one_line(label) << ": t = " << simulation.time() << " s. Wrote " << output_name(written);
  if (sequence) out << " (" << counted(frame, "image") << ", " << plan.fps() << " per second)";
  out << '.' << std::endl;
  if (sequence && !stepper.interrupted()) warn_of_older_frames({options.png, label, "png", plan.count(), frame});
  if (simulation.divergence()) {
    std::cerr << "tyglab: " << in_one_line(label) << ' ' << simulation.divergence()->in_words() << '\n';
    return exit_diverged;
  }
  if (!stepper.interrupted()) return exit_done;
  if (takes_long_to_show(simulation)) end_interrupted("");
  std::cerr << "tyglab: Interrupted; images written so far are whole, and no older image was replaced.\n";
  return exit_interrupted;
}

}  // namespace

void add_render_command(CLI::App& program, Action& action) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* command = program.add_subcommand("render", "Draw without a window or a display");
  options->preset.add_to(*command, true);
  options->length.add_to(*command, false);
  command
      ->add_option("--view", options->view,
                   "1 textured triangles, 2 connections, 3 both where torn, 4 outlines, 5 points;\n"
                   "default: the preset's")
      ->type_name("1..5")
      ->transform(whole_number_between(1, 5));
  add_color_option(*command, options->color, false);
  command->add_option("--size", options->size, "Size in pixels (default 1280x720)")->type_name("WxH");
  add_output(*command, "--png", options->png,
             "The image (- is standard output), or a folder for a sequence: DIR/PRESET_0000.png, …")
      ->type_name("F.png|DIR")
      ->required();
  command->add_option("--fps", options->fps, "Write a sequence with this many images per second of simulated time")
      ->type_name("F")
      ->transform(number_between(1e-6, 1e7, "frames per second"));
  command->footer(
      "Examples: tyglab render flag --seconds 3 --view 1 --size 1920x1080 --png flag.png\n"
      "          tyglab render hanging --seconds 0.4 --color strain --png strain.png\n"
      "          tyglab render denim --seconds 4 --png frames --fps 25\n"
      "          tyglab render demo.tyglab --png film --fps 25");
  command->callback([options, &action] { action = [options] { return render(*options); }; });
}

}  // namespace tyglab
