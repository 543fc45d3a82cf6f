// `tyglab bench one-weight` and `bench accuracy` from the outside: rows, fields, pictures, Ctrl-C.
#include <doctest/doctest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/integrators/scheme.h"
#include "tests/support/devices.h"
#include "tests/support/files.h"

namespace tyglab::accuracy_test {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// The names of an object's first entries, in order.
std::vector<std::string> first_keys(const Json& object, std::size_t count) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items())
    if (keys.size() < count) keys.push_back(key);
  return keys;
}

TEST_CASE("bench one-weight: the errors of figure 3.2, and its picture") {
  const test::TemporaryFolder folder;
  const auto outcome = test::tyglab(folder.path(), {"bench", "one-weight", "--json", "w.json", "--png", "w.png"});
  REQUIRE_MESSAGE(outcome.code == 0, outcome.err);
  const Json json = Json::parse(test::read_file(folder / "w.json"));
  for (const char* key : {"machine", "version", "build"}) CHECK(json.contains(key));
  std::map<std::string, double> error;
  for (const Json& row : json["runs"]) {
    error[row["integrator"]] = row["error_rms_m"];
    CHECK(double(row["error_largest_m"]) >= double(row["error_rms_m"]));
    CHECK(row["status"] == "ok");
  }
  CHECK(error.size() == integrator_names().size());
  // As the report says: Euler runs away, improved Euler less, Verlet does not.
  CHECK(error["euler"] > 2 * error["improved_euler"]);
  CHECK(error["improved_euler"] > 50 * error["verlet"]);
  CHECK(error["rk4"] < 1e-5);
  CHECK(test::read_file(folder / "w.png").starts_with("\x89PNG"));
}

TEST_CASE("bench one-weight has no error of a method that diverged") {
  const test::TemporaryFolder folder;
  const auto outcome =
      test::tyglab(folder.path(), {"bench", "one-weight", "--set", "m=1e-9", "--set", "k=1e9", "--json", "w.json"});
  REQUIRE(outcome.code == 0);
  int diverged = 0;
  const auto json = nlohmann::json::parse(test::read_file(folder.path() / "w.json"));
  for (const auto& row : json["runs"]) {
    CHECK((row["status"] == "diverged") == row["error_rms_m"].is_null());
    diverged += row["status"] == "diverged";
  }
  CHECK(diverged >= 5);
}

TEST_CASE("bench one-weight takes settings, and damping is in its closed form too") {
  const test::TemporaryFolder folder;
  const auto outcome = test::tyglab(
      folder.path(), {"bench", "one-weight", "--set", "k_d=0.3", "--set", "dt=0.002", "--seconds", "1", "--json", "-"});
  REQUIRE_MESSAGE(outcome.code == 0, outcome.err);
  const Json json = Json::parse(outcome.out);
  for (const Json& row : json["runs"]) {
    CHECK(row["steps"] == 500);
    if (row["integrator"] == "rk4") CHECK(double(row["error_largest_m"]) < 1e-8);
  }
}

TEST_CASE("bench accuracy: the fixed fields in their order, every integrator in both precisions, Odeint's rows") {
  const test::TemporaryFolder folder;
  const auto outcome =
      test::tyglab(folder.path(), {"bench", "accuracy", "--quick", "--scene", "one_weight", "--json", "a.json"});
  REQUIRE_MESSAGE(outcome.code == 0, outcome.err);
  const Json json = Json::parse(test::read_file(folder / "a.json"));
  const std::vector<std::string> fields{"scene",       "engine", "precision",         "integrator",
                                        "dt",          "steps",  "force_evaluations", "seconds",
                                        "error_rms_m", "status"};
  std::set<std::pair<std::string, std::string>> methods, on_opencl;
  for (const Json& row : json["runs"]) {
    REQUIRE(first_keys(row, fields.size()) == fields);
    CHECK((row["status"] == "diverged") == row["error_rms_m"].is_null());
    auto& list = row["engine"] == "opencl" ? on_opencl : methods;
    list.insert({row["integrator"].get<std::string>(), row["precision"].get<std::string>()});
  }
  for (const char* name : {"verlet", "rk4", "implicit_euler"})
    CHECK(on_opencl.count({name, "float"}) == (test::device_there() ? 1 : 0));
  for (const std::string precision : {"float", "double"}) {
    for (const std::string_view name : integrator_names()) CHECK(methods.count({std::string(name), precision}) == 1);
    for (const char* name : {"odeint_runge_kutta4", "odeint_runge_kutta_dopri5", "odeint_runge_kutta_fehlberg78",
                             "odeint_velocity_verlet", "odeint_adams_bashforth_moulton"})
      CHECK(methods.count({name, precision}) == 1);
  }
  const Json& reference = json["references"]["one_weight"];
  CHECK(reference["agreement_rms_m"] == 0);
  CHECK(reference.contains("predictable_s"));
  CHECK(json["summary"].size() == 5);
}

TEST_CASE("bench accuracy that is interrupted keeps the rows it has") {
  const test::TemporaryFolder folder;
  const auto outcome =
      test::tyglab_interrupted(folder.path(), {"bench", "accuracy", "--scene", "one_weight", "--json", "a.json"}, 1.5);
  CHECK(outcome.code == 130);
  const Json json = Json::parse(test::read_file(folder / "a.json.incomplete"));
  CHECK(!json["runs"].empty());
}

}  // namespace tyglab::accuracy_test
