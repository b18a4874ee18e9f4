#include "continuation/following/own_branch.hpp"

#include <algorithm>
#include <array>

#include "continuation/locating/evidence.hpp"
#include "continuation/locating/watched_step.hpp"
#include "continuation/points/coincide.hpp"
#include "continuation/points/working_memory.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {

bool may_be_another(const Walker& walker, const CurvePoint& to, double ds, std::string& refusal) {
  const NewtonResult& newton = walker.memory->newton;
  const double moved = newton.corrections.empty() ? 0 : newton.corrections.front();
  // Branches that are nearer than such points are to each other are looked for at narrow places.
  if (moved <= same_point * (1 + to.x.norm())) return false;
  if (stays_within(WatchedStep(walker, to, ds), to, moved, small_share)) return false;
  refusal = "another branch may be as near as the corrected point is to the predicted one";
  return true;
}

namespace {

/// How far a model through `here` passes from a point; in storage that is there already.
double off_model(const Walker& walker, const ArcModel& model, const CurvePoint& here,
                 const CurvePoint& to) {
  Direction& d = walker.memory->direction;
  CurvePoint& expected = walker.memory->trial;
  d.dx = to.x - here.x;
  d.dlambda = to.lambda - here.lambda;
  model.point(walker.weights, here, metric_product(walker.weights, d, here.tangent), expected);
  d.dx = expected.x - to.x;
  d.dlambda = expected.lambda - to.lambda;
  return length_of(walker, d);
}

}  // namespace

bool leads_on(const Walker& walker, const ArcModel& behind, const CurvePoint& before,
              const CurvePoint& here, const CurvePoint& middle, const CurvePoint& to) {
  ArcModel& nearer = walker.memory->ahead;
  if (!nearer.go_through(walker.weights, here, StepSamples(before, &here, middle))) return true;
  const double off = off_model(walker, nearer, here, to);
  // Rounding of exact points and tangents is magnified where a model leads on beyond its nodes by their own length.
  if (off <= one_place * (1 + to.x.norm()) || off <= 0.5 * off_model(walker, behind, here, to))
    return true;
  // In a cluster, where rounding moves points by more than one place is wide, nothing is told apart anyway.
  return std::ranges::any_of(std::array{&middle, &to}, [&](const CurvePoint* p) {
    const auto other = separation_at(WatchedStep(walker, *p, to.s - here.s), *p);
    return other && other->blur > one_place && off <= between_samples * other->blur;
  });
}

}  // namespace springfold::continuation
