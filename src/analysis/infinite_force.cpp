#include "infinite_force.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "closure_rank.hpp"
#include "lambda_crawl.hpp"
#include "springfold/continuation/newton.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/continuation/verification.hpp"
#include "start.hpp"

namespace springfold::analysis {
namespace {

using continuation::CurvePoint;

Vector wrenches_of(const PathProblem& problem, Vector x) {
  const statics::System& layout = problem.layout();
  for (Index i = 0; i < x.size(); ++i)
    if (i >= layout.first_pose || !layout.is_wrench[static_cast<std::size_t>(i)]) x[i] = 0;
  return x;
}

/// From `last` to where 1/w, linear in s, vanishes; nothing where the wrenches do not grow in one sense.
std::optional<double> way_left(const PathProblem& problem, const CurvePoint& earlier,
                               const CurvePoint& last) {
  const Vector w = wrenches_of(problem, last.x), v = wrenches_of(problem, earlier.x);
  const double force = w.norm(), before = v.dot(w) / force;
  if (!(before > 0) || !(force > before)) return std::nullopt;
  return (last.s - earlier.s) * before / (force - before);
}

/// Is no spring switched on the other side of its threshold?
bool keeps_its_piece(const PathProblem& problem, const CurvePoint& point) {
  Vector g;
  if (point.piece.empty()) return true;
  if (!problem.switches(point.x, point.lambda, g)) return false;
  for (Index j = 0; j < g.size(); ++j)
    if (g[j] * point.piece[static_cast<std::size_t>(j)] < -continuation::promised_place)
      return false;
  return true;
}

/// Of what closures leave, which are as small as positions however large the wrenches are.
double left_of_closures(const PathProblem& problem, const Vector& x, double lambda,
                        const Piece& piece) {
  Vector F;
  if (!problem.residual(x, lambda, piece, F)) return std::numeric_limits<double>::infinity();
  return wrenches_of(problem, F).lpNorm<Eigen::Infinity>();
}

/// Further iterations, as long as closures gain by them: the tolerance is to the largest wrench.
void close_chains(const PathProblem& problem, const continuation::Direction& along,
                  CurvePoint& point) {
  constexpr int most = 4;
  constexpr continuation::NewtonOptions one_step{.residual_tolerance = 0, .maximum_iterations = 1};
  double left = left_of_closures(problem, point.x, point.lambda, point.piece);
  for (int i = 0; i < most && left > 0; ++i) {
    const auto finer = continuation::correct(problem, problem.metric(), point.x, point.lambda,
                                             point.piece, along, one_step);
    const double now =
        finer.x.allFinite() ? left_of_closures(problem, finer.x, finer.lambda, point.piece) : left;
    if (!(now < left)) return;
    left = now;
    point.x = finer.x;
    point.lambda = finer.lambda;
  }
}

/// The solved point after this share of the way that is left: moved on along the chord, its wrenches as much larger.
/// @param switches  set where a spring has switched on the way there
std::optional<CurvePoint> after_share(const PathProblem& problem, const CurvePoint& earlier,
                                      const CurvePoint& last, double left, double share,
                                      bool& switches) {
  const double way = last.s - earlier.s, on = share * left / way;
  const Vector w = wrenches_of(problem, last.x), v = wrenches_of(problem, earlier.x);
  const continuation::Direction along{(last.x - earlier.x - (w - v)) / way,
                                      (last.lambda - earlier.lambda) / way};
  const Vector x = last.x + on * way * along.dx + w * (share / (1 - share));
  // The curve's own tolerance is relative to the largest unknown: here that would be to forces without bound.
  constexpr double units_of_rounding = 2;
  continuation::NewtonOptions newton;
  newton.residual_tolerance =
      std::max(newton.residual_tolerance / std::max(1.0, x.lpNorm<Eigen::Infinity>()),
               units_of_rounding * std::numeric_limits<double>::epsilon());
  const auto solved =
      continuation::correct(problem, problem.metric(), x, last.lambda + on * way * along.dlambda,
                            last.piece, along, newton);
  if (!converged(solved)) return std::nullopt;
  CurvePoint point = last;
  point.x = solved.x;
  point.lambda = solved.lambda;
  point.s = last.s + share * left;
  close_chains(problem, along, point);
  const Vector reached = wrenches_of(problem, point.x);
  const bool has_grown = reached.dot(w) > w.squaredNorm();
  if (!has_grown) return std::nullopt;
  switches = !keeps_its_piece(problem, point);
  return switches ? std::nullopt : std::optional(point);
}

std::optional<CurvePoint> nearer(const PathProblem& problem, const CurvePoint& earlier,
                                 const CurvePoint& last, double left, bool& switches) {
  for (const double share : {0.75, 0.5, 0.25}) {
    auto point = after_share(problem, earlier, last, left, share, switches);
    if (point || switches) return point;
  }
  return std::nullopt;
}

struct Approach {
  std::vector<CurvePoint> points{};  ///< the two that it begins with, and each one nearer
  bool has_grown = false;            ///< wrenches, a hundredfold
  bool switches = false;             ///< a spring does, before the zero
  bool is_pole =
      false;  ///< up to the last point wrenches grow as the inverse of the way that is left

  const CurvePoint& before() const { return points[points.size() - 2]; }
  CurvePoint& at() { return points.back(); }
};

/// Solved points, each nearer to the zero of 1/w.
Approach approach(const PathProblem& problem, const CurvePoint& earlier, const CurvePoint& last) {
  constexpr int most_points = 100;  // of which each leaves at most three quarters of the way
  // Closures of chains that lie flat together have errors of rounding over their singular value, and with such wrenches
  // the equilibrium one over its square: nearer points than this may not be found, but that there is a pole is certain.
  constexpr double certain_growth = 1e2;
  // Of w times the way that is left from one point to the next: beside a pole it stays, at a finite peak it is lost.
  constexpr double same_inverse = 1.25;
  Approach to{{earlier, last}};
  const double grown = certain_growth * wrenches_of(problem, last.x).norm();
  double inverse = 0;
  for (int i = 0; i < most_points; ++i) {
    const auto left = way_left(problem, to.before(), to.at());
    const double earlier_inverse = inverse;
    inverse = left ? *left * wrenches_of(problem, to.at().x).norm() : 0;
    to.is_pole =
        inverse < same_inverse * earlier_inverse && earlier_inverse < same_inverse * inverse;
    if (!left || *left <= continuation::promised_place) break;
    auto next = nearer(problem, to.before(), to.at(), *left, to.switches);
    if (!next) break;
    to.has_grown = to.has_grown || wrenches_of(problem, next->x).norm() >= grown;
    to.points.push_back(*std::move(next));
  }
  return to;
}

void complete_point(const PathProblem& problem, const CurvePoint& earlier, CurvePoint& point) {
  point.negative.reset();
  count_negative(problem, point);
  continuation::Linearisation at;
  if (!continuation::linearise(problem, point.x, point.lambda, point.piece, at)) return;
  const continuation::Direction along{point.x - earlier.x, point.lambda - earlier.lambda};
  if (auto tangent = continuation::tangent_at(at, problem.metric(), along))
    point.tangent = *std::move(tangent);
}

/// Does the way to the pole look as if nothing happened on it? Numbers of negative eigenvalues and the sense of lambda
/// are those of its first point all along. Where rounding decides on them the curve is traced on.
bool goes_straight_on(const PathProblem& problem, std::vector<CurvePoint>& points) {
  const CurvePoint& first = points[1];
  for (std::size_t i = 1; i < points.size(); ++i) {
    complete_point(problem, points[i - 1], points[i]);
    if (points[i].negative != first.negative ||
        points[i].tangent.dlambda * first.tangent.dlambda <= 0)
      return false;
  }
  return true;
}

}  // namespace

std::optional<CurvePoint> beside_infinite_force(const PathProblem& problem,
                                                const CurvePoint& earlier, const CurvePoint& last) {
  if (earlier.piece != last.piece || !(last.s > earlier.s)) return std::nullopt;
  Approach to = approach(problem, earlier, last);
  if (!to.has_grown || to.switches) return std::nullopt;
  complete_point(problem, to.before(), to.at());
  return std::move(to.at());
}

bool is_solved_on_side_of(const PathProblem& problem, const CurvePoint& point,
                          const CurvePoint& before) {
  const double size = std::max({1.0, point.x.lpNorm<Eigen::Infinity>(), std::abs(point.lambda)});
  Vector F;
  return problem.residual(point.x, point.lambda, point.piece, F) &&
         F.lpNorm<Eigen::Infinity>() <=
             continuation::residual_bound(problem, point.piece, {}, size) &&
         wrenches_of(problem, point.x).dot(wrenches_of(problem, before.x)) >= 0;
}

InfiniteForceWatch::InfiniteForceWatch(const PathProblem& problem,
                                       const std::vector<continuation::Event>& events)
    : problem_{problem}, events_{events}, weights_{problem.metric()} {
  const statics::System& layout = problem.layout();
  for (Index i = 0; i < layout.first_pose; ++i)
    if (layout.is_wrench[static_cast<std::size_t>(i)]) wrenches_.push_back(i);
}

void InfiniteForceWatch::begin(const CurvePoint& point, double force) {
  last_ = point;
  far_ = {point};
  count_ = 1;
  asked_at_ = looked_at_from * force;
}

/// Of the same curve, or of another one? Points of one are no farther from each other than the arc length says.
bool InfiniteForceWatch::goes_on_at(const CurvePoint& point) const {
  constexpr double chord_over_arc = 1.01;
  const Vector dx = point.x - last_.x;
  const double way = point.s - last_.s, dlambda = point.lambda - last_.lambda;
  return way > 0 &&
         std::sqrt(dx.cwiseAbs2().dot(weights_) + dlambda * dlambda) <= chord_over_arc * way;
}

bool InfiniteForceWatch::sees(const CurvePoint& point) {
  double square = 0;
  for (const Index i : wrenches_) square += point.x[i] * point.x[i];
  const double force = std::sqrt(square);
  if (count_ == 0 || !goes_on_at(point)) {
    begin(point, force);
    return false;
  }
  const CurvePoint before = std::exchange(last_, point);
  ++count_;
  if (std::has_single_bit(count_)) far_.push_back(point);
  if (!(force > asked_at_)) return false;
  return ends_behind(before, point, force);
}

/// Does an event of the caller lie between two points, a limit among them?
bool InfiniteForceWatch::meets_event(const CurvePoint& from, const CurvePoint& to) const {
  return std::any_of(events_.begin(), events_.end(), [&](const continuation::Event& event) {
    return (event.value(from) < 0) != (event.value(to) < 0);
  });
}

bool InfiniteForceWatch::ends_behind(const CurvePoint& before, const CurvePoint& point,
                                     double force) {
  constexpr double steps_ahead = 2;  // a pole farther on has nothing to do with these two points
  if (before.piece != point.piece) return false;
  const auto left = way_left(problem_, before, point);
  if (!left || *left > steps_ahead * (point.s - before.s)) return false;
  constexpr double next_time = 4;
  Approach to = approach(problem_, before, point);
  EndOfCurve end{to.at(), point, {}};
  for (const CurvePoint& p : far_) end.far.push_back(&p);
  const bool is_pole = to.has_grown && to.is_pole && !to.switches;
  const auto legs = is_pole ? stretched_chains(problem_, end) : std::nullopt;
  if (!legs || !legs->is_end_of_reach) {
    asked_at_ = next_time * force;
    return false;
  }
  if (!goes_straight_on(problem_, to.points) || meets_event(point, to.at())) return false;
  ends_.push_back({point, std::move(to.at()), end_of_reach(*legs), legs->moves_on});
  return true;
}

void InfiniteForceWatch::end(continuation::Curve& curve,
                             const continuation::TraceOptions& options) const {
  for (const End& end : ends_)
    if (was_ended_at(curve, end.seen)) {
      if (options.verify_arcs && !curve.arcs.empty())
        curve.arcs = verified_arcs(problem_, curve, options);
      curve.points.push_back(end.at);
      // Where joints move on there is a curve behind, which is not followed.
      curve.stop =
          end.moves_on ? continuation::StopReason::observer : continuation::StopReason::pole;
      curve.stop_detail = end.text;
      return;
    }
}

}  // namespace springfold::analysis
