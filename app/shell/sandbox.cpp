#include "app/shell/sandbox.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <future>
#include <limits>

#include "app/cli/interrupt.h"
#include "app/process/kernel_prebuild.h"
#include "app/render/graphics_error.h"
#include "app/session/document.h"
#include "app/session/engine_fallback.h"
#include "app/session/sampling.h"
#include "app/shell/start.h"
#include "app/shell/window.h"
#include "app/tools/knife.h"
#include "app/ui/app.h"
#include "app/ui/frame/keys.h"
#include "app/ui/frame/panels.h"
#include "app/ui/frame/tour.h"
#include "core/engines/opencl/opencl_devices.h"
#include "core/io/destination.h"
#include "core/io/files.h"
#include "core/io/preset_io.h"
#include "core/theory/advice.h"

namespace tyglab {
namespace {

enum ExitCode { done = 0, no_device = 5, no_output = 6, interrupted = 130 };

constexpr double scripted_frame = 1.0 / 60;  // s; with --frames the same frames come on every machine
constexpr double settle_time = 0.3;          // s after an event
constexpr double gesture_end = 0.6;          // s without a change
constexpr float text_scale_least = 0.5f, text_scale_most = 6;

/// The cloth that is shown first.
struct First {
  std::unique_ptr<Simulation> simulation;
  std::string fallback;  ///< why it runs on another engine than it asks for; empty: it does not
  FoundPicture picture;
};

/// Whether the preset's device can share buffers with OpenGL, and so is to be opened once there is a window.
bool needs_window(const Preset& preset) {
  return preset.engine == EngineKind::opencl && opencl_offers_gl_sharing(preset.device);
}

class Sandbox {
 public:
  explicit Sandbox(const SandboxOptions& options);
  ~Sandbox() {  // while the window's context lives; first who works in its memory
    app_.copies.lockstep.clear(), app_.simulation.reset();
    app_.views = {}, app_.renderer.reset();
  }
  Sandbox(const Sandbox&) = delete;
  Sandbox& operator=(const Sandbox&) = delete;
  int run();

 private:
  bool restores() const { return !options_.explicit_preset && !app_.scripted && app_.settings.session.has_value(); }
  const Preset& first_preset() const { return restores() ? app_.settings.session->preset : options_.preset; }
  void start_preset();
  Document first_document();
  void frame();
  void frame_parts();
  void wait_for_events();
  bool due();
  void plan_next_frame();
  void take_dropped_files();
  void rescale();
  void simulate(double real_seconds);
  void draw_cloth();
  void draw_panels();
  void present();
  void save_picture();
  int write_outputs();
  void remember();
  bool idle() const;

  SandboxOptions options_;
  App app_;
  std::future<First> first_;  ///< the first cloth, built while the window opens
  Window window_;
  Gui gui_;
  int frames_ = 0;
  int busy_frames_ = 4;      ///< Dear ImGui needs a few frames after an event to settle
  double settle_until_ = 0;  ///< s, and some time, to fade what it fades
  double last_time_ = 0;
  Image last_picture_;
};

Sandbox::Sandbox(const SandboxOptions& options)
    : options_(options),
      app_(start_app(options)),
      first_(std::async(std::launch::async,
                        [preset = first_preset(), options] {
                          First first;
                          if (!needs_window(preset)) {
                            first.simulation = make_simulation(preset, options.threads, first.fallback);
                            run_programs_once(first.simulation->preset(), false);  // the first frames do not wait
                          }
                          first.picture = find_picture(preset);
                          return first;
                        })),
      window_(options.width, options.height, app_.settings, app_.input),
      gui_(window_.handle()) {
  app_.costs.started(StartPart::window);
  glfwSwapInterval(app_.scripted ? 0 : 1);
  app_.renderer = std::make_unique<ClothRenderer>();
  app_.costs.started(StartPart::shaders);
  start_preset();
  app_.costs.started(StartPart::cloth);
  last_time_ = glfwGetTime();
}

void Sandbox::start_preset() {
  First first = first_.get();
  if (!first.simulation) first.simulation = make_simulation(first_preset(), options_.threads, first.fallback);
  if (!first.fallback.empty()) app_.messages.warning(first.fallback);
  app_.simulation = std::move(first.simulation);
  app_.building.prepare_programs = prepare_programs;
  begin_document(app_, first_document(), first.picture);
  if (options_.auto_dt) app_.auto_dt.emplace();
  if (!app_.scripted && !options_.explicit_preset && !app_.settings.tour_seen) start_tour(app_);
}

Document Sandbox::first_document() {
  if (!restores()) return {options_.preset, options_.preset_label, options_.preset_path};
  const Session& session = *app_.settings.session;
  // What was saved is on disk; where it is gone, the session itself is all there is.
  try {
    return {session.file.empty() ? session.saved : load_preset(session.file), session.label, session.file};
  } catch (const std::exception& error) {
    app_.messages.warning(std::string(error.what()) + " The last session's state is shown; save it under a name.");
    return {app_.preset(), session.label, {}};
  }
}

bool Sandbox::idle() const {
  const bool over = app_.simulation->divergence().has_value() && !app_.copies.lockstep.alive();
  const bool still = !app_.pacing.playing || over || app_.asleep();
  return still && !app_.scripted && !app_.building.busy() && !app_.engine_search.busy() && busy_frames_ <= 0 &&
         glfwGetTime() >= settle_until_ && app_.requests.empty() && app_.tool.kind == Tool::Kind::none;
}

void Sandbox::wait_for_events() {
  if (window_.iconified()) {
    glfwWaitEventsTimeout(0.5);
  } else if (idle()) {
    const double longest = app_.report ? 0.1 : 0.5;  // a report is due; Ctrl-C is seen
    const double wait = std::min(app_.ui.draw_by - glfwGetTime(), longest);
    wait > 0 ? glfwWaitEventsTimeout(wait) : glfwPollEvents();
  } else {
    glfwPollEvents();
  }
  busy_frames_ = app_.input.anything || app_.input.unshown ? 4 : std::max(busy_frames_ - 1, 0);
  if (app_.input.anything) settle_until_ = glfwGetTime() + settle_time;
}

/// Whether there is anything that a new frame would show.
bool Sandbox::due() {
  if (window_.framebuffer_size().x == 0) return false;
  return !idle() || app_.input.anything || app_.report != nullptr || glfwGetTime() >= app_.ui.draw_by;
}

/// When a frame is wanted again though nothing moves; the panels have said what they want of it.
void Sandbox::plan_next_frame() {
  const bool cursor_blinks = app_.ui.slider.typing != 0 || ImGui::GetIO().WantTextInput;
  if (cursor_blinks) app_.ui.draw_by = std::min(app_.ui.draw_by, app_.ui.now + 0.25);
  app_.ui.draw_by = std::min(app_.ui.draw_by, app_.messages.next_end() + 0.01);
}

void Sandbox::take_dropped_files() {
  for (const std::string& name : app_.input.dropped) {
    const std::filesystem::path file(name);
    if (file.extension() == ".json") {
      app_.request(request::Open{.file = file});
    } else {
      app_.request(request::LoadTexture{name});
    }
  }
}

void Sandbox::rescale() {
  if (app_.input.scale_changed) app_.scale_changed = true;
  if (!app_.scale_changed) return;
  app_.scale_changed = false;
  const Look& look = tyglab::look(app_.settings.theme);
  app_.theme.colors = look.tokens();
  app_.view.palette = look.tokens == light_tokens ? light_palette : Palette{};
  const float scale = window_.content_scale() * float(app_.settings.ui_scale) * look.magnified;
  app_.theme.scale = std::clamp(scale, text_scale_least, text_scale_most);
  const bool first = app_.fonts.text == nullptr;
  app_.fonts = build_fonts(app_.theme.scale);
  apply_style(app_.theme);
  if (!first) gui_.fonts_changed();
  if (first)
    for (const std::string& note : app_.fonts.notes) std::fprintf(stderr, "tyglab: %s\n", note.c_str());
}

void Sandbox::simulate(double real_seconds) {
  const FrameCosts::Timer timer(app_.costs, Part::simulate);
  Simulation& simulation = *app_.simulation;
  app_.sleep.begin(simulation);
  if (const bool wanted = app_.ui.energy_shown || app_.auto_dt; wanted != simulation.ledger().has_value())
    if (!wanted || app_.building.ledger_ready(app_)) simulation.enable_ledger(wanted);
  if (!app_.pacing.playing || app_.asleep() || app_.building.holds_present() || app_.engine_search.busy()) return;
  const double dt = app_.preset().dt;
  app_.pacing.slow(app_.settings.handling.slow_hand && hand_in_cloth(app_) ? Pacing::slow_motion : 1);
  if (simulation.divergence()) {
    if (app_.copies.lockstep.alive()) app_.steps_made += copies_go_on(app_, app_.pacing.due(real_seconds, dt));
    return;
  }
  app_.rewind.look(simulation);
  const int due = up_to_stop(app_, app_.pacing.due(real_seconds, dt));
  move_hand(app_, due);
  const auto start = std::chrono::steady_clock::now();
  const auto spent = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  int made = 0;
  // Where drawing alone takes longer than the display's frame (waiting for the display is none of it), steps may cost
  // as much again: they no longer decide whether the window keeps up.
  double beside_ms = app_.costs.recent_ms(Part::frame);
  for (const Part part : {Part::simulate, Part::swap}) beside_ms -= app_.costs.recent_ms(part);
  const bool slow = beside_ms > 1e3 * window_.frame_time();
  app_.pacing.budget_s = slow ? std::min(1e-3 * beside_ms, 0.2) : Pacing::usual_budget_s;
  // In pieces, so that a wrong guess of a step's cost cannot hold the window up.
  while (made < due && !simulation.divergence() && (made == 0 || spent() < app_.pacing.budget_s)) {
    const double cost = app_.pacing.step_cost_s();
    const bool cutting = cuts_between_steps(app_);
    const int piece = cost > 0 && !cutting ? std::clamp(int(0.25 * app_.pacing.budget_s / cost), 1, due - made) : 1;
    const double before = spent();
    const Advance advance = simulation.advance(piece);
    made += advance.steps;
    copies_follow(app_, spent() - before);
    cut_between_steps(app_);
    if (advance.left_inside > 0 && !app_.warned_left_inside) {
      app_.messages.note("Overlapping bodies leave some particles inside one of them; move the bodies apart.");
      app_.warned_left_inside = true;
    }
    if (simulation.engine().solves().unconverged > 0 && !app_.warned_unconverged) {
      app_.messages.warning(
          "Newton's method does not reach its tolerance, so this is not quite the method's motion. Take a smaller dt "
          "or "
          "k_s.");
      app_.warned_unconverged = true;
    }
    if (const std::string missed = tolerance_missed(simulation.preset(), simulation.engine().inner_steps());
        !missed.empty() && !app_.warned_unconverged) {
      app_.messages.warning(missed);
      app_.warned_unconverged = true;
    }
    if (advance.released) app_.messages.note("The hand let go: its force exceeded F_release.");
    if (advance.steps < piece) break;
  }
  app_.pacing.made(made, dt, spent());
  app_.steps_made += made;
  pause_at_stop(app_);
  if (app_.auto_dt && !simulation.divergence()) watch_dt(app_);
  if (!app_.scripted) app_.sleep.look(simulation, app_.tool.kind != Tool::Kind::none || !app_.copies.lockstep.empty());
}

void Sandbox::draw_cloth() {
  const glm::ivec2 window = window_.size(), framebuffer = window_.framebuffer_size();
  app_.views.draw(app_, window.x > 0 ? glm::vec2(framebuffer) / glm::vec2(window) : glm::vec2(1));
}

void Sandbox::draw_panels() {
  const FrameCosts::Timer timer(app_.costs, Part::panels);
  SliderState& slider = app_.ui.slider;
  slider.order = 0;
  slider.focused_seen = false;
  app_.ui.hover_seen = false;
  gui_.begin_frame(app_.input);
  draw_layout(app_, ImGui::GetIO().DisplaySize);
  // A slider that is no longer drawn (folded, hidden) gives its keys back; so does one when the cloth is pressed.
  if (!slider.focused_seen || app_.tool.kind != Tool::Kind::none) slider.focused = 0, slider.focused_order = -1;
  slider.wanted_order = -1;
  slider.keys.clear();
  if (slider.typing == 0 || !app_.input.unread) slider.commit = slider.cancel = false;
  app_.ui.close_lists = false;
  if (!app_.ui.hover_seen) app_.ui.hovered = 0;
}

void Sandbox::present() {
  {
    const FrameCosts::Timer timer(app_.costs, Part::ui_draw);
    const glm::ivec2 size = window_.framebuffer_size();
    glViewport(0, 0, size.x, size.y);
    const ImVec4 ground = ImGui::ColorConvertU32ToFloat4(app_.theme.colors.ground);
    glClearColor(ground.x, ground.y, ground.z, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    gui_.draw();
  }
  if (app_.picture) return save_picture();
  if (frames_ + 1 == options_.frames && !options_.screenshot.empty()) last_picture_ = window_.pixels();
  const FrameCosts::Timer timer(app_.costs, Part::swap);
  glfwSwapBuffers(window_.handle());
}

/// Of the frame that has just been drawn, which is not shown: the viewport has no buttons in it.
void Sandbox::save_picture() {
  const request::SavePicture wanted = *std::exchange(app_.picture, std::nullopt);
  busy_frames_ = 2;
  Image image = window_.pixels();
  if (!wanted.whole_window) {
    const glm::vec2 scale = glm::vec2(image.width, image.height) / glm::vec2(window_.size());
    image = cropped(image, glm::round(app_.viewport.box.lo * scale), glm::round(app_.viewport.box.hi * scale));
  }
  try {
    write_png(wanted.file, image);
    app_.messages.note("Wrote " + wanted.file.string());
  } catch (const OutputError& error) {
    app_.messages.error(error.what());
  }
}

void Sandbox::frame() {
  {
    const FrameCosts::Timer timer(app_.costs, Part::frame);
    frame_parts();
  }
  app_.costs.end_frame();
  if (frames_ == 1) app_.costs.started(StartPart::first_frame);
}

void Sandbox::frame_parts() {
  const double now = glfwGetTime();
  const double elapsed = app_.scripted ? scripted_frame : now - last_time_;
  // Events carry the time at which they were polled, so two clicks of one gesture may be a frame apart.
  app_.input.double_click_s = std::max(0.4, 1.5 * (now - last_time_));
  last_time_ = now;
  app_.ui.now = now;
  app_.ui.draw_by = std::numeric_limits<double>::infinity();
  app_.steps_made = 0;
  app_.full_screen = window_.full_screen();
  if (window_.wants_close()) window_.forget_close(), app_.request(request::Quit{});
  rescale();
  take_dropped_files();
  app_.building.poll(app_);
  app_.engine_search.poll(app_);
  handle_keys(app_);
  apply_requests(app_);
  handle_pointer(app_);
  if (app_.toggle_full_screen) window_.toggle_full_screen(), app_.toggle_full_screen = false;
  try {
    simulate(elapsed);
  } catch (const EngineError& error) {
    fall_back(app_, error.what());
  }
  app_.costs.add_steps(app_.steps_made);
  sample(app_);
  watch_lab(app_);
  draw_cloth();
  draw_panels();
  if (!app_.ui.accuracy_shown || app_.convergence.shown) app_.accuracy.drop();
  if (!app_.ui.accuracy_shown || !app_.convergence.shown) app_.convergence.drop();
  if (!app_.ui.map_shown) app_.map.drop();
  if (!app_.ui.inside_shown) app_.inside.drop();
  present();
  const bool quiet = !ImGui::IsAnyItemActive() && app_.tool.kind == Tool::Kind::none;
  if (quiet && now - app_.ui.last_change > gesture_end) app_.history.end_gesture();
  window_.set_title((unsaved(app_) ? "• " : "") + app_.preset().name + " – Tyglab");
  plan_next_frame();
  if (app_.report) app_.report->end_frame(app_);
  app_.input.clear();
  ++frames_;
}

int Sandbox::run() {
  const InterruptGuard guard;
  while (!app_.quit && !InterruptGuard::interrupted() && (options_.frames == 0 || frames_ < options_.frames)) {
    const double start = glfwGetTime();
    wait_for_events();
    if (!due()) {
      app_.input.clear();
      continue;
    }
    frame();
    // Where the driver does not wait for the screen, the program does.
    const double left = window_.frame_time() - (glfwGetTime() - start) - 0.001;
    if (!app_.scripted && left > 0.001) glfwWaitEventsTimeout(left);
  }
  remember();
  const int code = write_outputs();
  return code == done && InterruptGuard::interrupted() ? int(interrupted) : code;
}

int Sandbox::write_outputs() {
  try {
    if (!options_.screenshot.empty() && !last_picture_.rgb.empty()) write_png(options_.screenshot, last_picture_);
    if (!options_.time_report.empty()) {
      const glm::ivec2 size = window_.framebuffer_size();
      write_output(options_.time_report,
                   app_.costs.json(size.x, size.y, app_.simulation->engine().name(), app_.document.label));
    }
    if (app_.report) app_.report->finish(app_);
  } catch (const OutputError& error) {
    std::fprintf(stderr, "tyglab: %s\n", error.what());
    return no_output;
  }
  return done;
}

void Sandbox::remember() {
  if (app_.scripted) return;
  Settings& settings = app_.settings;
  window_.remember(settings);
  settings.plot_log = app_.ui.plots.log;
  // Who quit with unsaved changes has said that they may go; a session that was interrupted brings them back.
  Preset last = app_.quit ? app_.document.saved : app_.preset();
  last.mode = app_.preset().mode;
  settings.session = Session{std::move(last), app_.document.saved, app_.document.label, app_.document.file};
  try {
    save_settings(settings);
  } catch (const OutputError& error) {
    std::fprintf(stderr, "tyglab: %s. The settings of this session are not remembered.\n", error.what());
  }
}

}  // namespace

int run_sandbox(const SandboxOptions& options) {
  try {
    return Sandbox(options).run();
  } catch (const GraphicsError& error) {
    std::fprintf(stderr, "tyglab: %s\n", error.what());
  } catch (const EngineError& error) {
    std::fprintf(stderr, "tyglab: %s\n", error.what());
  }
  return no_device;
}

}  // namespace tyglab
