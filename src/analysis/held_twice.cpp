#include "held_twice.hpp"

#include "closure_rank.hpp"
#include "grow_diagram.hpp"
#include "springfold/continuation/newton.hpp"
#include "springfold/continuation/trace.hpp"
#include "springfold/core/decompositions.hpp"

namespace springfold::analysis {

bool holds_twice(const PathProblem& problem, const Study& study,
                 const continuation::CurvePoint& start) {
  if (study.control != ControlMode::pose || problem.structured() || problem.closures() == 0)
    return false;
  // Where a curve leads on nothing is held twice: ranks are dearer than rays.
  const auto rays = rays_from(problem, start.x, start.lambda, start.piece, options_of(study.trace));
  if (rays.rays.size() == 2 && rays.complete) return false;
  continuation::CurvePoint at = start;
  if (!closures_always_depend(problem, at)) return false;
  PathRule rule = problem.rule();
  rule.N = orthonormal_basis(study.direction).rightCols(study.direction.size() - 1);
  const PathProblem mixed(problem.system(start.lambda), std::move(rule));
  at.x = mixed.reduce(problem.expand(start.x, start.lambda));
  return !closures_always_depend(mixed, at);
}

}  // namespace springfold::analysis
