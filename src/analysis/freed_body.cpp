#include "freed_body.hpp"

#include <algorithm>
#include <cassert>

namespace springfold::analysis {
namespace {

bool drives_a_pose(const PathRule& rule) {
  return !rule.family && !rule.t_rate.isZero(0) && rule.rho_rate.isZero(0) &&
         rule.load_rate.isZero(0);
}

/// The direction before the coordinates that are free: those of a rotation stay the last ones.
PathRule freed_rule(PathRule rule) {
  Matrix free(rule.N.rows(), rule.N.cols() + 1);
  free << rule.t_rate.normalized(), rule.N;
  rule.N = std::move(free);
  rule.t_rate.setZero();
  return rule;
}

}  // namespace

continuation::Freed freed_of(const CaseCurves& curves) {
  const PathProblem& driven = *curves.base().problem;
  const PathRule& rule = driven.rule();
  if (!drives_a_pose(rule)) return {};
  continuation::Freed freed;
  freed.unit = rule.t_rate.norm();
  const Index t = driven.layout().body_slices[static_cast<std::size_t>(rule.body - 1)].t;
  const auto& rotations = driven.free_rotations();
  freed.place = t + std::count_if(rotations.begin(), rotations.end(),
                                  [t](const auto& rotation) { return rotation.v < t; });
  // Made anew each time, little beside what is asked of it: nothing tells whether the system is still the same.
  freed.at = [&curves, kept = std::make_shared<std::unique_ptr<PathProblem>>()](
                 double mu) -> std::optional<continuation::ProblemView> {
    const auto followed = curves.followed_at(mu);
    if (!followed) return std::nullopt;
    const PathProblem& own = *followed->problem;
    // Laws of the system are those of the driven problem, which keeps it.
    const std::shared_ptr<const statics::System> system(std::shared_ptr<void>{}, &own.layout());
    *kept = std::make_unique<PathProblem>(system, freed_rule(own.rule()));
    return continuation::ProblemView(**kept);
  };
  const auto at_base = freed.at(curves.base().mu);
  const bool is_longer_by_one = at_base && at_base->size() == driven.size() + 1;
  return is_longer_by_one ? freed : continuation::Freed{};
}

}  // namespace springfold::analysis
