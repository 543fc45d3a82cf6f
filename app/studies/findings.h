// The parts of the results of core's studies, for app/studies/transfer.h.
#pragma once

#include "core/analysis/convergence.h"
#include "core/analysis/settings_search.h"
#include "core/analysis/stability_map.h"

namespace tyglab {

template <class Visit>
void visit_parts(Visit&& visit, ErrorPoint& point) {
  auto& [integrator, precision, dt, tolerance, error, cost, resolved, converged, given_up] = point;
  visit(integrator, precision, dt, tolerance, error, cost, resolved, converged, given_up);
}
template <class Visit>
void visit_parts(Visit&& visit, StudyReference& reference) {
  auto& [seconds, track, agreement, method, dt, over, blow] = reference;
  track.clear();  // for the study alone
  visit(seconds, agreement, method, dt, over, blow);
}
template <class Visit>
void visit_parts(Visit&& visit, Convergence& study) {
  auto& [of, t, seconds, reference, referenced, points, torn, done, problem] = study;
  visit(of, t, seconds, reference, referenced, points, torn, done, problem);
}
template <class Visit>
void visit_parts(Visit&& visit, MapBoundary& boundary) {
  auto& [stiffness, dt, every] = boundary;
  visit(stiffness, dt, every);
}
template <class Visit>
void visit_parts(Visit&& visit, SettingsSearch& search) {
  auto& [of, t, goal, seconds, rough, part, agreement, references, present, points, methods, methods_done, done,
         problem] = search;
  visit(of, t, goal, seconds, rough, part, agreement, references, present, points, methods, methods_done, done,
        problem);
}

}  // namespace tyglab
