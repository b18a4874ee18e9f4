// Branches that are one point, or a curve to one side of it.
#include "branch_entries.hpp"
#include "branch_rows.hpp"

namespace springfold::analysis {

using continuation::Curve;
using continuation::CurvePoint;

Branch single_point(const CurvePoint& start, const Evaluator& evaluator,
                    const std::vector<QuantityDefinition>& quantities, const PathProblem& problem) {
  Branch branch;
  branch.samples.push_back({evaluator.values(quantities, start),
                            piece_text(problem.system(start.lambda), start.piece), ""});
  if (const auto rows = resting_rows(start, {}, 0, evaluator)) {
    branch.samples.front().rests = true;
    branch.resting.push_back(*rows);
  }
  return branch;
}

Curve nothing_behind(const Curve& curve) {
  Curve behind;
  behind.points = {curve.points.front()};
  behind.points.front().tangent.dx *= -1;
  behind.points.front().tangent.dlambda *= -1;
  behind.stop = curve.stop;
  behind.stop_detail = curve.stop_detail;
  return behind;
}

}  // namespace springfold::analysis
