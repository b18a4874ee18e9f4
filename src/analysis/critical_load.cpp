#include "critical_load.hpp"

#include <algorithm>
#include <limits>

#include "analysis/undefined.hpp"
#include "branch_rows.hpp"
#include "path_problem.hpp"
#include "resting.hpp"
#include "springfold/continuation/newton.hpp"
#include "springfold/continuation/trace.hpp"
#include "springfold/core/number_text.hpp"
#include "ways_on.hpp"

namespace springfold::analysis {
namespace {

using continuation::Curve;
using continuation::CurvePoint;
using continuation::Hit;
using continuation::HitKind;
using continuation::Ray;

std::optional<Index> unstable_modes(const PathProblem& problem, const CurvePoint& point) {
  continuation::Linearisation at;
  if (!continuation::linearise(problem, point.x, point.lambda, point.piece, at))
    return std::nullopt;
  const auto negative = negative_eigenvalues(at);
  return negative ? std::optional<Index>(*negative - problem.closures()) : std::nullopt;
}

/// Is stability lost at this special point? A spring that switches may, or may not.
bool loses_stability(const PathProblem& problem, const Hit& hit) {
  switch (hit.kind) {
    case HitKind::limit_point:
    case HitKind::branch_point:
    case HitKind::corner:
    case HitKind::branching_kink:
    case HitKind::unresolved:
      return true;
    case HitKind::kink: {
      if (hit.leaving.empty()) return true;
      const auto modes = unstable_modes(problem, hit.leaving.front());
      return modes && *modes > 0;
    }
    case HitKind::touch:
    case HitKind::family:
    case HitKind::user:
    case HitKind::inexact:
      return false;
  }
  return false;
}

PathRule load_rule(const CommandSetup& setup, const CommandedState& state, const Vector& rate) {
  PathRule rule;
  rule.body = setup.task.body;
  rule.t_start = state.z.segment(setup.t, setup.d);
  rule.t_rate = Vector::Zero(setup.d);
  rule.N = Matrix::Identity(setup.d, setup.d);
  rule.rho_start = state.inputs.rho;
  rule.rho_rate = Vector::Zero(state.inputs.rho.size());
  rule.W_start = state.inputs.W;
  rule.W_rate = Vector::Zero(setup.system.load_size);
  rule.W_rate.segment(setup.system.body_slices[static_cast<std::size_t>(setup.task.body - 1)].W,
                      setup.d) = rate;
  rule.length = setup.scales.length;
  rule.symmetric = has_potential(setup.system, {{}, rule.W_start}) &&
                   has_potential(setup.system, {{}, rule.W_rate});
  return rule;
}

/// The curves of one node under a growing load.
class LoadedNode {
 public:
  LoadedNode(const PathProblem& problem, const continuation::TraceOptions& options)
      : problem_{problem}, options_{options} {}

  bool keeps_stability(const Hit& hit) const { return !loses_stability(problem_, hit); }

  /// Special points before a kink are told as they are met, kinks and what is unresolved stand in the curve alone:
  /// there the number of unstable modes ends it.
  Curve follow(const CurvePoint& from, const Ray& ray) const {
    return trace(
        problem_, from.x, from.lambda, ray, events_, options_,
        [this](const CurvePoint& p) { return is_stable(p); },
        [this](const Hit& hit) { return keeps_stability(hit); });
  }

  /// The curve that takes over at a loss of stability, where none is lost.
  std::optional<Curve> taken_over(const Hit& hit) const {
    const bool branches = hit.kind == HitKind::branch_point || hit.kind == HitKind::branching_kink;
    if (!branches) return std::nullopt;
    const LoadedState state{.load = [](const CurvePoint& p) { return p.lambda; },
                            .unstable = [this](const CurvePoint& p) -> std::optional<Index> {
                              // No one piece decides on stability.
                              if (!resting_switches(problem_, p).empty()) return std::nullopt;
                              return unstable_modes(problem_, p);
                            }};
    const auto way = taken_over_at(problem_, hit.point, state, options_);
    if (!way) return std::nullopt;
    continuation::DiagramOptions within{.trace = options_};
    within.ends_at = [](const CurvePoint& p) { return p.lambda < 1 ? "" : "limit"; };
    within.outside = [](const CurvePoint& p) { return p.lambda > 1; };
    Curve curve = curve_along(problem_, *way, events_, std::move(within),
                              [this](const CurvePoint& p) { return p.lambda < 1 && is_stable(p); });
    end_at_limit(curve);
    return curve;
  }

 private:
  /// A limit nearer to the begin of a curve than its first step is passed by that.
  static void end_at_limit(Curve& curve) {
    if (curve.points.empty() || curve.points.back().lambda < 1) return;
    std::erase_if(curve.hits, [](const Hit& hit) { return hit.point.lambda > 1; });
    curve.stop = continuation::StopReason::event;
  }

  bool is_stable(const CurvePoint& p) const {
    return !p.negative || *p.negative <= problem_.closures();
  }

  const PathProblem& problem_;
  const continuation::TraceOptions& options_;
  std::vector<continuation::Event> events_{
      {"limit", [](const CurvePoint& p) { return p.lambda - 1; }, continuation::EventAction::stop}};
};

}  // namespace

CriticalLoad critical_load(const CommandSetup& setup, const CommandedState& state,
                           const CriticalSettings& settings,
                           const continuation::TraceOptions& options) {
  // lambda from 0 to 1 is the load from 0 to its limit.
  const Vector rate = settings.up_to * settings.direction.cwiseQuotient(setup.wrench_scale);
  const PathProblem problem(setup.system, load_rule(setup, state, rate));
  if (!problem.symmetric())
    return {undefined, "moments on a spatial body that turns about several axes have no potential"};
  const Vector y = problem.reduce(state.z);
  const auto rays = rays_from(problem, y, 0, state.piece, options);
  const Ray* forward = nullptr;
  for (const auto& ray : rays.rays)
    if (ray.tangent.dlambda > 0 && (!forward || ray.tangent.dlambda > forward->tangent.dlambda))
      forward = &ray;
  if (forward == nullptr || !rays.complete)
    return {undefined, "the node is no ordinary point of its curve"};
  const LoadedNode node(problem, options);
  Curve curve = node.follow({.x = y, .lambda = 0, .piece = state.piece}, *forward);
  const auto first_loss = [&] {
    return std::ranges::find_if(curve.hits, [&](const Hit& h) { return !node.keeps_stability(h); });
  };
  auto loss = first_loss();
  for (int i = 0; i < most_handovers && loss != curve.hits.end(); ++i, loss = first_loss()) {
    auto onward = node.taken_over(*loss);
    if (!onward) break;
    curve = std::move(*onward);
  }
  if (loss == curve.hits.end()) {
    const bool is_whole = curve.stop == continuation::StopReason::event;
    if (is_whole) return {std::numeric_limits<double>::infinity(), ""};
    const bool is_lost = curve.stop == continuation::StopReason::observer;
    return {undefined, is_lost ? "stability is lost without a special point before the load " +
                                     rounded(settings.up_to * curve.points.back().lambda)
                               : stop_of(curve).reason};
  }
  if (loss->kind == HitKind::unresolved)
    return {undefined, "stability is lost near the load " +
                           rounded(settings.up_to * loss->point.lambda) + ", unresolved"};
  return {settings.up_to * loss->point.lambda, ""};
}

}  // namespace springfold::analysis
