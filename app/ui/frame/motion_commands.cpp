// Commands for time: run, step, rewind, and the automatic choice of dt and engine.
#include "app/session/motion.h"
#include "app/ui/frame/commands.h"

namespace tyglab {
namespace {

void toggle_play(Ui& ui) {
  Pacing& pacing = ui.session.pacing;
  pacing.playing = !pacing.playing;
  pacing.restart_measure();
}

std::string waits_for_prediction(const Ui& ui) {
  return awaits_prediction(ui.session) ? "Predict first: the motion waits for your prediction." : "";
}

std::string nothing_moves(const Ui& ui) {
  if (std::string waits = waits_for_prediction(ui); !waits.empty()) return waits;
  if (!ui.session.simulation->divergence() || ui.session.copies.lockstep.alive()) return "";
  return "The simulation has diverged: restart it (R), rewind it (←), or choose a remedy in the banner.";
}

void step_once(Ui& ui) {
  single_step(ui.session, ui.tools.session_input().hand);
}

std::string nothing_earlier(const Ui& ui) {
  const Simulation& simulation = *ui.session.simulation;
  const bool there = ui.session.rewind.before(simulation, simulation.time(), 1) != nullptr;
  return there && !ui.session.rebuild.holds_present() ? "" : "There is no earlier state to rewind to.";
}

void rewind_a_second(Ui& ui) {
  ui.session.pacing.playing &= !ui.session.simulation->divergence();
  rewind_and_say_what_stays(ui.session);
}

template <int milliseconds, int steps>
void along_timeline(Ui& ui) {
  go_by(ui.session, milliseconds / 1000.0, steps);
}

std::string no_replay(const Ui& ui) {
  return nothing_to_replay(ui.session);
}

void replay_slowly(Ui& ui) {
  if (ui.session.preset().kind == Kind::cloth) ui.color_replay();
  ui.session.request(request::Replay{});
}

void choose_fastest_engine(Ui& ui) {
  ui.session.studies.engine.begin(ui.session.requested_preset(), ui.session.threads);
}

void toggle_slow_hand(Ui& ui) {
  bool& slow = ui.settings.handling.slow_hand;
  slow = !slow;
  ui.messages.note(slow ? "Time runs at a quarter of its speed while you grab or cut."
                        : "Time runs at full speed while you grab or cut.");
}

}  // namespace

std::vector<CommandRow> motion_rows() {
  return {{"toggle_play",
           "Run or pause",
           "Space",
           {{GLFW_KEY_SPACE, 0}},
           "pauses and runs",
           "play stop",
           toggle_play,
           nothing_moves},
          {"step",
           "One step of dt",
           "→ or O",
           {{GLFW_KEY_RIGHT, 0, true}, {GLFW_KEY_O, 0, true}},
           "makes one step of dt",
           "single",
           step_once,
           waits_for_prediction},
          {"rewind",
           "Rewind a second",
           "←",
           {{GLFW_KEY_LEFT, 0, true}},
           "rewinds one second",
           "back",
           rewind_a_second,
           nothing_earlier},
          {"timeline_step_back",
           "Timeline: a step back",
           "Shift+←",
           {{GLFW_KEY_LEFT, GLFW_MOD_SHIFT, true}},
           "goes a step back on the timeline",
           "scrub earlier",
           along_timeline<0, -1>},
          {"timeline_step",
           "Timeline: a step on",
           "Shift+→",
           {{GLFW_KEY_RIGHT, GLFW_MOD_SHIFT, true}},
           "goes a recorded step on",
           "scrub later",
           along_timeline<0, 1>},
          {"timeline_back",
           "Timeline: a tenth of a second back",
           "Ctrl+←",
           {{GLFW_KEY_LEFT, ctrl, true}},
           "goes a tenth of a second back on the timeline",
           "scrub earlier",
           along_timeline<-100, 0>},
          {"timeline_on",
           "Timeline: a tenth of a second on",
           "Ctrl+→",
           {{GLFW_KEY_RIGHT, ctrl, true}},
           "goes a recorded tenth of a second on",
           "scrub later",
           along_timeline<100, 0>},
          {"replay",
           "Replay the last 50 steps slowly",
           "",
           {},
           "",
           "divergence explosion slow motion",
           replay_slowly,
           no_replay},
          {"restart",
           "Restart the motion",
           "R or Backspace",
           {{GLFW_KEY_R, 0}, {GLFW_KEY_BACKSPACE, 0}},
           "restarts the motion and keeps the constants",
           "begin again",
           of_session<restart>},
          {"toggle_slow_hand",
           "Slow motion while you grab or cut, on or off",
           "H",
           {{GLFW_KEY_H, 0}},
           "slow motion while you grab or cut",
           "speed quarter grab",
           toggle_slow_hand,
           nullptr,
           {},
           [](const Ui& ui) { return ui.settings.handling.slow_hand; }},
          {"toggle_auto",
           "dt chosen by the program",
           "",
           {},
           "",
           "automatic time step",
           of_session<toggle_auto_dt>,
           nullptr,
           {},
           [](const Ui& ui) { return ui.session.auto_dt.has_value(); }},
          {"choose_engine",
           "Engine chosen by the program",
           "",
           {},
           "",
           "automatic opencl cpu fastest",
           choose_fastest_engine}};
}

}  // namespace tyglab
