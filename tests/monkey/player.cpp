#include "tests/monkey/player.h"

#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "app/base/glfw_keys.h"
#include "app/process/program_run.h"
#include "app/session/document.h"
#include "app/shell/start.h"
#include "app/ui/frame/frame.h"
#include "core/integrators/scheme.h"
#include "core/io/preset_io.h"
#include "tests/support/places.h"

namespace tyglab::monkey {
namespace {

namespace fs = std::filesystem;

constexpr int settled = 3;                  // frames after which a layout stands still
constexpr int longest_quiet = 600;          // s without a frame, after which the process ends itself: it hangs
constexpr double steps_in_patience = 1e5;   // particles times steps that a frame may make however long they take
constexpr long frames_between_looks = 300;  // at memory
constexpr int most_undone = 8;              // changes that are undone and done again
constexpr int parts = 4;                    // of rows and columns, between the particles that actions name

int button_called(const std::string& name) {
  return name == "right" ? GLFW_MOUSE_BUTTON_RIGHT : name == "middle" ? GLFW_MOUSE_BUTTON_MIDDLE : 0;
}

/// Whether all steps that are due are made, so that they are the same on every machine. Where that would take long
/// they are made as in the window: as many as there is time for, or beside the frames.
bool patient(const Session& session) {
  const Preset& preset = session.preset();
  const Scheme& method = scheme(preset.integrator);
  if (is_implicit(method) || chooses_steps(method) || projects(method)) return false;
  const double steps = session.pacing.speed * test::NullUi::frame_time / preset.dt;
  return steps * double(lattice_of(preset).size() * (1 + session.copies.lockstep.size())) < steps_in_patience;
}

bool finite(const VectorField<double>& field) {
  for (const auto* component : {&field.x, &field.y, &field.z})
    if (!std::all_of(component->begin(), component->end(), [](double value) { return std::isfinite(value); }))
      return false;
  return true;
}

/// Processor time of this thread, which other programs don't lengthen.
double worked_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

}  // namespace

double resident_mb() {
  long size = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> size >> resident;
  return double(resident) * double(sysconf(_SC_PAGESIZE)) / 1e6;
}

Player::Player() {
  fs::create_directories(folder_ / "config/presets");
  lay_out_files();
  fs::current_path(folder_.path());  // where exports are proposed
  setenv("HOME", folder_.path().c_str(), 1);
  begin({});
}

Player::~Player() {
  writer_.reset(), window_.reset();
  fs::current_path(fs::temp_directory_path());
}

/// Presets and pictures, good ones and bad ones.
void Player::lay_out_files() const {
  const fs::path source(test::source_dir);
  for (const char* folder : {"tests/monkey/corpus", "tests/fuzz/pictures", "app/presets"})
    for (const auto& entry : fs::directory_iterator(source / folder)) fs::copy(entry.path(), folder_.path());
  fs::copy(source / "textures/linen.png", folder_.path());
}

fs::path Player::file(const std::string& name) const {
  return folder_ / fs::path(name).filename().string();
}

std::vector<std::string> Player::files() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder_.path()))
    if (entry.is_regular_file()) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// A session, with what the last one left where there was one.
void Player::begin(const Settings& settings) {
  test::UiOptions options;
  options.patient = false;  // decided after each frame
  options.settings = [&](Settings& own) {
    const bool seen = settings.session.has_value();
    own = settings;
    own.tour_seen = seen;
  };
  if (settings.session) options.with = [&](Preset& preset) { preset = settings.session->preset; };
  window_ = std::make_unique<test::NullUi>(options);
  setenv("TYGLAB_CONFIG_DIR", (folder_ / "config").c_str(), 1);
  Session& session = window_->session;
  session.rebuild.prepare_programs =
      run_programs_once;  // as the sandbox does in a child: no frame waits for a compiler
  session.show_texture = [](const std::string& texture) -> std::optional<std::string> {
    const FoundPicture picture = find_picture(texture);
    const auto* why = std::get_if<std::string>(&picture);
    return why != nullptr ? std::optional(*why) : std::nullopt;
  };
  if (const auto& last = settings.session)
    begin_document(session, {last->saved, last->label, last->file}), follow_session(window_->ui);
  writer_ = std::make_unique<SettingsWriter>(settings);
  window_->after_frame = [this](double seconds) { after_frame(seconds); };
  checked_.reset();
}

void Player::restart() {
  remember_session(window_->ui);
  writer_->finish(window_->settings);
  writer_.reset(), window_.reset();
  setenv("TYGLAB_CONFIG_DIR", (folder_ / "config").c_str(), 1);
  check_documents();
  std::string problem;
  const Settings settings = load_settings(problem);
  if (!problem.empty()) throw Finding("the settings that were written cannot be read: " + problem);
  begin(settings);
  ++tally_.restarts;
}

void Player::play(const Action& action) {
  now_ = action.line();
  ++tally_.actions;
  if (!done(action)) ++tally_.passed_over;
  window_->frames(settled);
  check_state();
  if (window_->session.quit) restart();
}

/// False where what it is about is not in sight.
bool Player::done(const Action& action) {
  switch (action.verb) {
    case Verb::click:
    case Verb::drag:
    case Verb::wheel:
    case Verb::value:
    case Verb::fill:
      return on_control(action);
    case Verb::grab:
    case Verb::cut:
    case Verb::pin:
    case Verb::pick:
      return on_cloth(action);
    case Verb::drop:
    case Verb::open:
    case Verb::save:
      return with_file(action);
    case Verb::key:
      return tap(action.word(0)), true;
    case Verb::type:
      return type(action.word(0)), true;
    case Verb::find:
      tap("ctrl+p"), window_->frames(settled);
      type(action.word(0));
      return tap("Return"), true;
    case Verb::stroke:
      return stroke(action), true;
    case Verb::zoom:
      window_->move((window_->ui.viewport.box.lo + window_->ui.viewport.box.hi) / 2.f);
      return window_->wheel(float(action.number(0))), true;
    case Verb::resize:
      return window_->resize({int(action.number(0)), int(action.number(1))}), true;
    case Verb::undo_redo:
      return undo_redo(), true;
    case Verb::wait:
      return window_->frames(int(action.number(0))), true;
    case Verb::quit_restart:
      return restart(), true;
  }
  return false;
}

std::optional<glm::vec2> Player::middle(const std::string& name) const {
  const auto place = window_->controls().find(name);
  if (place == window_->controls().end()) return std::nullopt;
  return (place->second.lo + place->second.hi) / 2.f;
}

bool Player::on_control(const Action& action) {
  const std::string& name = action.word(0);
  const auto at = middle(name);
  if (!at) return false;
  const std::string how = action.words.size() > 1 ? action.words[1] : "";
  if (action.verb == Verb::click) {
    click(*at, button_called(how));
    if (how == "double") click(*at, 0);
  } else if (action.verb == Verb::drag) {
    window_->drag({window_->along(name, float(action.number(1))), window_->along(name, float(action.number(2)))});
  } else if (action.verb == Verb::wheel) {
    window_->move(*at);
    window_->wheel(float(action.number(1)));
  } else if (action.verb == Verb::value) {
    window_->input.mods = GLFW_MOD_CONTROL;
    click(*at, 0);
    window_->input.mods = 0;
    window_->frames(settled);
    if (window_->typing()) type(action.word(1));
    tap("Return");
  } else {
    replace(name, action.word(1));
  }
  return true;
}

void Player::click(glm::vec2 at, int button) {
  window_->move(at);
  window_->press(button);
  window_->release(button);
}

void Player::type(std::string_view text) {
  window_->add_typed(text);
  window_->frames(2);
}

void Player::tap(const std::string& chord) {
  const auto key = key_called(chord);
  if (!key) throw std::runtime_error("there is no key " + chord);
  window_->key(key->key, key->mods);
}

/// Of a field.
void Player::replace(const std::string& name, std::string_view text) {
  const auto at = middle(name);
  if (!at) return;
  click(*at, 0);
  tap("ctrl+a");
  type(text);
  window_->frames(settled);
}

std::optional<glm::vec2> Player::particle(const Action& action, std::size_t n) {
  const Lattice& lattice = window_->cloth().lattice();
  const auto site = [&](std::size_t word, int count) {
    return std::clamp(int(action.number(word)) * (count - 1) / parts, 0, count - 1);
  };
  const glm::dvec3 x = window_->cloth().position(site(n, lattice.rows), site(n + 1, lattice.columns));
  const auto at = window_->scene.camera.project(x, window_->ui.viewport.size());
  if (!at || !window_->ui.viewport.box.contains(*at + window_->ui.viewport.box.lo)) return std::nullopt;
  return *at + window_->ui.viewport.box.lo;
}

bool Player::on_cloth(const Action& action) {
  const auto from = particle(action, 0);
  if (!from) return false;
  if (action.verb == Verb::grab) {
    const glm::vec2 by(action.number(2), action.number(3));
    const glm::vec2 to = *from + by * window_->ui.viewport.whole();
    window_->drag({*from, (*from + to) / 2.f, to, to}, GLFW_MOUSE_BUTTON_RIGHT);
  } else if (action.verb == Verb::cut) {
    const auto to = particle(action, 2);
    if (!to) return false;
    window_->drag({*from, (*from + *to) / 2.f, *to});
  } else {
    click(*from, GLFW_MOUSE_BUTTON_RIGHT);
    if (action.verb == Verb::pin) click(*from, GLFW_MOUSE_BUTTON_RIGHT);
  }
  return true;
}

void Player::stroke(const Action& action) {
  const auto place = [&](std::size_t n) {
    return window_->ui.viewport.box.lo +
           glm::vec2(action.number(n), action.number(n + 1)) * window_->ui.viewport.whole();
  };
  const glm::vec2 from = place(0), to = place(2);
  const int button = button_called(action.words.size() > 4 ? action.words[4] : "left");
  const std::string held = action.words.size() > 5 ? action.words[5] : "";
  window_->input.mods = held == "ctrl" ? GLFW_MOD_CONTROL : held == "shift" ? GLFW_MOD_SHIFT : 0;
  window_->drag({from, (from + to) / 2.f, to}, button);
  window_->input.mods = 0;
}

bool Player::with_file(const Action& action) {
  const fs::path path = file(action.word(0));
  if (action.verb == Verb::drop) {  // what the window's shell makes of it
    if (path.extension() == ".json")
      window_->session.request(request::Open{.file = path});
    else
      window_->session.request(request::LoadTexture{path.string()});
    return true;
  }
  const bool opens = action.verb == Verb::open;
  tap(opens ? "ctrl+o" : "ctrl+shift+s");
  window_->frames(settled);
  if (window_->ui.dialog.kind != (opens ? Dialog::Kind::open : Dialog::Kind::save)) return false;  // another stays open
  replace("dialog.path", path.string());
  const char* const yes = opens ? "dialog.Open" : "dialog.Save";
  bool there = false;
  for (const char* button : {yes, "dialog.Replace"})
    if (const auto at = middle(button)) click(*at, 0), window_->frames(settled), there = true;
  if (there && !opens) check_documents();
  return there;
}

/// What is undone and done again is as before.
void Player::undo_redo() {
  Ui& ui = window_->ui;
  Session& session = window_->session;
  // Nothing is under way that changes a constant by itself.
  const bool simple = session.history.can_undo() && !session.auto_dt && !session.labs.run && !session.rebuild.busy() &&
                      !session.studies.engine.busy();
  if (!simple || ui.dialog.kind != Dialog::Kind::none) return;
  Preset before = session.requested_preset();
  int undone = 0;
  for (; undone < most_undone && session.history.can_undo(); ++undone) ui.command("undo"), window_->frame();
  for (; undone > 0; --undone) ui.command("redo"), window_->frame();
  before.mode = session.requested_preset().mode;
  if (!(session.requested_preset() == before) && !session.rebuild.busy())
    throw Finding("what was undone and done again is not as before: " +
                  change_in_words(before, session.requested_preset()));
}

void Player::after_frame(double seconds) {
  alarm(longest_quiet);
  ++tally_.frames;
  const double worked = worked_s();
  if (worked_s_ > 0) tally_.most_work_s = std::max(tally_.most_work_s, worked - worked_s_);
  worked_s_ = worked;
  if (seconds > tally_.longest_frame_s) tally_.longest_frame_s = seconds, tally_.longest_after = now_;
  Session& session = window_->session;
  session.pacing.patient = patient(session);
  // Also in a frame that makes dt much smaller.
  session.pacing.most_patient = steps_in_patience / double(lattice_of(session.preset()).size());
  window_->ui.toggle_full_screen = false;  // there is none
  window_->ui.picture.reset();             // nor its pixels
  const auto present = [this] { return remember_session(window_->ui), window_->settings; };
  writer_->update(window_->ui.now, present, session.messages);
  if (tally_.frames % frames_between_looks == 0) tally_.most_mb = std::max(tally_.most_mb, resident_mb());
  if (checked_ && *checked_ == session.preset()) return;
  if (const std::string problem = check_preset(session.preset()); !problem.empty())
    throw Finding("the session's preset is none: " + problem);
  checked_ = session.preset();
}

void Player::check_state() {
  Simulation& cloth = *window_->session.simulation;
  if (cloth.divergence() || window_->session.background_steps.busy()) return;
  const State& state = cloth.read();
  if (!finite(state.x) || !finite(state.v)) throw Finding("the cloth is not finite, and nobody says so");
}

/// All presets that the program wrote; those of the corpus may be broken.
void Player::check_documents() const {
  for (const auto& entry : fs::recursive_directory_iterator(folder_.path())) {
    const fs::path& path = entry.path();
    const bool written = path.parent_path().filename() == "presets" || path.filename().string().starts_with("saved");
    if (path.extension() != ".json" || !written) continue;
    try {
      load_preset(entry.path());
    } catch (const std::exception& error) {
      throw Finding(std::string("a preset that was saved cannot be read: ") + error.what());
    }
  }
}

}  // namespace tyglab::monkey
