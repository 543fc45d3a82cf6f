#include "core/simulation.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/base/experiment_file.h"
#include "app/python/bindings.h"
#include "core/analysis/frequency.h"
#include "core/integrators/scheme.h"
#include "core/io/output_file.h"
#include "core/io/preset_io.h"
#include "core/output/experiment.h"
#include "core/output/state_csv.h"
#include "core/playback.h"
#include "core/theory/advice.h"
#include "core/theory/modes.h"

namespace tyglab::python {
namespace {

using Vector = std::array<double, 3>;
using Site = std::pair<int, int>;

glm::dvec3 from(const Vector& v) {
  return {v[0], v[1], v[2]};
}
py::array_t<double> to_array(const glm::dvec3& v) {
  const std::array<double, 3> values{v.x, v.y, v.z};
  return py::array_t<double>(3, values.data());
}

/// What the arrays of positions and velocities show, particle by particle; it lives as long as one of them does.
struct Values {
  std::vector<double> x, v;
};

class Motion {
 public:
  Motion(const Preset& preset, int threads) {
    if (const std::string problem = check_preset(preset); !problem.empty()) throw PresetError(problem);
    if (threads < 1 || threads > 256) throw py::value_error("threads must be from 1 to 256");
    simulation_ = std::make_unique<Simulation>(preset, threads);
    simulation_->keep_hashes(true);
    // As `tyglab run` says it at its start. A filter may make it an exception.
    const std::string coarse = precision_too_coarse(preset);
    if (!coarse.empty() && PyErr_WarnEx(PyExc_UserWarning, coarse.c_str(), 1) != 0) throw py::error_already_set();
  }

  const Simulation& at_rest() const {
    if (stepping_) throw std::runtime_error("Another thread is stepping this simulation; wait until it is done.");
    return *simulation_;
  }
  Simulation& at_rest() { return const_cast<Simulation&>(std::as_const(*this).at_rest()); }

  int step(int count) {
    Simulation& simulation = at_rest();
    if (count < 0) throw py::value_error("the number of steps must not be negative");
    if (simulation.divergence()) raise_diverged(*simulation.divergence());
    Interrupt interrupt;
    simulation.stop_when(interrupt.stop());
    const int made = make_steps(count);
    simulation.stop_when({});
    follow();
    interrupt.raise();
    if (simulation.divergence()) raise_diverged(*simulation.divergence());
    return made;
  }

  /// Makes all that was recorded; the simulation is at its start.
  void repeat(Playback& playback) {
    Simulation& simulation = at_rest();
    Interrupt interrupt;
    simulation.stop_when(interrupt.stop());
    {
      const Stepping stepping(stepping_);
      const py::gil_scoped_release unlocked;
      playback.advance(simulation, playback.recording().steps());
    }
    simulation.stop_when({});
    interrupt.raise();
  }

  void apply(const Edit& edit) {
    at_rest().apply(edit);
    follow();
  }
  void restore(const Snapshot& then) {
    if (!at_rest().fits(then))
      throw py::value_error(
          "the snapshot belongs to a cloth with other rows or columns, or torn by the other tearing.mode");
    at_rest().restore(then);
    follow();
  }
  void load(const py::array_t<double, py::array::c_style | py::array::forcecast>& x,
            const py::array_t<double, py::array::c_style | py::array::forcecast>& v) {
    if (at_rest().tears().mesh() != nullptr)
      throw py::value_error("the cloth has parted, and load() knows no copies; use restore() of a snapshot");
    State state = at_rest().read();
    take(x, "positions", state.x);
    take(v, "velocities", state.v);
    at_rest().load(state);
    follow();
  }

  py::array positions() { return array_of(&Values::x); }
  py::array velocities() { return array_of(&Values::v); }

  /// Work that reads the simulation while Python goes on; other threads may not use it then.
  template <class Work>
  auto beside(const Work& work) {
    const Stepping stepping(stepping_);
    return beside_python(work);
  }

  /// Not finite, or more than the simulation's numbers hold.
  void check(double value, const char* what) const {
    const bool single = at_rest().preset().precision == Precision::float_;
    const double most = single ? std::numeric_limits<float>::max() : std::numeric_limits<double>::max();
    if (!std::isfinite(value)) throw py::value_error(std::string(what) + " must be finite");
    if (std::abs(value) > most) throw py::value_error(std::string(what) + " must be below 3.4e38 in float");
  }
  void check(int i, int j) const {
    if (!at_rest().has(i, j))
      throw py::index_error("there is no particle (" + std::to_string(i) + ", " + std::to_string(j) + ")");
  }

 private:
  struct Stepping {
    explicit Stepping(bool& flag) : on(flag) { on = true; }
    ~Stepping() { on = false; }
    Stepping(const Stepping&) = delete;
    Stepping& operator=(const Stepping&) = delete;
    bool& on;
  };

  int make_steps(int count) {
    const Stepping stepping(stepping_);
    const py::gil_scoped_release unlocked;
    return simulation_->advance(count).steps;
  }

  /// Arrays that somebody still has show the present; those of a cloth with other rows or columns stay as they were.
  void follow() {
    if (!values_) return;
    if (values_.use_count() == 1 || values_->x.size() != 3 * std::size_t(simulation_->lattice().sites().size()))
      values_.reset();
    else
      fill();
  }
  void fill() {
    const State& state = simulation_->read();
    for (std::size_t p = 0; 3 * p < values_->x.size(); ++p) {
      double* x = &values_->x[3 * p];
      double* v = &values_->v[3 * p];
      x[0] = state.x.x[p], x[1] = state.x.y[p], x[2] = state.x.z[p];
      v[0] = state.v.x[p], v[1] = state.v.y[p], v[2] = state.v.z[p];
    }
  }
  py::array array_of(std::vector<double> Values::*field) {
    const Lattice lattice = at_rest().lattice().sites();
    if (!values_) {
      auto fresh = std::make_shared<Values>();
      fresh->x.resize(3 * lattice.size()), fresh->v.resize(3 * lattice.size());
      values_ = std::move(fresh);
      fill();
    }
    auto* kept = new std::shared_ptr<Values>(values_);
    const py::capsule owner(kept, [](void* p) { delete static_cast<std::shared_ptr<Values>*>(p); });
    py::array_t<double> array({lattice.rows, lattice.columns, 3}, ((*values_).*field).data(), owner);
    array.attr("flags").attr("writeable") = false;
    return array;
  }
  void take(const py::array_t<double, py::array::c_style | py::array::forcecast>& from, const char* what,
            VectorField<double>& to) const {
    const Lattice lattice = at_rest().lattice().sites();
    if (from.ndim() != 3 || from.shape(0) != lattice.rows || from.shape(1) != lattice.columns || from.shape(2) != 3)
      throw py::value_error(std::string(what) + " must have the shape (" + std::to_string(lattice.rows) + ", " +
                            std::to_string(lattice.columns) + ", 3)");
    const double* value = from.data();
    for (std::size_t p = 0; p < std::size_t(lattice.size()); ++p, value += 3) {
      for (int c = 0; c < 3; ++c) check(value[c], what);
      to.x[p] = value[0], to.y[p] = value[1], to.z[p] = value[2];
    }
  }

  std::unique_ptr<Simulation> simulation_;
  std::shared_ptr<Values> values_;
  bool stepping_ = false;  ///< guarded by the interpreter's lock
};

py::str key_of(std::string_view name) {
  return {name.data(), name.size()};
}

py::list copies(Motion& motion) {
  const Tears& tears = motion.at_rest().tears();
  const State& state = motion.at_rest().read();
  py::list all;
  for (int n = tears.lattice().sites().size(); n < tears.particles(); ++n) {
    const Pins::Site site = tears.site(n);
    const auto at = [&](const VectorField<double>& f) {
      return py::make_tuple(f.x[std::size_t(n)], f.y[std::size_t(n)], f.z[std::size_t(n)]);
    };
    all.append(py::make_tuple(py::make_tuple(site.i, site.j), at(state.x), at(state.v)));
  }
  return all;
}

py::dict energy(Motion& motion) {
  const Energy now = motion.at_rest().energy().energy;
  py::dict all;
  all["kinetic"] = now.kinetic, all["total"] = now.total();
  for (const Force* force : force::all)
    if (force->conserves) all[key_of(force->name)] = now.of[*force];
  return all;
}

py::object ledger(Motion& motion) {
  const auto now = motion.at_rest().ledger();
  if (!now) return py::none();
  py::dict all;
  all["began"] = now->began, all["start"] = now->start, all["total"] = now->energy.total();
  for (const Force* force : force::all)
    if (!force->conserves) all[key_of(force->name)] = now->works.of[*force];
  all["contact"] = now->works.contact, all["tearing"] = now->works.tearing;
  all["hand"] = now->works.hand, all["edits"] = now->works.edits;
  all["unexplained"] = now->unexplained();
  return all;
}

py::object solves(const Motion& motion) {
  const Simulation& simulation = motion.at_rest();
  if (!solves_equations(scheme(simulation.preset().integrator))) return py::none();
  const SolveCounts counts = simulation.engine().solves();
  py::dict dict;
  dict["newton_steps"] = counts.newton, dict["linear_steps"] = counts.linear;
  dict["force_evaluations"] = counts.force_evaluations, dict["unconverged"] = counts.unconverged;
  dict["unconverged_by_rounding"] = counts.rounded;
  dict["ended_early"] = counts.ended_early, dict["longest_limited"] = counts.longest_limited;
  dict["worst_residual"] = counts.worst_residual;
  return dict;
}

void limit_steps(Motion& motion, double seconds) {
  if (!(seconds >= 0) || !std::isfinite(seconds)) throw py::value_error("seconds must be a finite number, 0 or more");
  motion.at_rest().limit_steps(seconds);
}

py::dict particle(const Motion& motion, int i, int j) {
  motion.check(i, j);
  const ParticleReadout r = motion.at_rest().particle(i, j);
  py::dict all;
  for (const std::string_view key : force_keys()) all[key_of(key)] = to_array(r.forces[key]);
  all["x"] = to_array(r.x), all["v"] = to_array(r.v), all["a"] = to_array(r.a);
  all["pinned"] = r.pinned, all["held"] = r.held;
  return all;
}

double worst_case_limit(const Motion& motion) {
  const Preset& preset = motion.at_rest().preset();
  const bool limited = has_step_limit(scheme(preset.integrator));
  return limited ? stable_dt(preset, preset.integrator) : std::numeric_limits<double>::infinity();
}

double own_limit(Motion& motion) {
  const Simulation& simulation = motion.at_rest();
  return motion.beside([&](const Stop& stop) {
    const std::vector<Mode> modes = extreme_modes(Linearisation(simulation, stop), exact_tolerance);
    return dt_crit(scheme(simulation.preset().integrator), modes);
  });
}

void cut(Motion& motion, const std::vector<Site>& particles) {
  edit::Cut cut;
  for (const auto& [i, j] : particles) {
    motion.check(i, j);
    cut.sites.push_back({i, j});
  }
  motion.apply(cut);
}

void grab(Motion& motion, int i, int j) {
  motion.check(i, j);
  if (motion.at_rest().preset().kind == Kind::one_weight) throw py::value_error("a mass on a spring cannot be grabbed");
  if (motion.at_rest().pinned(i, j)) throw py::value_error("a pinned particle cannot be grabbed; free it first");
  motion.apply(edit::Grab{i, j});
}

void move_hand(Motion& motion, const Vector& to, int steps) {
  if (!motion.at_rest().held()) throw py::value_error("the hand holds no particle; grab one first");
  if (steps < 1) throw py::value_error("the hand needs at least one step");
  for (const double value : to) motion.check(value, "the hand's position");
  motion.apply(edit::MoveHand{from(to), steps});
}

void move_body(Motion& motion, int index, const Vector& c) {
  const std::size_t count = motion.at_rest().preset().bodies.size();
  if (index < 0 || std::size_t(index) >= count)
    throw py::index_error("there are " + std::to_string(count) + " bodies; their numbers begin at 0");
  motion.apply(edit::MoveBody{index, from(c)});
}

void mark(Motion& motion, const std::string& words) {
  if (words.size() > longest_mark)
    throw py::value_error("a mark may have at most " + std::to_string(longest_mark) + " bytes");
  motion.at_rest().mark(words);
}

/// An experiment that was repeated.
struct Repetition {
  py::object simulation;
  Playback::Comparison found;
  bool repeats;       ///< no step was ended by a limit of real time
  std::string words;  ///< a sentence
};

Repetition repeat(const std::filesystem::path& file, int threads) {
  const Experiment experiment = load_experiment(file);
  auto motion = std::make_unique<Motion>(experiment.recording.start(), threads);
  Playback playback(experiment.recording);
  motion->repeat(playback);
  std::string words = comparison_in_words(playback, experiment);
  words.front() = char(std::toupper(static_cast<unsigned char>(words.front())));
  return {py::cast(std::move(motion)), playback.comparison(), experiment.recording.repeats(), std::move(words)};
}

void add_repetition(py::module_& module) {
  py::class_<Repetition> type(module, "Repetition",
                              "A repeated experiment, and how its positions compare with the recorded ones: repeat().");
  refuse_objects_without_value(type);
  type.def_readonly("simulation", &Repetition::simulation, "The Simulation at the end of the experiment.")
      .def_property_readonly(
          "exact", [](const Repetition& r) { return r.repeats && r.found.compared > 0 && !r.found.differs_at; },
          "Whether the positions were compared, and equal the recorded ones to the last bit in each comparison.")
      .def_property_readonly(
          "compared", [](const Repetition& r) { return r.found.compared; },
          "Number of comparisons: one every 256 steps, and one at the end.")
      .def_property_readonly(
          "equal_until", [](const Repetition& r) { return r.found.equal_until; },
          "The last step at which the positions were compared and equal.")
      .def_property_readonly(
          "differs_at", [](const Repetition& r) { return r.found.differs_at; },
          "The first step at which they were compared and differed, or None.")
      .def_property_readonly(
          "apart",
          [](const Repetition& r) { return r.found.looked_at > 0 ? std::optional(r.found.apart) : std::nullopt; },
          "Largest distance of nine sites (corners, middles of the edges, middle) from where they were recorded last, "
          "m; None if none was recorded.")
      .def("__str__", [](const Repetition& r) { return r.words; });
}

void add_divergence(py::module_& module) {
  py::class_<Divergence> type(module, "Divergence", "Time, place and cause of a divergence.");
  refuse_objects_without_value(type);
  type.def_readonly("t", &Divergence::t, "End of the step that diverged, s.")
      .def_readonly("step", &Divergence::step, "Number of that step, from 1.")
      .def_property_readonly("where", &Divergence::where, "The particle or the spring.")
      .def_readonly("quantity", &Divergence::quantity)
      .def_readonly("value", &Divergence::value,
                    "Value of that quantity, in its SI unit; may be infinite or not a number.")
      .def_readonly("cause", &Divergence::cause)
      .def_readonly("advice", &Divergence::advice)
      .def("__str__", &Divergence::in_words);
}

}  // namespace

void add_simulation(py::module_& module) {
  add_divergence(module);
  py::class_<Snapshot> snapshot(module, "Snapshot", "A stored state of a motion, for restore().");
  refuse_objects_without_value(snapshot);
  snapshot.def_readonly("time", &Snapshot::t, "s");

  using Class = py::class_<Motion>;
  Class motion(
      module, "Simulation",
      "A cloth, or a mass on a spring, in motion. Its steps equal those of `tyglab run` to the last bit, with any "
      "number of threads. Only one Python thread at a time may use it; other threads continue while it makes steps.");
  refuse_objects_without_value(motion);
  motion.def(py::init<const Preset&, int>(), py::arg("preset") = Preset{}, py::arg("threads") = 1)
      .def("step", &Motion::step, py::arg("steps") = 1,
           "Makes `steps` steps of dt and returns the number of steps made, which is smaller only after Ctrl-C. Raises "
           "Diverged.")
      .def(
          "run",
          [](Motion& m, double seconds) {
            const double steps = seconds / m.at_rest().preset().dt;
            if (!(steps >= 0 && steps <= 2e9)) throw py::value_error("seconds must be a time that steps can reach");
            return m.step(int(std::lround(steps)));
          },
          py::arg("seconds"),
          "Makes as many whole steps as come nearest to `seconds` of simulated time; otherwise like step().")
      .def(
          "restart", [](Motion& m) { m.apply(edit::Restart{}); },
          "Returns to the start with the present constants and mends all tears.")
      .def(
          "change",
          [](Motion& m, const py::kwargs& constants) {
            m.apply(edit::Change{with_constants(m.at_rest().preset(), constants)});
          },
          "Changes constants while the cloth moves: simulation.change(k_s=200). Constants of the start take effect at "
          "the next restart. Raises PresetError.")
      .def_property(
          "preset", [](const Motion& m) { return m.at_rest().preset(); },
          [](Motion& m, const Preset& preset) { m.apply(edit::Change{preset}); },
          "A copy of the present constants. Assigning a preset changes the constants that differ.")
      .def_property_readonly(
          "time", [](const Motion& m) { return m.at_rest().time(); }, "Simulated time, s.")
      .def_property_readonly(
          "steps", [](const Motion& m) { return m.at_rest().steps(); }, "Steps made since the start.")
      .def_property_readonly(
          "engine", [](const Motion& m) { return m.at_rest().engine().name(); },
          "Name of the engine that makes the steps.")
      .def_property_readonly(
          "divergence", [](const Motion& m) { return m.at_rest().divergence(); }, "The divergence, or None.");
  motion
      .def_property_readonly("positions", &Motion::positions,
                             "Positions, m: (rows, columns, 3), read-only. The array shares the simulation's memory "
                             "and changes with every step; use copy() to keep its values. After a change of rows or "
                             "columns, an older array keeps the old cloth.")
      .def_property_readonly("velocities", &Motion::velocities,
                             "Velocities at the time of the positions, m/s: an array like positions.")
      .def("load", &Motion::load, py::arg("positions"), py::arg("velocities"),
           "Replaces positions (m) and velocities (m/s), both (rows, columns, 3); time, tears and constants are kept.")
      .def("particle", &particle, py::arg("i"), py::arg("j"),
           "The variables of table B.1 for a particle: the forces F, F_s, F_b, F_d, F_g, F_int, F_ext (N), x (m), v "
           "(m/s) and a (m/s^2), each an array (3,); and whether the particle is pinned or held.")
      .def_property_readonly("energy", &energy,
                             "Energies in J: kinetic, stretch, bending, gravity (0 at y = 0) and total.")
      .def(
          "enable_ledger", [](Motion& m, bool on) { m.at_rest().enable_ledger(on); }, py::arg("on") = true,
          "Keeps the energy ledger from now on. Each step then takes several times as long, with the same result.")
      .def_property_readonly("ledger", &ledger,
                             "Work since the ledger began, J, or None: of damping, contact, tearing, wind, hand and "
                             "edits; unexplained is the energy that the method added (above 0) or removed.")
      .def_property_readonly(
          "solves", &solves,
          "Work of the solver since the start, or None for methods that solve no equations: newton_steps (of Newton's "
          "method or the interior-point method, or passes of methods that make a fixed number of them), linear_steps, "
          "force_evaluations, unconverged (steps), unconverged_by_rounding (the unconverged steps that need more "
          "digits: precision=\"double\"), ended_early (the unconverged steps that limit_steps ended), longest_limited "
          "(real time of the longest step with such a limit, s) and worst_residual (relative to the largest force).")
      .def("limit_steps", &limit_steps, py::arg("seconds"),
           "Limits the real time of a step of implicit_euler, projective_dynamics or vbd, s; 0: no limit. At the limit "
           "a step keeps its current result, so the motion depends on the machine. Raises ValueError for negative "
           "numbers.")
      .def_property_readonly(
          "dt_crit", &worst_case_limit,
          "Largest stable dt in any shape of the cloth, by linear theory, s; infinite if the method has no limit.")
      .def_property_readonly("dt_crit_now", &own_limit,
                             "Largest stable dt in the present shape of the cloth, s: a guide, not a guarantee. The "
                             "computation takes about half a minute for 400 x 400 particles; Ctrl-C ends it.")
      .def_property_readonly(
          "torn", [](const Motion& m) { return m.at_rest().tears().torn_count(); },
          "Stretch springs that are torn or cut; where the cloth parts, particles that did.")
      .def_property_readonly("copies", &copies,
                             "Particles that a parted cloth has beside those of its sites, in the order of their "
                             "origin: (i, j) of the site, position (m), velocity (m/s).");
  motion.def("grab", &grab, py::arg("i"), py::arg("j"), "The hand grabs the particle (i, j), which must not be pinned.")
      .def("move_hand", &move_hand, py::arg("to"), py::arg("steps") = 1,
           "The hand moves to the position `to` (m), evenly over the next steps.")
      .def(
          "release", [](Motion& m) { m.apply(edit::Release{}); }, "The hand lets go.")
      .def_property_readonly(
          "held",
          [](const Motion& m) -> std::optional<Site> {
            const auto held = m.at_rest().held();
            return held ? std::optional(Site{held->i, held->j}) : std::nullopt;
          },
          "The particle (i, j) in the hand, or None.")
      .def("cut", &cut, py::arg("particles"),
           "Cuts the upward springs of these particles, [(i, j), ...] (section 2.3.4).")
      .def(
          "pin",
          [](Motion& m, int i, int j, bool pinned) {
            m.check(i, j), m.apply(edit::Pin{i, j, pinned});
          },
          py::arg("i"), py::arg("j"), py::arg("pinned") = true,
          "Pins the particle (i, j) at its position, or frees it.")
      .def("move_body", &move_body, py::arg("index"), py::arg("c"),
           "Moves a body: a sphere's center, or c[1] as a plane's height, m.");
  motion
      .def(
          "snapshot", [](Motion& m) { return m.at_rest().snapshot(); },
          "Stores the present state of the motion for restore().")
      .def("restore", &Motion::restore, py::arg("snapshot"),
           "Returns to a snapshot with the present constants, and discards a divergence.")
      .def(
          "save_state",
          [](Motion& m, const std::filesystem::path& file) { write_output(file, state_csv(m.at_rest())); },
          py::arg("file"), "Writes the state file that `tyglab run --state` writes. Raises OSError.");
  motion
      .def(
          "save_experiment",
          [](const Motion& m, const std::filesystem::path& file) { save_experiment(experiment_of(m.at_rest()), file); },
          py::arg("file"),
          "Writes the experiment, NAME.tyglab: the first preset, everything done since, at its step, and hashes of the "
          "positions. repeat(), `tyglab run` and the sandbox repeat it. Raises OSError.")
      .def("mark", &mark, py::arg("words"),
           "Adds a remark to the experiment at the present step, at most 1000 bytes. Control characters become spaces.")
      .def_property_readonly(
          "hash", [](const Motion& m) { return m.at_rest().hash(); },
          "Hash of the bits of all positions, 64 bits: equal for two states that agree to the last bit.");
  add_repetition(module);
  module.def("repeat", &repeat, py::arg("file"), py::arg("threads") = 1,
             "Repeats an experiment (Simulation.save_experiment()) from its preset to its end, and compares the "
             "positions with the recorded ones. Raises PresetError for a file that is wrong or missing.");
}

}  // namespace tyglab::python
