// Labs as files: what they say, and how a wrong one is refused.
#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "app/session/lab_state.h"
#include "app/session/observables.h"
#include "app/session/session.h"
#include "tests/support/files.h"
#include "tests/support/places.h"
#include "tests/support/scenes.h"

namespace tyglab::lab_file_test {

const std::string head = "# A lab\n\n## A step\n\nText.\n\n```lab\n";

std::string problem_of(const std::string& text) {
  try {
    parse_lab(text, "my.md");
  } catch (const LabError& error) {
    return error.what();
  }
  return "none";
}
/// Of a block with these lines; the first is line 8.
std::string problem_in(const std::string& lines) {
  return problem_of(head + lines + "\n```\n");
}
/// No-break spaces as they can be read here.
std::string without_bonds(std::string text) {
  for (std::size_t at = 0; (at = text.find("\u00a0", at)) != std::string::npos;) text.replace(at, 2, "~");
  return text;
}
bool says(const std::string& text, const char* what) {
  return text.find(what) != std::string::npos;
}

TEST_CASE("all wrong lines of blocks are told at once, each with its number") {
  const std::string all = problem_in("open: hangin\ncheck: k_z > 3\nfoo: bar\ncheck: k_s >= 3 N/m\nstop: now");
  for (const char* line : {"my.md:9: ", "my.md:10: ", "my.md:12: "}) CHECK(says(all, line));
  CHECK_FALSE(says(all, "my.md:11: "));
  CHECK(says(all, "my.md:8: "));  // a preset that is not there, found at the block's end
  const std::string unclosed = problem_of(head + "check: k_z > 3");
  CHECK(says(unclosed, "my.md:8: "));
  CHECK(says(unclosed, "never closed"));
}

TEST_CASE("a lab opens no image but a shipped one") {
  CHECK(says(problem_in("open: hanging\nset: texture=/etc/passwd"), "texture=/etc/passwd is not a shipped texture"));
  CHECK(says(problem_in("open: hanging\nset: texture=../a.png"), "is not a shipped texture"));
  CHECK(problem_in("open: hanging\nset: texture=linen.png") == "none");
}

TEST_CASE("a lab is read with a byte order mark and with the line ends of any system") {
  const std::string plain = head + "open: hanging\nset: k_s=70\nstop: 2 s\n```\n\nWhy.\n";
  std::string windows;
  for (const char c : plain) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const Lab wanted = parse_lab(plain, "my.md");
  for (const std::string& text : {"\xEF\xBB\xBF" + plain, windows, "\xEF\xBB\xBF" + windows}) {
    const Lab lab = parse_lab(text, "my.md");
    CHECK(lab.title == wanted.title);
    REQUIRE(lab.steps.size() == 1);
    CHECK(lab.steps[0].title == wanted.steps[0].title);
    CHECK(lab.steps[0].text == wanted.steps[0].text);
    CHECK(lab.steps[0].explanation == wanted.steps[0].explanation);
    REQUIRE(lab.steps[0].open.has_value());
    CHECK(lab.steps[0].open->settings == std::vector<std::string>{"k_s=70"});
    CHECK(lab.steps[0].stop == 2);
  }
  CHECK(says(problem_of("\xEF\xBB\xBF" + head + "check: k_z > 3\n```\n"), "my.md:8: "));
}

TEST_CASE("formulas and quantities are one piece, also where the file's lines end within them") {
  const Lab lab = parse_lab(
      "# A lab\n\n## A step\n\nWith k = 2 · 3 / 4 × 5 it weighs 0.115 N, in 2 s (of 5 m), so Δ\n= m·g/k < 0.1\nm.\n",
      "my.md");
  CHECK(without_bonds(lab.steps[0].text[0]) ==
        "With k~=~2~·~3~/~4~×~5 it weighs 0.115~N, in 2~s (of 5~m), so Δ~=~m·g/k~<~0.1~m.");
}

TEST_CASE("a lab is read whole") {
  const Lab lab = parse_lab(
      "# A **short** lab\nWhat it\nis about.\n\n## First\n\nRead `k_s`.\n\n- one\n- two\n  goes on\n\n```lab\n"
      "open: hanging\nset: k_s=70\nset: rows=8\npredict: How far?\nanswer: 0.1 N s/m within 5 %\ndo: Do this.\n"
      "stop: 2 s\ncheck: k_s >= 70 N/m\ncheck: integrator = verlet\n```\n\nBecause.\n\n## Second\n\nMore.\n\n```lab\n"
      "predict: Which?\nchoice: one\nright: two\ncheck: F < 0.5 * F_g\ncheck: energy > 2 * before.energy\n"
      "check: apart > 0 m\n```\n",
      "my.md");
  CHECK(lab.title == "A short lab");
  CHECK(lab.summary == Paragraphs{"What it is about."});
  REQUIRE(lab.steps.size() == 2);
  const LabStep& first = lab.steps[0];
  CHECK(first.text == Paragraphs{"Read k_s.", "• one", "• two goes on"});
  CHECK(first.open->preset == "hanging");
  CHECK(first.open->settings == std::vector<std::string>{"k_s=70", "rows=8"});
  CHECK(first.prediction->answer.factor == 0.1);
  CHECK(first.prediction->relative);
  CHECK(first.prediction->unit == "N s/m");
  CHECK(first.stop == 2.0);
  CHECK(first.explanation == Paragraphs{"Because."});
  CHECK(words_of(first.checks[0]) == "k_s ≥ 70 N/m");
  CHECK(words_of(first.checks[1]) == "Integrator: Verlet");
  const LabStep& second = lab.steps[1];
  CHECK(second.prediction->right == 1);
  CHECK(words_of(second.checks[0]) == "F < 0.5 × F_g");
  CHECK(words_of(second.checks[1]) == "energy > 2 × its value in the previous lab step");
  CHECK(second.explanation.empty());
}

TEST_CASE("a wrong lab is refused with its file, its line and how to mend it") {
  CHECK(says(problem_of("Text\n"), "my.md:1: a lab begins with its title"));
  CHECK(says(problem_of("# A lab\n"), "at least one step"));
  CHECK(says(problem_of("# A lab\n## \n"), "my.md:2"));
  CHECK(says(problem_of("# A lab\n\n## A step\n"), "my.md:3: this step has no text"));
  CHECK(says(problem_of("# A lab\n\n## A step\nText\n```python\n"), "my.md:5: the only block"));
  CHECK(says(problem_of(head + "do: it\n"), "my.md:7: this block is never closed"));
  CHECK(says(problem_of(head + "```\n\n```lab\n"), "my.md:10: this step has a ```lab block already"));
  CHECK(says(problem_of("# A lab\n```lab\nset: k_s=3\n```\n"), "belongs to a step"));
  CHECK(says(problem_in("chek: t > 1 s"), "my.md:8: \"chek\" is not a key of a lab; did you mean check?"));
  CHECK(says(problem_in("just words"), "has no colon"));
  CHECK(says(problem_in("check:"), "has no value"));
  CHECK(says(problem_in("check: enregy > 1 J"), "did you mean energy?"));
  CHECK(says(problem_in("check: t => 1 s"), "write one of"));
  CHECK(says(problem_in("check: t > 1 m"), "the unit is s, not m"));
  CHECK(says(problem_in("check: t > soon"), "\"soon\" is not a quantity"));
  CHECK(says(problem_in("check: integrator > euler"), "is a word"));
  CHECK(says(problem_in("check: integrator = eulr"), "did you mean euler?"));
  CHECK(says(problem_in("check: energy > before.energy"), "no step before the first"));
  CHECK(says(problem_in("check: apart > 0 m"), "none before the first"));
  CHECK(says(problem_in("predict: How?"), "my.md:8: this prediction has no answer"));
  CHECK(says(problem_in("predict: How?\nanswer: 3 m"), "my.md:9: an answer needs a tolerance"));
  CHECK(says(problem_in("predict: How?\nchoice: a\nchoice: b"), "exactly one"));
  CHECK(says(problem_in("answer: 3 m within 1 %"), "needs a question"));
  CHECK(says(problem_in("set: k_s=3"), "write a line open:"));
  CHECK(says(problem_in("open: hangin"), "my.md:8: "));
  CHECK(says(problem_in("open: hangin"), "Did you mean 'hanging'?"));
  CHECK(says(problem_in("open: hanging\nset: k_ss=3"), "did you mean k_s?"));
  CHECK(says(problem_in("open: hanging\nset: k_s=-3"), "allowed: 0 to"));
  const std::string settings = problem_in("open: hanging\nset: k_s=-4\nset: rows=8\nset: m=heavy");
  CHECK(says(settings, "my.md:9: set: k_s: -4 is not allowed; allowed: 0 to"));
  CHECK(says(settings, "my.md:11: set: m: "));
  CHECK_FALSE(says(settings, "my.md:8: "));
  CHECK_FALSE(says(settings, "--set"));
  const std::string both = problem_in("open: hanging\nset: k_s=-4\npredict: How?\nanswer: 0 m within 5 %");
  CHECK(says(both, "my.md:9: set: "));
  CHECK(says(both, "my.md:11: a percentage of 0"));
  CHECK_FALSE(says(both, "no answer"));
  CHECK(problem_in("open: hanging\nset: pins=[[39, 39]]\nset: rows=40\nset: columns=40") == "none");
  for (const char* wrong : {"nan within 5 %", "inf m within 1 m", "3 m within nan %", "3 m within inf"})
    CHECK(says(problem_in("predict: How?\nanswer: " + std::string(wrong)), "my.md:9: "));
  CHECK(says(problem_in("check: t < inf"), "my.md:8: "));
  CHECK(says(problem_in("predict: How?\nanswer: 0 m within 5 %"), "answer: 0 m within 0.01"));
  CHECK(problem_in("predict: How?\nanswer: 0 m within 0.01") == "none");
  CHECK(says(problem_in("check: integrator = foo"), "integrator is never \"foo\". Known: euler"));
  CHECK(says(problem_in("stop: -1 s"), "above 0"));
  CHECK(says(problem_in("needs: luck"), "opencl"));
}

TEST_CASE("a check says over which part of the motion it is judged") {
  const auto check = [](const std::string& text) {
    const Lab lab = parse_lab(head + "check: " + text + "\n```\n", "my.md");
    return lab.steps[0].checks[0];
  };
  CHECK(check("k_s >= 180 N/m").span == Span::now);
  CHECK(check("k_s >= 180 N/m throughout").span == Span::throughout);
  CHECK(words_of(check("k_s >= 180 throughout")) == "k_s ≥ 180 N/m throughout");
  CHECK(words_of(check("integrator != euler throughout")) == "Integrator: not Euler throughout");
  CHECK(words_of(check("F < 0.5 * F_g once")) == "F < 0.5 × F_g once");
  CHECK(words_of(check("fastest < 0.1 m/s for 0.5 s")) == "fastest < 0.1 m/s for 0.5 s");
  CHECK(check("fastest < 0.1 m/s for 0.5").seconds == 0.5);
  CHECK(words_of(check("F_max < 0.1 N when torn > 0")) == "F_max < 0.1 N when torn > 0");
  CHECK(words_of(check("k_s > 185 when diverged = yes")) == "k_s > 185 N/m when the cloth diverges");
  const Condition narrowed = check("k_s narrowed to 5 % in 0.5 s from 2 s when diverged = yes");
  CHECK(narrowed.span == Span::narrowed);
  CHECK(narrowed.right.factor == 0.05);
  CHECK(narrowed.seconds == 0.5);
  CHECK(narrowed.from == 2);
  for (const char* wrong : {"k_s narrowed to 5 % in 0.5 s", "k_s narrowed to 5 in 0.5 s when diverged = yes",
                            "k_s narrowed to 0 % in 0.5 s when diverged = yes", "k_s narrowed to 5 % in 0.5 s when",
                            "k_s narrowed when diverged = yes", "energy narrowed to 5 % in 1 s when diverged = yes"})
    CHECK(problem_in("check: " + std::string(wrong)) != "none");
  CHECK(says(problem_in("check: energy narrowed to 5 % in 1 s when diverged = yes"),
             "a constant is narrowed down as in"));
  CHECK(words_of(check("untouched = yes throughout")) == "Nothing else changed throughout");
  CHECK(words_of(check("untouched = no")) == "Something else changed");
  CHECK(says(problem_in("check: k_s > 3 N/m thruoghout"), "my.md:8: \"thruoghout\" ends no check; did you mean"));
  CHECK(says(problem_in("check: k_s > 3 N/m onec"), "did you mean once?"));
  CHECK(says(problem_in("check: k_s > 3 N/m throughout once"), "one of throughout, once, for and when"));
  CHECK(says(problem_in("check: k_s > 3 N/m once now"), "once ends a check"));
  CHECK(says(problem_in("check: throughout"), "a check begins with a quantity"));
  CHECK(says(problem_in("check: fastest < 1 m/s for soon"), "for is followed by a simulated time"));
  CHECK(says(problem_in("check: fastest < 1 m/s for -1 s"), "for is followed by a simulated time"));
  CHECK(says(problem_in("check: k_s > 3 N/m when"), "when needs a check"));
  CHECK(says(problem_in("check: k_s > 3 N/m when torn > 0 once"), "a plain check"));
  CHECK(says(problem_in("check: k_s > 3 N/m when tron > 0"), "\"tron\" is not a quantity"));
  CHECK(says(problem_in("check: error < 1 m throughout"), "measured beside the motion"));
  CHECK(says(problem_in("check: dt < 1 s when error < 1 m"), "measured beside the motion"));
  CHECK(says(problem_in("check: t >= 2 s throughout"), "t only grows"));
  CHECK(problem_in("check: t >= 2 s when torn > 0") == "none");
}

TEST_CASE("a step says what is to be seen, and a lab how long it takes") {
  const Lab lab = parse_lab(
      "# A lab\n\nWhat for.\n\n```lab\nminutes: 15\n```\n\n## First\n\nText.\n\n```lab\nshow: energy\nspeed: 0.1\n"
      "view: 2\ncolor: tension\n```\n\n## Second\n\nMore.\n",
      "my.md");
  CHECK(lab.minutes == 15);
  CHECK(lab.summary == Paragraphs{"What for."});
  CHECK(lab.steps[0].show == "energy");
  CHECK(lab.steps[0].speed == 0.1);
  CHECK(lab.steps[0].view == 2);
  CHECK(lab.steps[0].color == "tension");
  CHECK(lab.steps[1].show.empty());
  CHECK_FALSE(lab.steps[1].speed.has_value());
  CHECK(says(problem_in("show: enregy"), "my.md:8: show: there is no card \"enregy\"; did you mean energy?"));
  CHECK(says(problem_in("show: everything at all"), "known: forces, height"));
  CHECK(says(problem_in("speed: 0"), "from 0.001 to 10"));
  CHECK(says(problem_in("speed: quick"), "from 0.001 to 10"));
  CHECK(says(problem_in("view: 6"), "view: is 1 (triangles)"));
  CHECK(says(problem_in("view: 1.5"), "view: is 1 (triangles)"));
  CHECK(says(problem_in("color: tensoin"), "did you mean tension?"));
  CHECK(says(problem_in("minutes: 15"), "minutes: applies to the whole lab"));
  const auto problem_of_head = [](const std::string& lines) {
    return problem_of("# A lab\n\n```lab\n" + lines + "\n```\n\n## A step\n\nText.\n");
  };
  CHECK(problem_of_head("minutes: 15") == "none");
  CHECK(says(problem_of_head("minutes: soon"), "my.md:4: minutes: is a whole number"));
  CHECK(says(problem_of_head("minutes: 0"), "a whole number from 1 to 600"));
  CHECK(says(problem_of_head("open: hanging"), "my.md:4: open: belongs to a step"));
  CHECK(says(problem_of_head("minutes: 5\n```\n\n```lab\nminutes: 6"), "under its title already"));
}

TEST_CASE("a lab is found by its name or its file") {
  CHECK(find_lab_file("01_hooke").filename() == "01_hooke.md");
  const test::TemporaryFolder folder;
  test::write_file(folder / "mine.md", head + "```\n");
  CHECK(find_lab_file((folder / "mine.md").string()) == folder / "mine.md");
  const auto unknown = [] { find_lab_file("01_hoke"); };
  CHECK_THROWS_WITH_AS(unknown(), doctest::Contains("Did you mean '01_hooke'?"), LabError);
}

TEST_CASE("labs are found in the user's folder too, beside their own presets, and a wrong one is told") {
  const test::TemporaryFolder folder;
  REQUIRE(setenv("TYGLAB_CONFIG_DIR", folder.path().c_str(), 1) == 0);
  std::filesystem::create_directories(folder / "labs");
  test::write_file(folder / "labs/mine.json", "{\"cloth\": {\"rows\": 5}}");
  test::write_file(folder / "labs/mine.md", head + "open: mine.json\n```\n");
  test::write_file(folder / "labs/wrong.md", "# A lab\n");
  test::write_file(folder / "labs/README.md", "No lab at all.\n");
  Session session;
  const std::vector<Lab>& labs = find_labs(session);
  CHECK(labs.back().label == "mine");
  CHECK(labs.back().steps[0].open->preset == (folder / "labs/mine.json").string());
  REQUIRE(session.labs.problems.size() == 1);
  CHECK(says(session.labs.problems[0], "wrong.md:2: a lab has at least one step"));
  CHECK(session.messages.list().size() == 1);
  unsetenv("TYGLAB_CONFIG_DIR");
}

TEST_CASE("every observable has a name of its own, and can be asked of any scene") {
  Session session;
  for (const Kind kind : {Kind::cloth, Kind::one_weight}) {
    Preset preset;
    preset.kind = kind;
    session.simulation = std::make_shared<Simulation>(preset);
    session.picked = Pins::Site{0, 0};
    for (const std::string_view name : observable_names()) {
      CAPTURE(std::string(name));
      if (is_word(name)) {
        CHECK_FALSE(observe_word(session, name).empty());
      } else if (const auto value = observe(session, name)) {
        CHECK(std::isfinite(*value));
      } else if (const Observable* row = find_observable(name)) {
        CHECK_FALSE(row->hint.empty());
      }
    }
  }
  CHECK(observe(session, "W.x") == 0.0);
  CHECK_FALSE(is_observable("W"));
  CHECK_FALSE(is_observable("texture"));
}

TEST_CASE("the list of observables in docs/labs/README.md is current") {
  const std::string file = std::string(test::source_dir) + "/docs/labs/README.md";
  const std::string text = test::read_file(file), begin = "<!-- observables -->\n", end = "<!-- end -->\n";
  const std::size_t from = text.find(begin), to = text.find(end);
  REQUIRE(from != std::string::npos);
  REQUIRE(to != std::string::npos);
  const std::string now = text.substr(0, from + begin.size()) + observables_markdown() + text.substr(to);
  if (std::getenv("TYGLAB_WRITE_DOCS") != nullptr) std::ofstream(file) << now;
  CHECK_MESSAGE(test::read_file(file) == now, "write it anew: TYGLAB_WRITE_DOCS=1 build/release/bin/app_tests");
}

TEST_CASE("a lab is done when all of its steps are: those that were skipped are not") {
  Session session;
  session.simulation = std::make_shared<Simulation>(Preset{});
  begin_lab(session, "02_euler");
  LabRun& run = *session.labs.run;
  const int steps = int(run.lab.steps.size());
  REQUIRE(steps >= 3);
  for (LabStep& step : run.lab.steps) step.checks.clear(), step.prediction.reset();  // done at the first look
  const auto do_step = [&](int step) {
    enter_step(session, std::size_t(step));
    session.labs.opened.clear();  // as if its preset were there
    watch_lab(session);
  };
  do_step(0);
  CHECK(steps_done(session, run.lab) == 1);
  for (int step = 2; step < steps; ++step) do_step(step);
  CHECK(steps_done(session, run.lab) == 1);
  do_step(1);
  CHECK(steps_done(session, run.lab) == steps);
}

TEST_CASE("progress is kept, and a lab goes on at a step that opens its preset") {
  Session session;
  session.simulation = std::make_shared<Simulation>(Preset{});
  session.labs.progress["01_hooke"] = 1;
  begin_lab(session, "01_hooke");
  CHECK(session.labs.run->step == 0);  // the second step goes on with the first one's weight
  session.labs.progress["01_hooke"] = 2;
  begin_lab(session, "01_hooke");
  CHECK(session.labs.run->step == 2);
  CHECK(steps_done(session, session.labs.run->lab) == 2);
  session.labs.progress["01_hooke"] = 3;
  begin_lab(session, "01_hooke");
  CHECK(session.labs.run->step == 0);
  begin_lab(session, "99_none");
  CHECK(session.messages.list().size() == 1);
}

TEST_CASE("a lab begins at the step that is asked for, or at the last one before it that can begin here") {
  Session session;
  session.simulation = std::make_shared<Simulation>(Preset{});
  begin_lab(session, "01_hooke", 2);
  CHECK(session.labs.run->step == 2);
  // The second step goes on with what the first one opened.
  session.document.label = "elsewhere";
  begin_lab(session, "01_hooke", 1);
  CHECK(session.labs.run->step == 0);
  session.document.label = session.labs.opened;
  begin_lab(session, "01_hooke", 1);
  CHECK(session.labs.run->step == 1);
  CHECK_FALSE(lab_is_away(session));
  // Its second step compares with the first one.
  begin_lab(session, "05_order", 1);
  CHECK(session.labs.run->step == 0);
  begin_lab(session, "05_order", 100);
  CHECK(session.labs.run->step < session.labs.run->lab.steps.size());
}

/// Updates until the limits of the present constants and the present moment are there.
void wait_for_limits(Session& session) {
  for (int n = 0; n < 20000; ++n) {
    session.wants.stability = true;
    session.update(0.05, {});
    const auto& limits = session.studies.stability.limits();
    if (limits && limits->of == session.preset() && limits->at == session.study_moment().mark()) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  FAIL("no limits came");
}

TEST_CASE("what belongs to the cloth as it hangs is known only for the moment at which it was measured") {
  Session session;
  session.simulation = std::make_shared<Simulation>(test::cloth(12, 12));
  session.pacing.playing = false;
  wait_for_limits(session);
  REQUIRE(observe(session, "dt_crit_now").has_value());
  REQUIRE(observe(session, "omega").has_value());
  session.simulation->advance(200);
  CHECK_FALSE(observe(session, "dt_crit_now").has_value());  // it has moved
  CHECK_FALSE(observe(session, "omega").has_value());
  CHECK(observe(session, "dt_crit").has_value());  // which is that of every shape
  wait_for_limits(session);
  REQUIRE(observe(session, "omega").has_value());
  session.simulation->apply(edit::Cut{{{5, 5}}});
  CHECK_FALSE(observe(session, "omega").has_value());  // it was cut, and no time has passed
  wait_for_limits(session);
  CHECK(observe(session, "omega").has_value());
}

TEST_CASE("a step is not done before its answer is known") {
  Session session;
  session.simulation = std::make_shared<Simulation>(test::cloth(12, 12));
  session.pacing.playing = false;
  session.labs.looked = true;
  session.labs.list.push_back(
      parse_lab(head + "predict: What is it?\nanswer: dt_crit_now within 10 %\ncheck: k_s > 0 N/m\n```\n", "my.md"));
  begin_lab(session, session.labs.list[0].label);
  StepRecord& record = session.labs.run->record();
  std::snprintf(record.typed, sizeof record.typed, "1e-9");
  REQUIRE(predict(session));
  session.update(0, {});
  CHECK_FALSE(record.done);
  CHECK(session.labs.run->awaited == "dt_crit_now");
  for (int n = 0; n < 20000 && !record.done; ++n) {
    session.wants = {};
    session.update(0.05, {});
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  REQUIRE(record.done);
  CHECK(record.answer > 0);
  CHECK_FALSE(record.right);
}

}  // namespace tyglab::lab_file_test
