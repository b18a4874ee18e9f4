#include "control_leg.hpp"

#include <algorithm>
#include <cmath>

#include "branch_rows.hpp"
#include "closure_rank.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/continuation/trace.hpp"
#include "springfold/core/number_text.hpp"
#include "zero_lengths.hpp"

namespace springfold::analysis {
namespace {

using continuation::Curve;
using continuation::CurvePoint;
using continuation::Hit;
using continuation::HitKind;

CommandedState state_at(const ControlProblem& problem, const CurvePoint& point) {
  CommandedState state;
  state.z = problem.expand(point.x, point.lambda);
  state.inputs = problem.inputs(point.x, point.lambda);
  state.piece = point.piece;
  return state;
}

std::optional<Index> unstable_modes_at(const CommandSetup& setup, const CommandedState& state) {
  if (!has_potential(setup.system, state.inputs)) return std::nullopt;
  statics::Workspace work;
  Vector r;
  Matrix A;
  if (!equilibrium_matrix(setup.system, state.piece, state.z, state.inputs, work, r, A))
    return std::nullopt;
  return statics::unstable_modes(A, setup.system.closure_count());
}

/// The chain whose closure has a lower rank in its own coordinates than at the start of the leg.
std::string singular_chain(const CommandSetup& setup, const CommandedState& start,
                           const CommandedState& here) {
  const auto rank = [&](const CommandedState& state, const statics::ChainSlice& s) -> Index {
    statics::Workspace work;
    Vector r;
    Matrix A;
    equilibrium_matrix(setup.system, state.piece, state.z, state.inputs, work, r, A);
    const Matrix J = A.block(s.F, s.x, s.F_count, s.x_count);
    return rank_of(J, 1e-5);
  };
  for (std::size_t i = 0; i < setup.system.chain_slices.size(); ++i) {
    const statics::ChainSlice& s = setup.system.chain_slices[i];
    if (rank(here, s) < rank(start, s)) return setup.system.mechanism.chains[i].name;
  }
  return "";
}

/// The curve turns back at a branch point: what is lost is control, and the reason may be that a
/// chain is stretched.
std::string turn_at_branch_point(const CommandSetup& setup, const CommandedState& start,
                                 LegEvent& event) {
  const std::string chain = singular_chain(setup, start, event.state);
  if (!chain.empty()) event.kind = EventKind::kinematic_singularity;
  const std::string why = "no commands lead further along the path" +
                          (chain.empty() ? std::string(", other solutions cross here")
                                         : "; the closure of chain " + chain + " loses rank");
  event.detail = "control is lost: " + why;
  return why;
}

bool ends_control(const Hit& hit) {
  return hit.kind == HitKind::limit_point || hit.kind == HitKind::corner;
}

std::string detail_of(const Hit& hit) {
  switch (hit.kind) {
    case HitKind::limit_point:
      return "control is lost: no commands lead further along the path";
    case HitKind::corner:
      return "control is lost at a switching spring: " + hit.name;
    case HitKind::branch_point:
      return "other commands for the same targets cross here";
    default:
      return hit.name;
  }
}

std::string changed(Index before, Index after) {
  return std::string(after > before ? "stability is lost" : "stability improves") +
         ": unstable modes under dead load " + std::to_string(before) + " to " +
         std::to_string(after);
}

/// Place between two points of the leg at which the number of unstable modes changes, by bisection
/// with a solved state at every trial.
LegEvent locate_change(const CommandSetup& setup, const ControlProblem& problem, CurvePoint a,
                       const CurvePoint& b, Index before, Index after) {
  double low = a.lambda, high = b.lambda;
  CommandedState state = state_at(problem, a);
  statics::ControlSolver solver =
      control_solver(setup.system, setup.task, state.z, state.inputs.rho);
  Vector target(std::ssize(solver.held));
  for (int i = 0; i < 60 && high - low > 1e-14 * problem.length(); ++i) {
    const double middle = low + (high - low) / 2;
    const Vector z = problem.expand(a.x, middle);
    for (Index k = 0; k < target.size(); ++k)
      target[k] = z[solver.held[static_cast<std::size_t>(k)]];
    if (!solve_control(setup.system, solver, target, problem.inputs(a.x, middle).W)) break;
    CommandedState trial{.z = solver.z, .inputs = solver.inputs, .piece = solver.piece};
    const auto modes = unstable_modes_at(setup, trial);
    state = std::move(trial);
    if (!modes) {
      low = high = middle;
      break;
    }
    (*modes == before ? low : high) = middle;
  }
  return {.kind = EventKind::stability_change,
          .detail = changed(before, after),
          .place = problem.place(low + (high - low) / 2),
          .state = std::move(state)};
}

void add_hits(const ControlProblem& problem, const Curve& curve, Leg& leg) {
  for (const Hit& hit : curve.hits) {
    if (hit.kind == HitKind::user || hit.kind == HitKind::inexact) continue;
    LegEvent event{.kind = kind_of(hit),
                   .detail = detail_of(hit),
                   .place = problem.place(hit.point.lambda),
                   .state = state_at(problem, hit.point)};
    if (!hit.leaving.empty()) event.leaving = state_at(problem, hit.leaving.front());
    leg.events.push_back(std::move(event));
  }
}

/// Where a spring is led through the length 0 the leg ends: what was found behind it is forgotten.
bool ends_at_zero_length(const CommandSetup& setup, const ControlProblem& problem,
                         std::vector<CurvePoint>& points, Leg& leg) {
  const auto edges_at = [&](const CurvePoint& point) {
    const CommandedState state = state_at(problem, point);
    return spring_edges(setup.system, state.z, state.inputs);
  };
  for (std::size_t i = 1; i < points.size(); ++i) {
    const auto why = led_over_edge(setup.system, edges_at(points[i - 1]), edges_at(points[i]));
    if (!why) continue;
    points.resize(i);
    leg.lost = *why;
    leg.lost_place = problem.place(points.back().lambda);
    std::erase_if(leg.events, [&](const LegEvent& event) { return event.place > *leg.lost_place; });
    return true;
  }
  return false;
}

/// Where a spring switches the change is the spring's: one event tells both.
/// @returns whether one does
bool is_of_switching(const LegEvent& change, Leg& leg) {
  for (LegEvent& event : leg.events) {
    if (event.kind != EventKind::switching ||
        std::abs(event.place - change.place) > continuation::one_place)
      continue;
    event.detail += "; " + change.detail;
    return true;
  }
  return false;
}

void add_changes(const CommandSetup& setup, const ControlProblem& problem,
                 const std::vector<CurvePoint>& points, Leg& leg) {
  std::optional<Index> before;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto modes = unstable_modes_at(setup, state_at(problem, points[i]));
    if (!modes) continue;
    if (before && *before != *modes) {
      LegEvent change = locate_change(setup, problem, points[i - 1], points[i], *before, *modes);
      if (!is_of_switching(change, leg)) leg.events.push_back(std::move(change));
    }
    before = modes;
  }
}

}  // namespace

Leg follow_leg(const CommandSetup& setup, const TargetPath& path, int number,
               const CommandedState& from, const continuation::TraceOptions& options) {
  const ControlProblem problem(setup, path, number);
  const Vector y = problem.reduce(from.z, from.inputs.rho);
  const auto rays = rays_from(problem, y, 0, from.piece, options);
  const auto forward = std::max_element(
      rays.rays.begin(), rays.rays.end(),
      [](const auto& a, const auto& b) { return a.tangent.dlambda < b.tangent.dlambda; });
  Leg leg;
  if (forward == rays.rays.end() || !(forward->tangent.dlambda > 0)) {
    leg.lost = rays.why.empty() ? "no commands lead further along the path" : rays.why;
    return leg;
  }
  const std::vector<continuation::Event> events{
      {"next target", [&](const CurvePoint& p) { return p.lambda - problem.length(); },
       continuation::EventAction::stop}};
  const Curve curve = trace(
      problem, y, 0, *forward, events, options,
      [](const CurvePoint& point) { return point.tangent.dlambda > 0; },
      [](const Hit& hit) { return !ends_control(hit); });
  add_hits(problem, curve, leg);
  std::vector<CurvePoint> points = curve.points;
  const bool arrived = curve.stop == continuation::StopReason::event;
  if (!curve.hits.empty() && (arrived || ends_control(curve.hits.back())))
    points.push_back(curve.hits.back().point);
  std::stable_sort(points.begin(), points.end(),
                   [](const CurvePoint& a, const CurvePoint& b) { return a.s < b.s; });
  const bool ends_early = ends_at_zero_length(setup, problem, points, leg);
  add_changes(setup, problem, points, leg);
  std::stable_sort(leg.events.begin(), leg.events.end(),
                   [](const LegEvent& a, const LegEvent& b) { return a.place < b.place; });
  if (ends_early) return leg;
  if (arrived) {
    leg.end = state_at(problem, curve.hits.back().point);
    return leg;
  }
  if (!curve.hits.empty() && ends_control(curve.hits.back())) {
    leg.lost = "no commands lead further along the path";
  } else if (curve.stop == continuation::StopReason::observer && !leg.events.empty() &&
             leg.events.back().kind == EventKind::branch_point) {
    leg.lost = turn_at_branch_point(setup, from, leg.events.back());
  } else if (curve.stop == continuation::StopReason::observer && !leg.events.empty()) {
    leg.lost = "no commands lead further along the path";
  } else {
    leg.lost = stop_of(curve).reason;
    leg.lost_place = problem.place(curve.points.back().lambda);
  }
  return leg;
}

}  // namespace springfold::analysis
