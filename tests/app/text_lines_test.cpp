// How the lines of a lab's text are broken: measured here with letters of one width.
#include <doctest/doctest.h>

#include <algorithm>
#include <sstream>

#include "app/base/text.h"
#include "app/session/lab_state.h"
#include "app/session/motion.h"
#include "app/session/observables.h"

namespace tyglab::text_lines_test {

float letters(std::string_view text) {
  return float(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}
std::string broken(const std::string& text, float width) {
  std::string lines = broken_into_lines(with_whole_terms(text), width, letters);
  for (std::size_t at = 0; (at = lines.find("\u00a0", at)) != std::string::npos;) lines.replace(at, 2, " ");
  return lines;
}

/// Keys and buttons of the mouse, as words.
bool names_keys_or_mouse(const std::string& text) {
  for (const char* word : {"Space", "click", "Click", "Ctrl", "Shift", "(R)", "with R", "R brings", "Press W",
                           "arrow key", "left button", "right button", "wheel"})
    if (text.find(word) != std::string::npos) return true;
  return false;
}

TEST_CASE("in the words of a finger no lab asks for a key or a button of the mouse") {
  CHECK(for_fingers("Press Space, and let it rest.") == "Tap the triangle (Run) at the top, and let it rest.");
  CHECK(for_fingers("Right-click a particle to pick it.") == "Tap a particle to pick it.");
  CHECK(names_keys_or_mouse("Press Space."));
  Session session;
  for (const Lab& lab : find_labs(session))
    for (const LabStep& step : lab.steps)
      for (const Paragraphs& part : {step.text, step.todo, step.explanation})
        for (const std::string& paragraph : part) {
          CAPTURE(paragraph);
          CHECK_FALSE(names_keys_or_mouse(for_fingers(paragraph)));
        }
  for (const Observable& row : observables()) CHECK_FALSE(names_keys_or_mouse(for_fingers(row.hint)));
}

TEST_CASE("messages name no folder that means nothing to the user") {
  Messages messages;
  messages.unnamed = "/home/web_user";
  messages.note("Saved /home/web_user/.config/tyglab/presets/soft.json and its texture soft.png");
  messages.note("/home/web_user/files/a.json:3: forces.k_s is missing.");
  CHECK(messages.list()[0].text == "Saved soft.json and its texture soft.png");
  CHECK(messages.list()[1].text == "a.json:3: forces.k_s is missing.");
}

TEST_CASE("a screen reader is told the scene, the lab's step and whether the motion runs; the time apart from that") {
  Session session;
  Preset preset;
  preset.name = "A cloth";
  session.simulation = std::make_shared<Simulation>(preset);
  CHECK(state_in_words(session) == "A cloth, Verlet, dt 0.001 s: running");
  CHECK(time_in_words(session).starts_with("t = 0"));
  session.pacing.playing = false;
  CHECK(state_in_words(session) == "A cloth, Verlet, dt 0.001 s: paused at t = 0 s");
  session.behind_page = true;
  CHECK(state_in_words(session).ends_with(": waits behind the start page"));
  session.behind_page = false;
  begin_lab(session, "01_hooke");
  CHECK(state_in_words(session).find("step 1 of 3: A mass on a spring, waits for a prediction") != std::string::npos);
}

TEST_CASE("a formula goes to the next line whole") {
  CHECK(broken("on a spring with k = 10 N/m, damped", 20) == "on a spring with\nk = 10 N/m, damped");
  CHECK(broken("Hooke's law (2.3), F = −k·(x − x₀), and", 22) == "Hooke's law (2.3),\nF = −k·(x − x₀), and");
  CHECK(broken("pulls with g = 9.82 m/s². Here", 16) == "pulls with\ng = 9.82 m/s².\nHere");
  CHECK(broken("so Δ = m·g/k ≈ 0.1 m", 17) == "so\nΔ = m·g/k ≈ 0.1 m");
}

TEST_CASE("a formula that is wider than a line is parted before a relation, else at a space, and within a word last") {
  CHECK(broken("so F = F_int + F_ext = m·a = 0 holds", 20) == "so F = F_int + F_ext\n= m·a = 0 holds");
  CHECK(broken("F = F_int + F_ext", 9) == "F = F_int\n+ F_ext");
  CHECK(broken("0.0001 incomprehensibilities", 9) == "0.0001\nincompreh\nensibilit\nies");
  CHECK(broken("", 9).empty());
  CHECK(broken("one\ntwo words", 7) == "one\ntwo\nwords");
}

TEST_CASE("a path that is wider than a line is parted behind its parts, and loses and gains nothing") {
  const std::string path = "/home/somebody/a_lecture-of-mine/cloths/hanging.json";
  const std::string lines = broken_into_lines("Saved in " + path + ".", 20, letters);
  CHECK(lines == "Saved in\n/home/somebody/\na_lecture-of-mine/\ncloths/hanging.json.");
  const std::string narrow = broken_into_lines(path, 8, letters);
  CHECK(std::count(narrow.begin(), narrow.end(), ' ') == 0);
  std::string together = narrow;
  std::erase(together, '\n');
  CHECK(together == path);
}

TEST_CASE("a name gives way to what has become of it") {
  const auto lines = [](const std::string& name, const std::string& state, float width) {
    std::string all;
    for (const std::string& line : name_lines(name, state, width, 3, letters)) all += line + "|";
    for (std::size_t at = 0; (at = all.find("\u00a0", at)) != std::string::npos;) all.replace(at, 2, " ");
    return all;
  };
  const std::string name = "verlet, dt = 0.002", state = "diverged at t = 0.194 s";
  CHECK(lines(name, state, 60) == "verlet, dt = 0.002 · diverged at t = 0.194 s|");
  CHECK(lines(name, state, 30) == "verlet, dt = 0.002|diverged at t = 0.194 s|");
  CHECK(lines(name, state, 18) == "verlet, dt = 0.002|diverged at|t = 0.194 s|");
  CHECK(lines(name, state, 12) == "verlet, dt …|diverged at|t = 0.194 s|");
  CHECK(lines(name, "", 12) == "verlet,|dt = 0.002|");
  CHECK(lines("rk4", "", 12) == "rk4|");
}

TEST_CASE("no line of a shipped lab begins or ends within a formula, however wide the card is") {
  std::vector<std::string> problems;
  for (const Lab& lab : read_labs(problems))
    for (const LabStep& step : lab.steps) {
      Paragraphs all = step.text;
      all.insert(all.end(), step.todo.begin(), step.todo.end());
      all.insert(all.end(), step.explanation.begin(), step.explanation.end());
      if (step.prediction) {
        all.push_back(step.prediction->question);
        all.insert(all.end(), step.prediction->choices.begin(), step.prediction->choices.end());
      }
      for (const std::string& text : all)
        for (float width = 44; width < 130; ++width) {
          std::istringstream lines(broken_into_lines(text, width, letters));
          for (std::string line; std::getline(lines, line);) {
            CAPTURE(line);
            for (const char* sign : {"=", "·", "+", "−", "/", "<", ">", "≈"}) {
              CHECK_FALSE(line.starts_with(sign));
              CHECK_FALSE(line.ends_with(sign));
            }
          }
        }
    }
}

}  // namespace tyglab::text_lines_test
