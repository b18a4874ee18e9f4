#include <Eigen/Eigenvalues>

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

}  // namespace

void check_points(const Embedded& problem, const Draw& draw, const continuation::Curve& curve,
                  Verdict& verdict) {
  double before = 0, sense = 0;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const CurvePoint& p = curve.points[i];
    const Vector z = problem.base_point(p.x);
    if (draw.on_curve && !draw.on_curve(z, p.lambda)) verdict.jumped = true;
    const double parameter = draw.parameter(z, p.lambda);
    if (i == 1) sense = parameter > before ? 1 : -1;
    if (i > 1 && (parameter - before) * sense < -1e-9 * draw.size) verdict.jumped = true;
    before = parameter;
    bool clearly = false;
    const Index count = negative_count(draw, z, p, clearly);
    if (count < 0) continue;
    if (p.negative ? *p.negative != count + problem.negative_extra() : clearly)
      verdict.wrong_index = true;
  }
}

}  // namespace springfold::known_answers
