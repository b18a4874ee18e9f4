// The words of case files for the settings of a study.
#include "springfold/analysis/study.hpp"

namespace springfold::analysis {

std::string_view to_string(StudyKind kind) {
  switch (kind) {
    case StudyKind::equilibrium:
      return "equilibrium";
    case StudyKind::force_deflection:
      return "force_deflection";
    case StudyKind::equilibria:
      return "equilibria";
    case StudyKind::control:
      return "control";
    case StudyKind::map:
      return "map";
    case StudyKind::workspace:
      return "workspace";
    case StudyKind::critical_curve:
      return "critical_curve";
    case StudyKind::threshold:
      return "threshold";
    case StudyKind::sensitivity:
      return "sensitivity";
    case StudyKind::critical_load:
      return "critical_load";
    case StudyKind::design:
      return "design";
  }
  return "";
}

std::string_view to_string(ControlMode control) {
  switch (control) {
    case ControlMode::load:
      return "load";
    case ControlMode::pose:
      return "pose";
    case ControlMode::mixed:
      return "mixed";
    case ControlMode::actuator:
      return "actuator";
    case ControlMode::parameter:
      return "parameter";
  }
  return "";
}

std::string_view to_string(StartSolve solve) {
  switch (solve) {
    case StartSolve::pose:
      return "pose";
    case StartSolve::actuators:
      return "actuators";
    case StartSolve::wrench:
      return "wrench";
  }
  return "";
}

std::string_view to_string(StartSolver solver) {
  switch (solver) {
    case StartSolver::newton:
      return "newton";
    case StartSolver::fixed_point:
      return "fixed_point";
  }
  return "";
}

}  // namespace springfold::analysis
