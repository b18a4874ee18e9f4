#include "search_box.hpp"

#include <algorithm>
#include <numbers>

#include "springfold/continuation/newton.hpp"

namespace springfold::analysis {

using continuation::CurvePoint;

SearchBox search_box(const PathProblem& problem, const continuation::Diagram& diagram,
                     const Vector& start) {
  SearchBox box{start, start};
  for (const continuation::Branch& branch : diagram.branches)
    for (const CurvePoint& point : branch.curve.points) {
      box.low = box.low.cwiseMin(point.x);
      box.high = box.high.cwiseMax(point.x);
    }
  const std::vector<bool> angles = problem.angles();
  for (Index i = 0; i < problem.size(); ++i) {
    const double least = angles[static_cast<std::size_t>(i)] ? 2 * std::numbers::pi : 1;
    const double middle = (box.low[i] + box.high[i]) / 2;
    const double width = std::max(2 * (box.high[i] - box.low[i]), least);
    box.low[i] = middle - width / 2;
    box.high[i] = middle + width / 2;
  }
  return box;
}

std::vector<Vector> known_at(const PathProblem& problem, const continuation::Diagram& diagram,
                             double lambda, const continuation::NewtonOptions& options) {
  std::vector<Vector> known;
  const continuation::Direction only_lambda{Vector::Zero(problem.size()), 1};
  const auto add = [&](const CurvePoint& a, const CurvePoint& b) {
    if ((a.lambda - lambda) * (b.lambda - lambda) > 0 || a.lambda == b.lambda) return;
    const double t = (lambda - a.lambda) / (b.lambda - a.lambda);
    const auto solution = continuation::correct(problem, problem.metric(), a.x + t * (b.x - a.x),
                                                lambda, a.piece, only_lambda, options);
    if (!continuation::converged(solution)) return;
    const bool is_new = std::none_of(known.begin(), known.end(), [&](const Vector& x) {
      return (x - solution.x).lpNorm<Eigen::Infinity>() < 1e-8;
    });
    if (is_new) known.push_back(solution.x);
  };
  for (const continuation::Branch& branch : diagram.branches) {
    const auto& points = branch.curve.points;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) add(points[i], points[i + 1]);
  }
  return known;
}

}  // namespace springfold::analysis
