#include "kink_passage.hpp"

#include <algorithm>
#include <utility>

#include "springfold/core/inertia.hpp"

namespace springfold::continuation {

std::string names_of(ProblemView problem, const std::vector<Index>& switches) {
  std::string names;
  for (const Index j : switches) names += (names.empty() ? "" : ", ") + problem.switch_name(j);
  return names;
}

CurvePoint point_on_ray(const Walker& walker, const CurvePoint& at, const Ray& ray) {
  CurvePoint point = at;
  point.tangent = ray.tangent;
  point.piece = ray.piece;
  point.negative.reset();
  Linearisation linear;
  if (walker.problem.symmetric() && linearise(walker.problem, at.x, at.lambda, ray.piece, linear)) {
    const auto inertia = inertia_of(linear.dF_dx);
    if (inertia && inertia->zero == 0) point.negative = inertia->negative;
  }
  return point;
}

Outcome pass_kink(const Walker& walker, const KinkSearch& kink, Progress& progress, Curve& curve) {
  Hit hit{.kind = HitKind::kink,
          .name = names_of(walker.problem, kink.active),
          .point = kink.point,
          .switches = kink.active,
          .s_before = progress.here.s + kink.before,
          .s_after = progress.here.s + kink.after};
  const Rays rays =
      kink.active.size() <= 12
          ? rays_at(walker, kink.point.x, kink.point.lambda, kink.point.piece, kink.active)
          : Rays{.complete = false, .why = "too many switches act at one point"};
  for (const Ray& ray : rays.rays) {
    const bool back = ray.piece == kink.point.piece &&
                      metric_product(walker.weights, ray.tangent, kink.point.tangent) < 0;
    if (!back) hit.leaving.push_back(point_on_ray(walker, kink.point, ray));
  }
  const auto stop = [&](StopReason reason, std::string detail) {
    curve.stop = reason;
    curve.stop_detail = std::move(detail);
    curve.hits.push_back(std::move(hit));
    return Outcome::stop;
  };
  if (hit.leaving.empty()) return stop(StopReason::no_way_out, "no way out at " + hit.name);
  if (hit.leaving.size() > 1) {
    hit.kind = HitKind::branching_kink;
    const std::string ways = std::to_string(hit.leaving.size());
    return stop(StopReason::several_ways, ways + " ways out at " + hit.name);
  }
  if (!rays.complete) return stop(StopReason::several_ways, "unresolved kink: " + rays.why);

  const CurvePoint& next = hit.leaving.front();
  if ((next.tangent.dlambda < 0) != (kink.point.tangent.dlambda < 0)) hit.kind = HitKind::corner;
  progress.here = next;
  progress.left = kink.active;
  progress.ds = std::min(progress.ds, walker.options.step.initial);
  curve.hits.push_back(std::move(hit));
  return Outcome::go_on;
}

}  // namespace springfold::continuation
