// Stability if not the load were given but the displacement along it.
#include <cmath>
#include <limits>

#include "analysis/undefined.hpp"
#include "quantities.hpp"
#include "resting.hpp"

namespace springfold::analysis {

RoundedRate Evaluator::displacement_rate(const continuation::CurvePoint& point) const {
  const PathRule& rule = problem_.rule();
  const Vector dz = problem_.local_rate(point.x, point.tangent.dx, point.tangent.dlambda);
  const Vector poses = dz.tail(dz.size() - first_pose_);
  double rate = rule.W_rate.dot(poses), size = rule.W_rate.norm();
  if (!rule.load_rate.isZero(0)) {
    const Vector forces = statics::load_rate(problem_.turned(point.x, point.lambda),
                                             problem_.local(point.x, point.lambda),
                                             problem_.inputs(point.lambda).rho, rule.load_rate);
    rate -= forces.dot(dz);
    size += forces.norm();
  }
  return {rate, tangent_rounding * size};
}

/// With the matrix A of all motions and the load's rate b the count under the constraint that b does no
/// work is that of A, less one where b . A^-1 b < 0: where the displacement falls while the load grows.
double Evaluator::driven_index(const continuation::CurvePoint& point, double index,
                               const KnownSwitches& known) const {
  if (std::isnan(index) || index == 0) return index;  // what is stable free is so constrained
  if (point.tangent.dx.size() != point.x.size() || !resting_at(point, known).empty())
    return undefined;
  const RoundedRate rate = displacement_rate(point);
  if (rate.is_zero()) return index;
  return rate.value * point.tangent.dlambda < 0 ? index - 1 : index;
}

}  // namespace springfold::analysis
