// Writes out one step of one particle: its forces stencil by stencil, and every sum of the method's table with numbers.
// It is computed in double from the table (scheme.h), independently of the engines, so it also checks them.
//
// The result equals the engine's own step up to rounding (tests/unit/step_trace_test.cpp: 1e-13 m), so the Inside card
// shows the real calculation.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "core/forces/readout.h"
#include "core/simulation.h"

namespace tyglab {

struct Scheme;

/// factor · dt^dt_power · vector, with the vector's value.
struct TracedTerm {
  int vector;  ///< as in Term: acceleration is a
  double factor;
  int dt_power;
  glm::dvec3 value;
};

struct TracedAssignment {
  int target;
  std::vector<TracedTerm> terms;
  glm::dvec3 result;
};

/// One evaluation of the force and what is made of it.
struct TracedStage {
  glm::dvec3 x{0}, v{0};  ///< where a(x, v) is evaluated: m, m/s
  ParticleForces forces;
  std::vector<StencilForce> stencils;  ///< of internal forces
  glm::dvec3 a{0};                     ///< m/s²; 0 for what is pinned or held
  std::vector<TracedAssignment> assignments;
};

struct StepTrace {
  int i = 0, j = 0;
  double dt = 0;
  std::string integrator;
  bool fixed = false;               ///< pinned or held: no force moves it
  bool whole = false;               ///< the stages are all of the step; else it solves, projects or chooses steps
  std::vector<TracedStage> stages;  ///< where not whole: the beginning alone
  glm::dvec3 x{0}, v{0};            ///< before the step, as the method holds them
  glm::dvec3 x_after{0};            ///< after it: from the stages, or else from a copy that makes the step
};

/// The name of a state vector of a method: "x", "v", "d"; stages "x*", "v*", growing sums "X", "V".
std::string vector_name(const Scheme& scheme, int vector);

/// The step that the simulation would make next, for a particle of a cloth. Leaves it as it is. Throws EngineError.
StepTrace trace_step(const Simulation& simulation, int i, int j);

}  // namespace tyglab
