#include "search_box.hpp"

#include <algorithm>
#include <numbers>

#include "path_work.hpp"

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
                             double lambda) {
  std::vector<Vector> known;
  const auto add = [&](const CurvePoint& a, const CurvePoint& b) {
    if ((a.lambda - lambda) * (b.lambda - lambda) > 0 || a.lambda == b.lambda) return;
    const auto state = state_at_level(problem, {a.x, a.lambda}, {b.x, b.lambda}, lambda);
    if (!state) return;
    const bool is_new = std::none_of(known.begin(), known.end(), [&](const Vector& x) {
      return (x - state->x).lpNorm<Eigen::Infinity>() < 1e-8;
    });
    if (is_new) known.push_back(state->x);
  };
  for (const continuation::Branch& branch : diagram.branches) {
    const auto& points = branch.curve.points;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) add(points[i], points[i + 1]);
  }
  return known;
}

}  // namespace springfold::analysis
