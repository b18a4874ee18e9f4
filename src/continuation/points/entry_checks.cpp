#include "springfold/continuation/entry_checks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace springfold::continuation {
namespace {

[[noreturn]] void refuse(const std::string& what) { throw std::invalid_argument(what); }

void expect(Index found, Index needed, const std::string& what) {
  if (found != needed)
    refuse(what + " has size " + std::to_string(found) + ", needed: " + std::to_string(needed));
}

void check_size(ProblemView problem) {
  if (problem.size() < 0 || problem.switch_count() < 0) refuse("a problem has a negative size");
}

void check_piece(ProblemView problem, const Piece& piece) {
  expect(static_cast<Index>(piece.size()), problem.switch_count(), "the piece");
  if (std::any_of(piece.begin(), piece.end(), [](auto side) { return side != 1 && side != -1; }))
    refuse("the piece has sides that are neither +1 nor -1");
}

void check_constants(ProblemView problem) {
  const Index n = problem.size();
  const Vector metric = problem.metric(), periods = problem.periods();
  expect(metric.size(), n, "metric()");
  expect(periods.size(), n, "periods()");
  if (n > 0 && !(metric.allFinite() && metric.minCoeff() >= 0))
    refuse("metric() has weights that are negative or not finite");
  if (n > 0 && !(periods.allFinite() && periods.minCoeff() >= 0))
    refuse("periods() has entries that are negative or not finite");
  for (const Index i : problem.double_covers())
    if (i < 0 || i + 4 > n) refuse("double_covers() names unknowns that do not exist");
}

void check_evaluation(ProblemView problem, const Vector& x, double lambda, const Piece& piece) {
  const Index n = problem.size(), m = problem.switch_count();
  Vector F, dF_dlambda, g, dg_dlambda;
  Matrix J, dg_dx;
  if (problem.residual(x, lambda, piece, F)) expect(F.size(), n, "the residual");
  if (!problem.structured() && problem.derivatives(x, lambda, piece, J, dF_dlambda)) {
    expect(J.rows(), n, "dF_dx (rows)");
    expect(J.cols(), n, "dF_dx (columns)");
    expect(dF_dlambda.size(), n, "dF_dlambda");
  }
  if (m == 0) return;
  if (problem.switches(x, lambda, g)) expect(g.size(), m, "switches()");
  if (problem.switch_gradients(x, lambda, dg_dx, dg_dlambda)) {
    expect(dg_dx.rows(), m, "dg_dx (rows)");
    expect(dg_dx.cols(), n, "dg_dx (columns)");
    expect(dg_dlambda.size(), m, "dg_dlambda");
  }
}

}  // namespace

std::vector<std::string> problems_in(const TraceOptions& options) {
  std::vector<std::string> problems;
  const StepOptions& step = options.step;
  if (!(0 < step.minimum && step.minimum <= step.initial && step.initial <= step.maximum &&
        std::isfinite(step.maximum)))
    problems.push_back("step: need 0 < minimum <= initial <= maximum, all finite");
  if (!(step.contraction > 0 && step.turn > 0 && step.deviation > 0 && step.aim > 0))
    problems.push_back("step: contraction, turn, deviation and aim must be positive");
  if (!(step.turn < std::numbers::pi)) problems.push_back("step.turn: must be below pi [rad]");
  if (!(step.aim < 1)) problems.push_back("step.aim: must be below 1, a fraction of the limits");
  if (!(step.growth > 1)) problems.push_back("step.growth: must be greater than 1");
  if (!(options.newton.residual_tolerance > 0))
    problems.push_back("newton.residual_tolerance: must be positive");
  if (!(options.location_tolerance > 0 && options.location_tolerance < 1))
    problems.push_back("location_tolerance: must be between 0 and 1");
  if (!(options.simultaneous >= 0 && std::isfinite(options.simultaneous)))
    problems.push_back("simultaneous: must not be negative");
  if (options.newton.maximum_iterations < 1)
    problems.push_back("newton.maximum_iterations: must be at least 1");
  if (options.maximum_points < 2)
    problems.push_back("maximum_points: a curve needs at least 2 points");
  return problems;
}

std::vector<std::string> problems_in(const DiagramOptions& options) {
  std::vector<std::string> problems = problems_in(options.trace);
  if (options.maximum_branches < 0 || options.maximum_depth < 0)
    problems.push_back("maximum_branches and maximum_depth: must not be negative");
  if (!(options.same_place > 0 && std::isfinite(options.same_place)))
    problems.push_back("same_place: must be positive");
  return problems;
}

void check_diagram(const DiagramOptions& options) {
  for (const std::string& wrong : problems_in(options)) refuse(wrong);
}

void check_entry(ProblemView problem, const Vector& x, double lambda, const Piece& piece,
                 const TraceOptions& options) {
  for (const std::string& wrong : problems_in(options)) refuse(wrong);
  check_point(problem, x, lambda, piece);
}

void check_search(ProblemView problem, double lambda, const std::vector<Vector>& known,
                  const SearchOptions& options) {
  check_size(problem);
  for (const std::string& wrong : problems_in(options, problem.size())) refuse(wrong);
  if (!std::isfinite(lambda)) refuse("lambda is not finite");
  for (const Vector& solution : known)
    expect(solution.size(), problem.size(), "a solution that is known");
  check_constants(problem);
}

void check_curve(ProblemView problem, const Curve& curve) {
  check_size(problem);
  check_constants(problem);
  for (const CurvePoint& point : curve.points) {
    expect(point.x.size(), problem.size(), "a point of the curve");
    if (point.tangent.dx.size() > 0)
      expect(point.tangent.dx.size(), problem.size(), "a tangent of the curve");
    check_piece(problem, point.piece);
  }
}

void check_point(ProblemView problem, const Vector& x, double lambda, const Piece& piece) {
  check_size(problem);
  expect(x.size(), problem.size(), "the point x");
  if (!x.allFinite() || !std::isfinite(lambda)) refuse("the point (x, lambda) is not finite");
  check_piece(problem, piece);
  check_constants(problem);
  check_evaluation(problem, x, lambda, piece);
}

void check_events(const std::vector<Event>& events) {
  for (const Event& event : events)
    if (!event.value) refuse("the event \"" + event.name + "\" has no function `value`");
}

void check_ray(ProblemView problem, const Ray& ray) {
  expect(ray.tangent.dx.size(), problem.size(), "the tangent of the ray");
  if (!ray.tangent.dx.allFinite() || !std::isfinite(ray.tangent.dlambda) ||
      (ray.tangent.dx.isZero(0) && ray.tangent.dlambda == 0))
    refuse("the tangent of the ray is zero or not finite");
  if (ray.start) expect(ray.start->x.size(), problem.size(), "the start of the ray");
  if (ray.beyond) expect(ray.beyond->x.size(), problem.size(), "the point beyond of the ray");
}

}  // namespace springfold::continuation
