#include "continuation/points/coincide.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "continuation/points/locate.hpp"
#include "continuation/points/workspace.hpp"
#include "springfold/continuation/diagram.hpp"
#include "springfold/continuation/numerics.hpp"

namespace springfold::continuation {

Vector nearest_signs(const std::vector<Index>& double_covers, const Vector& x, const Vector& near) {
  Vector signs = Vector::Ones(x.size());
  for (const Index i : double_covers)
    if (x.segment<4>(i).dot(near.segment<4>(i)) < 0) signs.segment<4>(i).setConstant(-1);
  return signs;
}

namespace {

/// d times nearest_signs().
void take_signs(const std::vector<Index>& double_covers, const Vector& x, const Vector& near,
                Vector& d) {
  for (const Index i : double_covers)
    if (x.segment<4>(i).dot(near.segment<4>(i)) < 0) d.segment<4>(i) *= -1;
}

/// The memory with what the problem says of itself.
Workspace& informed(const Walker& walker) {
  Workspace& memory = *walker.memory;
  if (!memory.asked) {
    memory.periods = walker.problem.periods();
    memory.double_covers = walker.problem.double_covers();
    memory.asked = true;
  }
  return memory;
}

void set_between(const Walker& walker, const CurvePoint& a, const CurvePoint& b, Direction& d) {
  const Workspace& memory = informed(walker);
  d.dx = b.x;
  d.dlambda = b.lambda - a.lambda;
  take_signs(memory.double_covers, b.x, a.x, d.dx);
  d.dx -= a.x;
  for (Index i = 0; i < d.dx.size(); ++i)
    if (memory.periods[i] > 0) d.dx[i] = std::remainder(d.dx[i], memory.periods[i]);
}

}  // namespace

Direction direction_seen_from(const Walker& walker, const Vector& near, const CurvePoint& point) {
  Direction direction = point.tangent;
  take_signs(informed(walker).double_covers, point.x, near, direction.dx);
  return direction;
}

Direction between(const Walker& walker, const CurvePoint& a, const CurvePoint& b) {
  Direction d;
  set_between(walker, a, b, d);
  return d;
}

double length_of(const Walker& walker, const Direction& d) {
  return std::sqrt(metric_product(walker.weights, d, d));
}

double scale_of(const CurvePoint& point) {
  return std::max({1.0, point.x.norm(), std::abs(point.lambda)});
}

Direction unit_direction(const Walker& walker, const Vector& u) {
  return unit_direction(walker, Direction{u.head(u.size() - 1), u[u.size() - 1]});
}

Direction unit_direction(const Walker& walker, Direction d) {
  const double length = length_of(walker, d);
  d.dx /= length;
  d.dlambda /= length;
  return d;
}

double cosine(const Walker& walker, const Direction& a, const Direction& b) {
  const double lengths = length_of(walker, a) * length_of(walker, b);
  return lengths > 0 ? metric_product(walker.weights, a, b) / lengths : 0;
}

bool coincide(const Walker& walker, const CurvePoint& a, const CurvePoint& b) {
  return a.piece == b.piece &&
         length_of(walker, between(walker, a, b)) <= same_point * scale_of(a) &&
         std::abs(cosine(walker, a.tangent, direction_seen_from(walker, a.x, b))) >=
             1 - nearly_same_line;
}

std::optional<CurvePoint> passes(const Walker& walker, const CurvePoint& target,
                                 const CurvePoint& from, const CurvePoint& to) {
  if (target.piece != from.piece) return std::nullopt;
  Direction& offset = walker.memory->direction;
  // The points' s may be of another metric: that of this walker counts.
  set_between(walker, from, to, offset);
  const double h = std::max(to.s - from.s, metric_product(walker.weights, offset, from.tangent));
  set_between(walker, from, target, offset);
  const double along = metric_product(walker.weights, offset, from.tangent);
  // The curve bends away from its tangent by no more than a right angle's half.
  if (!(along > 0 && along <= h) || length_of(walker, offset) > std::numbers::sqrt2 * h)
    return std::nullopt;
  // Another branch may be nearer than the curve's bend over the step: the cubic through both ends leads to its own.
  ArcModel chord;
  if (to.piece == from.piece &&
      chord.go_through(walker.weights, from, StepSamples(from, nullptr, to))) {
    auto point = point_near(walker, chord, from, along);
    if (point && coincide(walker, *point, target)) return point;
  }
  auto point = point_at(walker, from, along);
  return point && coincide(walker, *point, target) ? point : std::nullopt;
}

std::optional<CurvePoint> start_again(const Walker& walker, const CurvePoint& start,
                                      const CurvePoint& from, const CurvePoint& to) {
  if (!(from.s > 0)) return std::nullopt;
  auto point = passes(walker, start, from, to);
  if (!point || cosine(walker, point->tangent, direction_seen_from(walker, point->x, start)) < 0)
    return std::nullopt;
  return point;
}

bool passes_through(ProblemView problem, const Curve& curve, const CurvePoint& point,
                    const TraceOptions& options) {
  const Walker walker{problem, problem.metric(), options};
  if (!curve.points.empty() && coincide(walker, curve.points.front(), point)) return true;
  for (std::size_t i = 0; i + 1 < curve.points.size(); ++i)
    if (passes(walker, point, curve.points[i], curve.points[i + 1])) return true;
  return false;
}

bool are_in_different_pieces(const Walker& walker, const CurvePoint& a, const CurvePoint& b) {
  if (a.piece == b.piece || a.piece.size() != b.piece.size()) return false;
  Vector ga, gb;
  if (!walker.problem.switches(a.x, a.lambda, ga) || !walker.problem.switches(b.x, b.lambda, gb))
    return false;
  for (std::size_t j = 0; j < a.piece.size(); ++j) {
    const auto k = static_cast<Index>(j);
    if (a.piece[j] != b.piece[j] &&
        std::max(std::abs(ga[k]), std::abs(gb[k])) > walker.options.simultaneous)
      return true;
  }
  return false;
}

/// Located points may be so many times farther from a surface than switches that act together.
constexpr double on_surface = 10;

bool lies_on(const Walker& walker, const CurvePoint& point, const std::vector<Index>& switches) {
  Vector g;
  if (switches.empty() || !walker.problem.switches(point.x, point.lambda, g)) return true;
  return std::all_of(switches.begin(), switches.end(), [&](Index j) {
    return std::abs(g[j]) <= on_surface * walker.options.simultaneous;
  });
}

std::optional<CurvePoint> start_again(ProblemView problem, const TraceOptions& options,
                                      const CurvePoint& start, const CurvePoint& from,
                                      const CurvePoint& to) {
  return start_again(Walker{problem, problem.metric(), options}, start, from, to);
}

}  // namespace springfold::continuation
