#include "core/engines/opencl/program_text.h"

namespace tyglab::opencl {
namespace {

/// A sweep as a kernel.
struct Wanted {
  const Sweep& sweep;
  int vectors;
  int seen;            ///< vector that damping sees where a step begins
  bool last = false;   ///< it ends a step, so bodies act and motion is watched
  bool force = true;   ///< it computes one
  bool often = false;  ///< as often as the last one, so it is built for speed
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
    const std::string from = wanted.force && n == sweep.position   ? "own_x"
                             : wanted.force && n == sweep.velocity ? "own_v"
                                                                   : "load(" + numbered("i", n) + " + at, stride)";
    text += "    vec " + numbered("y", n) + " = " + from + ";\n";
  }
  if (wanted.last) text += "    const vec old = y0, old_v = y1;\n";
  int next = 0;
  for (const Assignment& assignment : sweep.assignments)
    text += "    " + numbered("y", assignment.target) + " = " + sum_text(assignment, next) + ";\n";
  if (wanted.last) {
    text += "    MEET_BODIES(old, old_v, y0, y1, " + numbered("y", wanted.seen) +
            (wanted.seen == vector_v ? ", 1);\n" : ", 0);\n");
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
          ");\n  bitsv most = 0;\n  if (inside) {\n    " + (wanted.force ? "FIND_FORCE" : "FIND_FIXED(block.mask)") +
          ";\n";
  for (int n = 0; n < wanted.vectors; ++n) {
    const std::string k = std::to_string(n);
    text += "    global const REAL* i" + k + " = in" + k + ";\n    global REAL* o" + k + " = out" + k + ";\n";
  }
  return text + update_text(wanted) + "  }\n" + (wanted.last ? "  WATCH(way_word(most));\n" : "");
}

/// What a row's forces are computed from, and where they are carried to.
std::string row_text(const Sweep& sweep) {
  const std::string P = std::to_string(sweep.position), V = std::to_string(sweep.velocity);
  return "    const Row r = {i" + P + ", IN(" + P + ", in" + P + ", 1), IN(" + P + ", in" + P + ", 2), i" + V +
         ", IN(" + V + ", in" + V +
         ", 1), RING(0), RING(1), RING(2), masks + place(row, 0, mask_pitch), stride, mask_pitch, row, linear + "
         "place(row, 0, linear_parts * mask_pitch)};\n"
         "    if (row == first) clear_row(r.f0, pitch), clear_row(r.f1, pitch);\n"
         "    Carry carry = {{ZERO, ZERO, ZERO}, {ZERO, ZERO, ZERO}, {ZERO, ZERO, ZERO}};\n";
}

/// What a block begins with.
std::string force_text(const Wanted& wanted) {
  if (!wanted.force) return "FIND_FIXED(masks + place(row, column, mask_pitch));\n    const int at = column";
  return wanted.last || wanted.often ? "FIND_FORCE" : "FIND_FORCE_SLOWLY";
}

/// A kernel of band.cl: a band of rows, some steps of it.
std::string band_text(const Wanted& wanted) {
  const Sweep& sweep = wanted.sweep;
  std::string text = "  FOR_EACH_ROW {\n    FIND_ROW(" + std::to_string(wanted.vectors) + ");\n";
  for (int n = 0; n < wanted.vectors; ++n) {
    const std::string k = std::to_string(n);
    text += "    global const REAL* i" + k + " = IN(" + k + ", in" + k + ", 0);\n";
    text += "    global REAL* o" + k + " = OUT(" + k + ", out" + k + ");\n";
  }
  text += wanted.force ? row_text(sweep) : "    if (!updates) continue;\n";
  text += "    bitsv most = 0;\n";
  text += "    for (int column = 0; column < columns; column += WIDTH) {\n    " + force_text(wanted) + ";\n" +
          update_text(wanted) + "    }\n";
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

const Sweep& readout() {
  static const Sweep sweep{vector_x, vector_v, 0, {{readout_target, {{acceleration, 1, 0}}}}};
  return sweep;
}

std::vector<Pass> passes(const Scheme& scheme) {
  std::vector<Pass> list;
  for (const Sweep& sweep : scheme.sweeps) {
    Sweep before = sweep;
    before.assignments = sweep.before;
    if (!sweep.before.empty()) list.push_back({Work::sums, before});
    if (sweep.solves != 0) list.push_back({Work::solution, sweep});
    list.push_back({sweep.solves != 0 ? Work::sums : Work::forces, sweep});
  }
  return list;
}

const Sweep& residual() {
  static const Sweep sweep{
      vector_x, vector_v, 0, {{residual_target, {{residual_start, 1, 0}, {vector_v, -1, 0}, {acceleration, 1, 1}}}}};
  return sweep;
}

std::string program_text(const Scheme& scheme) {
  const int vectors = scheme.vectors, seen = seen_velocity(scheme);
  std::string text;
  for (const char* file :
       {"cloth.cl", "gather.cl", "band.cl", "body.cl", "contact.cl", "bodies.cl", "sweep.cl", "tears.cl"})
    text += kernel_text(file);
  const std::vector<Pass> list = passes(scheme);
  for (std::size_t n = 0; n < list.size(); ++n)
    if (list[n].work != Work::solution)
      text += kernel_for("pass_" + std::to_string(n), {.sweep = list[n].sweep,
                                                       .vectors = vectors,
                                                       .seen = seen,
                                                       .last = n + 1 == list.size(),
                                                       .force = list[n].work == Work::forces});
  const Sweep start{vector_x, vector_v, 0, scheme.start};
  if (!scheme.start.empty()) text += kernel_for("start", {.sweep = start, .vectors = vectors, .seen = seen});
  if (is_implicit(scheme)) {
    text += kernel_text("implicit.cl");
    text +=
        kernel_for("residual", {.sweep = residual(), .vectors = residual_target + 1, .seen = vector_v, .often = true});
  }
  return text + kernel_for("accelerations", {.sweep = readout(), .vectors = readout_target + 1, .seen = vector_v});
}

}  // namespace tyglab::opencl
