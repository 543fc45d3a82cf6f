// `tyglab verify`: the gallery of cases with exact or published answers (core/verify/gallery.h).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <iostream>
#include <memory>

#include "app/cli/bench_output.h"
#include "app/cli/commands/commands.h"
#include "app/process/interrupt.h"
#include "core/analysis/machine.h"
#include "core/analysis/study_run.h"
#include "core/model/notation.h"
#include "core/model/words.h"
#include "core/verify/gallery.h"

namespace tyglab {
namespace {

using Json = nlohmann::ordered_json;
using verify::Case;
using verify::Outcome;

struct VerifyOptions : BenchOptions {
  std::vector<std::string> names;
  std::string disturb;
};

/// The cases asked for, each once, in their order; all of them where none is named. Throws UsageError for a name that
/// is none.
std::vector<const Case*> chosen_cases(const std::vector<std::string>& names) {
  std::vector<const Case*> all = verify::all_cases();
  std::vector<std::string_view> known;
  known.reserve(all.size());
  for (const Case* one : all) known.push_back(one->name);
  for (const std::string& name : names)
    if (verify::find_case(name) == nullptr)
      throw UsageError("verify " + name + ": there is no such case" + did_you_mean(name, known, ".") +
                       " The cases: " + joined(known));
  if (!names.empty())
    std::erase_if(all,
                  [&](const Case* one) { return std::find(names.begin(), names.end(), one->name) == names.end(); });
  return all;
}

/// Multiplies a constant of the forces in whatever is simulated, as KEY=FACTOR says. Throws UsageError for another one.
std::function<void(Preset&)> disturbance(const std::string& text) {
  if (text.empty()) return {};
  const std::size_t equals = text.find('=');
  const std::string key = text.substr(0, equals);
  std::vector<std::string_view> known;
  for (const PresetRow& row : notation())
    if (row.section == "forces" && std::holds_alternative<double Preset::*>(row.field)) known.push_back(row.key);
  if (std::find(known.begin(), known.end(), key) == known.end())
    throw UsageError("--disturb " + text + ": " + key + " is no constant of the forces" +
                     did_you_mean(key, known, ".") + " These are: " + joined(known));
  std::string factor = equals == std::string::npos ? "" : text.substr(equals + 1);
  if (const std::string fault = number_between(0, 1e6)(factor); !fault.empty())
    throw UsageError("--disturb " + text + ": a factor belongs behind the =, as in " + key + "=1.1. " + fault);
  const auto field = std::get<double Preset::*>(find_row(key)->field);
  return [field, by = std::stod(factor)](Preset& preset) {
    preset.*field *= by;
    preset = nearest_allowed(preset);
  };
}

/// Lengths in m, rounded to 10 µm: pictures need no more.
Json picture_json(const verify::Picture& picture) {
  const auto place = [](const glm::dvec3& x) {
    const auto rounded = [](double value) { return std::isfinite(value) ? std::round(value * 1e5) / 1e5 : 0; };
    return Json{rounded(x.x), rounded(x.y), rounded(x.z)};
  };
  Json x = Json::array(), bodies = Json::array();
  for (const glm::dvec3& at : picture.x) x.push_back(place(at));
  for (const Body& body : picture.bodies)
    bodies.push_back({{"shape", name_of(body.shape)},
                      {"c", place(body.c)},
                      {"y", body.y},
                      {"r", body.r},
                      {"size", place(body.size)},
                      {"length", body.length},
                      {"turn", place(body.turn)}});
  return {
      {"rows", picture.rows}, {"columns", picture.columns}, {"x", x}, {"pinned", picture.pinned}, {"bodies", bodies}};
}

Json case_json(const Outcome& outcome) {
  const Case& of = *outcome.of;
  Json json = {{"name", of.name},
               {"exact", finite_or_null(outcome.exact)},
               {"measured", finite_or_null(outcome.measured)},
               {"error", finite_or_null(outcome.error)},
               {"allowed", of.allowed},
               {"order", outcome.order ? finite_or_null(outcome.order->measured) : Json(nullptr)},
               {"source", of.source},
               {"ok", outcome.ok()},
               {"unit", of.unit},
               {"title", of.title},
               {"sentence", of.sentence},
               {"formula", of.formula},
               {"at", outcome.at},
               {"comparisons", outcome.comparisons},
               {"seconds", outcome.seconds}};
  if (outcome.order) {
    json["order_expected"] = outcome.order->expected, json["order_within"] = of.order_within;
    json["order_at"] = outcome.order->of;
    json["errors"] = Json::array();
    for (const double error : outcome.order->errors) json["errors"].push_back(finite_or_null(error));
  }
  if (!outcome.problem.empty()) json["problem"] = outcome.problem;
  json["picture"] = picture_json(outcome.picture);
  return json;
}

/// The topic of each case, and what was measured, in the order of the gallery.
Json cases_json(const std::vector<Outcome>& outcomes) {
  Json cases = Json::array();
  for (const Outcome& outcome : outcomes) {
    cases.push_back(case_json(outcome));
    for (const verify::Topic& topic : verify::topics())
      if (outcome.of >= topic.cases.data() && outcome.of < topic.cases.data() + topic.cases.size())
        cases.back()["topic"] = topic.name;
  }
  return cases;
}

void print_outcome(std::ostream& out, const Outcome& outcome) {
  const Case& of = *outcome.of;
  char line[256], order[32] = "      ";
  if (outcome.order) std::snprintf(order, sizeof order, "%6.2f", outcome.order->measured);
  std::snprintf(line, sizeof line, "%-24s %13.7g %13.7g  %9.2e  %9.2e  %s  %s", std::string(of.name).c_str(),
                outcome.exact, outcome.measured, outcome.error, of.allowed, order, outcome.ok() ? "ok" : "FAILS");
  out << line;
  if (!outcome.ok()) {
    out << "  " << (outcome.problem.empty() ? outcome.at : outcome.problem);
    if (outcome.order && std::abs(outcome.order->measured - outcome.order->expected) > of.order_within)
      out << "  order of " << (outcome.order->of.empty() ? "refinement" : outcome.order->of) << ": "
          << short_number(outcome.order->expected, 3) << " expected";
  }
  out << '\n' << std::flush;
  flush_standard_output();
}

int verify_cases(const VerifyOptions& options) {
  const std::vector<const Case*> cases = chosen_cases(options.names);
  const verify::Conditions conditions{InterruptGuard::interrupted, disturbance(options.disturb)};
  check_outputs(options.outputs());
  std::ostream& out = people(options.outputs());
  out << machine_line() << '\n';
  char head[256];
  std::snprintf(head, sizeof head, "%-24s %13s %13s  %9s  %9s  %6s\n", "case", "exact", "measured", "error", "allowed",
                "order");
  out << head << std::flush;
  std::vector<Outcome> outcomes(cases.size());
  std::size_t done = 0;
  InterruptGuard guard;
  Progress progress("verify");
  try {
    in_parallel(
        int(cases.size()), options.threads > 0 ? options.threads : processors(),
        [&](int n) { outcomes[std::size_t(n)] = verify::measure(*cases[std::size_t(n)], conditions); },
        [&](int n) {
          progress.clear();
          print_outcome(out, outcomes[std::size_t(n)]);
          progress.update(double(++done) / double(cases.size()));
        },
        InterruptGuard::interrupted);
  } catch (const Stopped&) {
  }
  progress.clear();
  outcomes.resize(done);
  if (!options.json.empty()) {
    Json json = bench_json("verify", Json::array());
    json.erase("runs");
    if (!options.disturb.empty()) json["disturb"] = options.disturb;
    json["cases"] = cases_json(outcomes);
    write_output(options.json, json_text(json), bench_reach());
  }
  if (const int code = bench_exit(options.outputs()); code != exit_done) return code;
  std::vector<std::string_view> failed;
  for (const Outcome& outcome : outcomes)
    if (!outcome.ok()) failed.push_back(outcome.of->name);
  out << outcomes.size() - failed.size() << " of " << outcomes.size()
      << (outcomes.size() == 1 ? " case holds.\n" : " cases hold.\n");
  if (failed.empty()) return exit_done;
  std::cerr << "tyglab: " << failed.size() << " of " << outcomes.size() << " cases failed: " << joined(failed) << ".\n";
  return exit_violation;
}

}  // namespace

void add_verify_command(CLI::App& program, Action& action) {
  CLI::App* command =
      program.add_subcommand("verify", "Measure cases with exact or published answers, and check each error");
  const auto options = std::make_shared<VerifyOptions>();
  command->add_option("CASE", options->names, "Cases to measure; all of them where none is named");
  add_threads(*command, *options, "Simultaneous cases");
  command
      ->add_option("--disturb", options->disturb,
                   "Multiply a constant of the forces in all simulations, to see cases fail")
      ->type_name("KEY=FACTOR")
      ->transform(not_empty());
  add_json(*command, *options);
  command->footer("Example: tyglab verify free_fall pendulum");
  command->callback([&action, options] { action = [options] { return verify_cases(*options); }; });
}

}  // namespace tyglab
