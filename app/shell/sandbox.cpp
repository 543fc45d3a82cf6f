#include "app/shell/sandbox.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <iostream>
#include <limits>

#include "app/base/experiment_file.h"
#include "app/base/files.h"
#include "app/base/text.h"
#include "app/platform/platform.h"
#include "app/process/interrupt.h"
#include "app/process/process.h"
#include "app/process/program_run.h"
#include "app/render/gl_objects.h"
#include "app/session/document.h"
#include "app/session/lab_state.h"
#include "app/session/motion.h"
#include "app/shell/start.h"
#include "app/ui/cards/cards.h"
#include "app/ui/frame/frame.h"
#include "app/ui/frame/panels.h"
#include "app/ui/kit/imgui_compat.h"
#include "core/io/output_file.h"
#include "core/io/preset_io.h"
#include "core/io/system_files.h"
#include "core/model/notation.h"
#include "core/model/words.h"
#include "tests/bench/session_report.h"

namespace tyglab {
namespace {

enum ExitCode { done = 0, no_device = 5, no_output = 6, interrupted = 130 };

constexpr double scripted_frame = 1.0 / 60;  // s; with --frames the same frames come on every machine
constexpr double settle_time = 0.3;          // s after an event

class Sandbox : public FrameLoop {
 public:
  explicit Sandbox(const SandboxOptions& options);
  ~Sandbox() override {  // while the window's context lives; first who works in its memory
    session_.rebuild = {}, session_.copies.lockstep.clear(), session_.simulation.reset();
    scene_.views = {}, scene_.renderer.reset();
  }
  bool run_frame() override;
  int finish() override;
  void leave() override;

 private:
  bool restores() const { return !options_.explicit_preset && !session_.scripted && settings_.session.has_value(); }
  const Preset& first_preset() const { return restores() ? settings_.session->preset : options_.preset; }
  void start_preset();
  Document first_document();
  void frame();
  void frame_parts();
  void wait_for_events();
  bool due();
  void plan_next_frame();
  void take_dropped_files();
  void rescale();
  void begin();
  InitialScene take_initial_scene();
  std::optional<std::string> show_texture(const std::string& texture);
  void draw_cloth();
  void present();
  void save_picture();
  int write_outputs();
  Settings present_settings();
  void remember();
  void show_link();
  void tell();
  bool idle() const;

  SandboxOptions options_;
  Session session_;  // first: it takes the messages of what is read
  Settings settings_;
  SettingsWriter writer_{settings_};
  InputQueue input_;
  Scene scene_{session_};
  Tools tools_{session_, scene_, input_, settings_.handling};
  Ui ui_{session_, scene_, tools_, input_, settings_};
  std::unique_ptr<SessionReport> report_;  ///< none unless it is asked for
  Job<InitialScene> initial_scene_;        ///< the first cloth, built while the window opens
  Window window_;
  Gui gui_;
  int frames_ = 0;
  int busy_frames_ = 4;      ///< Dear ImGui needs a few frames after an event to settle
  double settle_until_ = 0;  ///< s, and some time, to fade what it fades
  double last_time_ = 0;
  std::optional<FileStamp> texture_read_;  ///< of the texture that is shown
  std::optional<Preset> linked_;           ///< whose link the page's address shows
  std::uint64_t linked_document_ = 0;
  std::string linked_lab_;  ///< and the lab that it shows
  std::size_t linked_step_ = 0;
  bool address_left_ = false;        ///< the browser has gone to another link
  std::array<std::string, 3> told_;  ///< in words
  double next_link_ = 0;             ///< s, not before which it is looked at again
  Image last_picture_;
  const InterruptGuard guard_;  ///< from the first frame on, Ctrl-C ends it in good order
};

Sandbox::Sandbox(const SandboxOptions& options)
    : options_(options),
      settings_(settings_for(options, session_.messages)),
      window_((begin(), options.width), options.height, settings_, input_),
      gui_(window_) {
  session_.costs.started(StartPart::window);
  window_.wait_for_screen(!session_.scripted);
  constexpr int tall = 1000;  // px at scale 1: one more card has room beside the plots
  if (settings_.layout == Layout() && float(window_.size().y) >= tall * window_.content_scale())
    settings_.layout.folded.erase(card_name::stability);
  scene_.renderer = std::make_unique<ClothRenderer>();
  session_.costs.started(StartPart::shaders);
  start_preset();
  session_.costs.started(StartPart::cloth);
  input_.finger_button = [this](glm::vec2 at) { return finger_button(tools_, at); };
  input_.finger_on_cloth = [this](glm::vec2 at) { return scene_.viewport.takes(at); };
  if (files_are_handed_out()) session_.messages.unnamed = home_folder().string();
  input_.finger_on_list = [](glm::vec2 at) { return gui::scrolls_at({at.x, at.y}); };
  if (!options_.lab.empty()) {
    std::optional<std::size_t> step;
    if (options_.lab_step > 0) step = std::size_t(options_.lab_step - 1);
    ui_.act([lab = options_.lab, step](Ui& ui) { begin_lab(ui.session, lab, step); });
  }
  ui_.panels = options_.panels;
  last_time_ = window_time();
}

/// What goes on while the window opens.
void Sandbox::begin() {
  take_options(options_, ui_);
  session_.costs.started(StartPart::settings);
  if (!options_.session_report.empty()) report_ = std::make_unique<SessionReport>(options_.session_report);
  if (report_) ui_.controls = &report_->places();
  initial_scene_.start(Priority::normal,
                       [preset = first_preset(), threads = options_.threads, whole = session_.scripted](
                           const JobControl&) { return build_initial_scene(preset, threads, whole); });
}

InitialScene Sandbox::take_initial_scene() {
  auto outcome = initial_scene_.take();
  if (const auto* error = std::get_if<JobError>(&outcome)) {
    if (error->out_of_memory) throw std::bad_alloc();
    throw EngineError(error->what);
  }
  return std::move(std::get<InitialScene>(outcome));
}

void Sandbox::start_preset() {
  InitialScene initial = take_initial_scene();
  if (!initial.simulation) initial.simulation = make_simulation(first_preset(), options_.threads, initial.fallback);
  if (!initial.fallback.empty()) session_.messages.warning(initial.fallback);
  session_.simulation = std::move(initial.simulation);
  session_.rebuild.prepare_programs = try_program;
  // The first texture has been read already.
  session_.show_texture = [&](const std::string&) -> std::optional<std::string> {
    scene_.redraw = true;
    if (auto* why = std::get_if<std::string>(&initial.picture)) return std::move(*why);
    texture_read_ = initial.picture_file;
    return scene_.renderer->set_texture(std::get<ClothPicture>(initial.picture));
  };
  begin_document(session_, first_document());
  session_.show_texture = [this](const std::string& texture) { return show_texture(texture); };
  if (options_.auto_dt) session_.auto_dt.emplace();
  // On its device once that can run it.
  if (!session_.scripted && first_preset().engine != session_.preset().engine)
    session_.rebuild.order(session_, {.target = first_preset(), .fresh = false}, session_.history);
  follow_session(ui_);
  if (!session_.scripted && !options_.explicit_preset && options_.lab.empty() && !settings_.tour_seen)
    ui_.command("start_page");
}

/// Returns what is wrong with it; the present one stays then.
std::optional<std::string> Sandbox::show_texture(const std::string& texture) {
  const std::optional<FileStamp> stamp = stamp_of(texture_file(texture));
  if (stamp && stamp == texture_read_) return std::nullopt;  // reading it again would take several frames' time
  const FoundPicture picture = find_picture(texture);
  if (const auto* why = std::get_if<std::string>(&picture)) return *why;
  scene_.redraw = true;
  const std::optional<std::string> problem = scene_.renderer->set_texture(std::get<ClothPicture>(picture));
  if (!problem) texture_read_ = stamp;
  return problem;
}

Document Sandbox::first_document() {
  if (!restores()) return {options_.preset, options_.preset_label, options_.preset_path, options_.experiment};
  const LastSession& session = *settings_.session;
  // What was saved is on disk; where it is gone, the session itself is all there is.
  try {
    return {session.file.empty() ? session.saved : read_preset(session.file), session.label, session.file};
  } catch (const std::exception& error) {
    session_.messages.warning(sentence(error.what()) +
                              " The state of the last session is shown; save it under a name.");
    return {first_preset(), session.label, {}};
  }
}

bool Sandbox::idle() const {
  return session_.idle() && !session_.scripted && busy_frames_ <= 0 && window_time() >= settle_until_ &&
         ui_.actions.empty() && !ui_.film && tools_.tool.kind == Tool::Kind::none;
}

void Sandbox::wait_for_events() {
  if (window_.hidden()) {
    window_.take_events(0.5);
  } else if (idle()) {
    const double longest = report_ ? 0.1 : 0.5;  // a report is due; Ctrl-C is seen
    const double wait = std::min(ui_.draw_by - window_time(), longest);
    window_.take_events(wait);
  } else {
    window_.take_events(0);
  }
  busy_frames_ = input_.anything || input_.unshown ? 4 : std::max(busy_frames_ - 1, 0);
  if (input_.anything) settle_until_ = window_time() + settle_time;
}

/// Whether there is anything that a new frame would show.
bool Sandbox::due() {
  if (window_.framebuffer_size().x == 0) return false;
  return !idle() || input_.anything || report_ != nullptr || window_time() >= ui_.draw_by;
}

/// In words, what changes seldom, the time, and the messages.
void Sandbox::tell() {
  static constexpr std::array parts{"state", "time", "messages"};
  std::array<std::string, 3> words{state_in_words(session_), time_in_words(session_), {}};
  for (const Message& message : session_.messages.list()) words[2] += capitalised(message.text) + "\n";
  for (std::size_t k = 0; k < parts.size(); ++k)
    if (words[k] != told_[k]) window_.tell(parts[k], told_[k] = std::move(words[k]));
}

/// Shows the experiment's link in the page's address; a preset that is opened is a step that the browser goes back
/// from.
void Sandbox::show_link() {
  // What the browser went to is opened first, or its address would be overwritten.
  if (window_time() < next_link_ || !input_.dropped.empty() || page_address().empty()) return;
  next_link_ = window_time() + 0.5;
  tell();
  const Preset preset = session_.requested_preset();
  const std::string lab = session_.labs.run ? session_.labs.run->lab.label : "";
  const std::size_t step = session_.labs.run ? session_.labs.run->step : 0;
  const bool opened = std::exchange(linked_document_, session_.counts.documents) != session_.counts.documents;
  const bool same = linked_ && *linked_ == preset && linked_lab_ == lab && linked_step_ == step && !opened;
  // Where the browser went, but the program did not follow.
  const bool left = address_left_ && ui_.dialog.kind == Dialog::Kind::none;
  if (same && !left) return;
  show_in_address(link_to(preset, session_.document.label), lab, int(step) + 1, opened && linked_.has_value());
  linked_ = preset, linked_lab_ = lab, linked_step_ = step, address_left_ = false;
}

/// When a frame is wanted again though nothing moves; the panels have said what they want of it.
void Sandbox::plan_next_frame() {
  const bool cursor_blinks = ui_.slider.typing != 0 || gui::typing_text();
  if (cursor_blinks) ui_.draw_by = std::min(ui_.draw_by, ui_.now + 0.25);
  ui_.draw_by = std::min(ui_.draw_by, session_.messages.next_end() + 0.01);
  ui_.draw_by = std::min(ui_.draw_by, ui_.now + (session_.again_at - session_.now));
}

void Sandbox::take_dropped_files() {
  for (const std::string& name : input_.dropped) {
    if (is_link(name)) {
      open_link(session_, name);
      address_left_ = true;
      continue;
    }
    const std::filesystem::path file(name);
    if (file.parent_path() == data_folder() / "textures") {  // of the page, and has just arrived
      if (texture_file(session_.preset().texture) == file) show_texture(session_.preset().texture);
      continue;
    }
    if (file.extension() == ".json" || is_experiment(file)) {
      session_.request(request::Open{.file = file});
    } else {
      session_.request(request::LoadTexture{name});
    }
  }
}

void Sandbox::rescale() {
  if (!take_look(ui_, window_.content_scale())) return;
  const bool first = ui_.fonts.text == nullptr;
  ui_.fonts = build_fonts(ui_.theme.scale, ui_.theme.axis_text);
  if (!first) gui_.fonts_changed();
  if (first)
    for (const std::string& note : ui_.fonts.notes) std::cerr << "tyglab: " + note + '\n';
}

void Sandbox::draw_cloth() {
  const glm::ivec2 window = window_.size(), framebuffer = window_.framebuffer_size();
  scene_.draw(window.x > 0 ? glm::vec2(framebuffer) / glm::vec2(window) : glm::vec2(1));
}

void Sandbox::present() {
  {
    const FrameCosts::Timer timer(session_.costs, Part::ui_draw);
    const glm::ivec2 size = window_.framebuffer_size();
    glViewport(0, 0, size.x, size.y);
    const ImVec4 ground = ImGui::ColorConvertU32ToFloat4(ui_.theme.colors.ground);
    glClearColor(ground.x, ground.y, ground.z, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    gui_.draw();
  }
  if (ui_.picture) return save_picture();
  if (frames_ + 1 == options_.frames && !options_.screenshot.empty()) last_picture_ = window_.pixels();
  const FrameCosts::Timer timer(session_.costs, Part::swap);
  window_.swap();
}

/// Of the frame that has just been drawn, which is not shown: the viewport has no buttons in it.
void Sandbox::save_picture() {
  const PictureOrder wanted = *std::exchange(ui_.picture, std::nullopt);
  busy_frames_ = 2;
  Image image = window_.pixels();
  if (!wanted.whole_window) {
    const glm::vec2 scale = glm::vec2(image.width, image.height) / glm::vec2(window_.size());
    const glm::vec2 lo = glm::round(scene_.viewport.box.lo * scale);
    glm::vec2 hi = glm::round(scene_.viewport.box.hi * scale);
    if (ui_.film) hi -= glm::mod(hi - lo, 2.f);  // video encoders need even numbers of pixels
    image = cropped(image, lo, hi);
  }
  try {
    write_png(wanted.file, image);
    hand_out(wanted.file);
    if (!ui_.film) session_.messages.note("Saved " + wanted.file.string());
  } catch (const OutputError& error) {
    if (!ui_.film) return show_picture_problem(ui_, wanted, error.what());
    session_.messages.error(error.what());
    ui_.film.reset();
  }
}

void Sandbox::frame() {
  {
    const FrameCosts::Timer timer(session_.costs, Part::frame);
    frame_parts();
  }
  session_.costs.end_frame();
  if (frames_ == 1) session_.costs.started(StartPart::first_frame);
}

void Sandbox::frame_parts() {
  const double now = window_time();
  const double elapsed = direct_film(ui_).value_or(session_.scripted ? scripted_frame : now - last_time_);
  // Events carry the time at which they were polled, so two clicks of one gesture may be a frame apart.
  input_.double_click_s = std::max(0.4, 1.5 * (now - last_time_));
  last_time_ = now;
  ui_.now = tools_.now = now;
  ui_.draw_by = std::numeric_limits<double>::infinity();
  ui_.full_screen = window_.full_screen();
  if (window_.wants_close()) window_.forget_close(), session_.request(request::Quit{});
  rescale();
  take_dropped_files();
  act_on_events(ui_, elapsed, window_.frame_time());
  if (std::exchange(ui_.toggle_full_screen, false)) window_.toggle_full_screen();
  draw_cloth();
  {
    const FrameCosts::Timer timer(session_.costs, Part::panels);
    gui_.begin_frame(input_, ui_.bare());
    draw_panels(ui_);
  }
  present();
  end_gestures(ui_);
  window_.set_title((unsaved(session_) ? "• " : "") + session_.preset().name + " – Tyglab");
  plan_next_frame();
  if (report_) report_->end_frame(ui_);
  input_.clear();
  ++frames_;
}

bool Sandbox::run_frame() {
  if (session_.quit || InterruptGuard::interrupted() || (options_.frames > 0 && frames_ == options_.frames))
    return false;
  const double start = window_time();
  wait_for_events();
  const auto present = [this] { return present_settings(); };
  show_link();
  if (!session_.scripted && writer_.update(start, present, session_.messages)) ui_.draw_by = start;
  if (!due()) {
    input_.clear();
    return true;
  }
  frame();
  // Where the driver does not wait for the screen, the program does.
  const double left = window_.frame_time() - (window_time() - start) - 0.001;
  if (!session_.scripted && left > 0.001) window_.take_events(left);
  return true;
}

int Sandbox::finish() {
  remember();
  const int code = write_outputs();
  return code == done && InterruptGuard::interrupted() ? int(interrupted) : code;
}

void Sandbox::leave() {
  next_link_ = 0;
  show_link();
  remember();
}

int Sandbox::write_outputs() {
  try {
    if (!options_.screenshot.empty() && !last_picture_.rgb.empty()) write_png(options_.screenshot, last_picture_);
    if (!options_.time_report.empty()) {
      const glm::ivec2 size = window_.framebuffer_size();
      write_output(options_.time_report,
                   session_.costs.json(size.x, size.y, session_.simulation->engine().name(), session_.document.label));
    }
    if (report_) report_->finish(ui_);
    if (!options_.record.empty()) {
      settle(session_);
      save_experiment(experiment_of(present_line(session_), *session_.simulation), options_.record);
    }
  } catch (const OutputError& error) {
    std::cerr << "tyglab: " << error.what() << '\n';
    return no_output;
  }
  return done;
}

/// What the next session is to find, however this one ends.
Settings Sandbox::present_settings() {
  remember_session(ui_);
  window_.remember(settings_);
  return settings_;
}

void Sandbox::remember() {
  if (session_.scripted) return;
  try {
    writer_.finish(present_settings());
  } catch (const OutputError& error) {
    std::cerr << "tyglab: " << error.what() << ". The settings of this session are not saved.\n";
  }
}

}  // namespace

int run_sandbox(const SandboxOptions& options) {
  return_large_blocks();
  try {
    return run_frame_loop(std::make_unique<Sandbox>(options));
  } catch (const GraphicsError& error) {
    std::cerr << "tyglab: " << error.what() << '\n';
  } catch (const EngineError& error) {
    std::cerr << "tyglab: " << error.what() << '\n';
  }
  return no_device;
}

}  // namespace tyglab
