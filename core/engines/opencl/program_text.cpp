#include "core/engines/opencl/program_text.h"

#include "core/engines/opencl/kernel_text.h"

namespace tyglab::opencl {
namespace {

/// A sweep as a kernel. `last`: it ends a step, so bodies act and motion is watched.
struct Wanted {
  const Sweep& sweep;
  int vectors;
  int seen;  ///< vector that damping sees where a step begins
  bool last;
};

/// A factor that is 1 whatever dt is takes no multiplication.
bool is_one(const Term& term) {
  return term.vector != acceleration && term.factor == 1 && term.dt_power == 0;
}

std::string numbered(const char* name, int n) {
  return name + std::to_string(n);
}

/// "plus_scaled(scaled(k->c[0], y0), k->c[1], F)"
std::string sum_text(const Assignment& assignment, int& next) {
  std::string sum;
  for (const Term& term : assignment.terms) {
    const std::string vector = term.vector == acceleration ? "F" : numbered("y", term.vector);
    const std::string factor = is_one(term) ? "" : "k->c[" + std::to_string(next++) + "]";
    if (sum.empty())
      sum = factor.empty() ? vector : "scaled(" + factor + ", " + vector + ")";
    else if (factor.empty())
      sum = "plus(" + sum + ", " + vector + ")";
    else
      sum = "plus_scaled(" + sum + ", " + factor + ", " + vector + ")";
  }
  return sum;
}

/// What becomes of a block of particles once the force on it is known; reads rows i0, i1 … and writes o0, o1 …
std::string update_text(const Wanted& wanted) {
  const Sweep& sweep = wanted.sweep;
  std::string text;
  for (int n = 0; n < wanted.vectors; ++n) {
    const std::string from = n == sweep.position   ? "own_x"
                             : n == sweep.velocity ? "own_v"
                                                   : "load(" + numbered("i", n) + " + at, stride)";
    text += "    vec " + numbered("y", n) + " = " + from + ";\n";
  }
  if (wanted.last) text += "    const vec old = y0;\n";
  int next = 0;
  for (const Assignment& assignment : sweep.assignments)
    text += "    " + numbered("y", assignment.target) + " = " + sum_text(assignment, next) + ";\n";
  if (wanted.last) {
    text += "    MEET_BODIES(old, y0, y1, " + numbered("y", wanted.seen) + ");\n";
    text += "    most = max(most, ways(old, y0, y1, k->to_way));\n";
  }
  for (const Assignment& assignment : sweep.assignments)
    text +=
        "    store(" + numbered("y", assignment.target) + ", " + numbered("o", assignment.target) + " + at, stride);\n";
  return text;
}

/// A kernel of gather.cl: one particle.
std::string particle_text(const Wanted& wanted) {
  std::string text = wanted.last ? "  LOCAL_WATCH;\n" : "";
  text += "  FIND_PARTICLE(" + numbered("in", wanted.sweep.position) + ", " + numbered("in", wanted.sweep.velocity) +
          ");\n  bitsv most = 0;\n  if (inside) {\n    FIND_FORCE;\n";
  for (int n = 0; n < wanted.vectors; ++n) {
    const std::string k = std::to_string(n);
    text += "    global const REAL* i" + k + " = in" + k + ";\n    global REAL* o" + k + " = out" + k + ";\n";
  }
  return text + update_text(wanted) + "  }\n" + (wanted.last ? "  WATCH(way_word(most));\n" : "");
}

/// A kernel of band.cl: a band of rows, some steps of it.
std::string band_text(const Wanted& wanted) {
  const std::string P = std::to_string(wanted.sweep.position), V = std::to_string(wanted.sweep.velocity);
  std::string text = "  FOR_EACH_ROW {\n    FIND_ROW(" + std::to_string(wanted.vectors) + ");\n";
  for (int n = 0; n < wanted.vectors; ++n) {
    const std::string k = std::to_string(n);
    text += "    global const REAL* i" + k + " = IN(" + k + ", in" + k + ", 0);\n";
    text += "    global REAL* o" + k + " = OUT(" + k + ", out" + k + ");\n";
  }
  text += "    const Row r = {i" + P + ", IN(" + P + ", in" + P + ", 1), IN(" + P + ", in" + P + ", 2), i" + V +
          ", IN(" + V + ", in" + V +
          ", 1), RING(0), RING(1), RING(2), masks + place(row, 0, mask_pitch), stride, mask_pitch, " + "row};\n";
  text += "    if (row == first) clear_row(r.f0, pitch), clear_row(r.f1, pitch);\n";
  text += "    Carry carry = {{ZERO, ZERO, ZERO}, {ZERO, ZERO, ZERO}, {ZERO, ZERO, ZERO}};\n    bitsv most = 0;\n";
  text += "    for (int column = 0; column < columns; column += WIDTH) {\n    " +
          std::string(wanted.last ? "FIND_FORCE" : "FIND_FORCE_SLOWLY") + ";\n" + update_text(wanted) + "    }\n";
  if (wanted.last) text += "    if (updates) atomic_max(report + report_way, way_word(most));\n";
  return text + "  }\n";
}

std::string kernel_for(const std::string& name, const Wanted& wanted) {
  std::string text = "\nkernel void " + name + "(";
  for (int n = 0; n < wanted.vectors; ++n)
    text += "global const REAL* in" + std::to_string(n) + ", global REAL* out" + std::to_string(n) + ", ";
  return text + "ARGUMENTS) {\n#if WIDTH == 1\n" + particle_text(wanted) + "#else\n" + band_text(wanted) +
         "#endif\n}\n";
}

}  // namespace

std::vector<Coefficient> coefficients(const std::vector<Assignment>& assignments) {
  std::vector<Coefficient> all;
  for (const Assignment& assignment : assignments)
    for (const Term& term : assignment.terms)
      if (!is_one(term)) all.push_back({term.factor, term.dt_power, term.vector == acceleration});
  return all;
}

const Sweep& look() {
  static const Sweep sweep{vector_x, vector_v, 0, {{look_target, {{acceleration, 1, 0}}}}};
  return sweep;
}

std::string program_text(const Scheme& scheme) {
  const int vectors = scheme.vectors, seen = seen_velocity(scheme);
  std::string text;
  for (const char* file : {"cloth.cl", "gather.cl", "band.cl", "bodies.cl", "sweep.cl", "tears.cl"})
    text += kernel_text(file);
  for (std::size_t n = 0; n < scheme.sweeps.size(); ++n)
    text += kernel_for("sweep_" + std::to_string(n), {scheme.sweeps[n], vectors, seen, n + 1 == scheme.sweeps.size()});
  const Sweep start{vector_x, vector_v, 0, scheme.start};
  if (!scheme.start.empty()) text += kernel_for("start", {start, vectors, seen, false});
  return text + kernel_for("accelerations", {look(), look_target + 1, vector_v, false});
}

}  // namespace tyglab::opencl
