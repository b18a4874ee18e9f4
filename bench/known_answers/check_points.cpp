#include <Eigen/Eigenvalues>
#include <algorithm>

#include "judge.hpp"

namespace springfold::known_answers {

using continuation::CurvePoint;

namespace {

/// Closed form of the index; -1 where an eigenvalue is zero to rounding.
Index negative_count(const Draw& draw, const Vector& z, const CurvePoint& p, bool& clearly) {
  Vector F, F_lambda;
  Matrix H;
  draw.base.at(z, p.lambda, p.piece, F, H, F_lambda);
  const Vector values = H.selfadjointView<Eigen::Lower>().eigenvalues();
  const double scale = std::max(1.0, values.cwiseAbs().maxCoeff());
  const double least = values.cwiseAbs().minCoeff() / scale;
  clearly = least > 1e-6;
  if (least < 1e-10) return -1;
  return (values.array() < 0).count();
}

/// Does the curve say that it may have changed its branch before this place?
bool is_unresolved_before(const continuation::Curve& curve, double s) {
  return std::any_of(curve.hits.begin(), curve.hits.end(), [s](const continuation::Hit& hit) {
    return hit.kind == continuation::HitKind::unresolved && hit.s_before <= s;
  });
}

/// Does the curve say of the stretch around this place that lambda stands still or that it is unresolved? Nothing is
/// told of the index there.
bool is_said_to_be_flat(const continuation::Curve& curve, double s) {
  return std::any_of(curve.hits.begin(), curve.hits.end(), [s](const continuation::Hit& hit) {
    const bool stretch =
        hit.kind == continuation::HitKind::family || hit.kind == continuation::HitKind::unresolved;
    return stretch && hit.s_before <= s && s <= hit.s_after;
  });
}

}  // namespace

void check_points(const Embedded& problem, const Draw& draw, const continuation::Curve& curve,
                  Verdict& verdict) {
  double before = 0, sense = 0;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const CurvePoint& p = curve.points[i];
    const Vector z = problem.base_point(p.x);
    const bool silent = !is_unresolved_before(curve, p.s);
    if (silent && draw.on_curve && !draw.on_curve(z, p.lambda)) verdict.jumped = true;
    const double parameter = draw.parameter(z, p.lambda);
    if (i == 1) sense = parameter > before ? 1 : -1;
    if (silent && i > 1 && (parameter - before) * sense < -1e-9 * draw.size) verdict.jumped = true;
    before = parameter;
    bool clearly = false;
    const Index count = negative_count(draw, z, p, clearly);
    if (count < 0) continue;
    if (p.negative ? *p.negative != count + problem.negative_extra()
                   : clearly && !is_said_to_be_flat(curve, p.s))
      verdict.wrong_index = true;
  }
}

}  // namespace springfold::known_answers
