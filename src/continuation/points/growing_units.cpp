#include "continuation/points/growing_units.hpp"

#include <cmath>

namespace springfold::continuation {

GrowingUnits::GrowingUnits(ProblemView problem)
    : problem_{problem}, measure_{problem.lambda_measure()} {
  if (!is_plain()) moves_ = (problem.metric().array() > 0).cast<double>();
}

bool GrowingUnits::is_plain() const { return !std::isfinite(measure_.linear); }

double GrowingUnits::lambda_at(double mu) const {
  const auto [centre, linear] = measure_;
  return centre + linear * std::sinh((mu - centre) / linear);
}

double GrowingUnits::r_at(double mu) const {
  return std::cosh((mu - measure_.centre) / measure_.linear);
}

double GrowingUnits::growth_of(double mu) const {
  return std::tanh((mu - measure_.centre) / measure_.linear) / measure_.linear;
}

void GrowingUnits::put(const Vector& y, double mu) const {
  const double r = r_at(mu);
  rows_ = (moves_.array() > 0).select(Vector::Constant(y.size(), 1 / r), 1);
  columns_ = (moves_.array() > 0).select(Vector::Ones(y.size()), r);
  x_ = columns_.cwiseProduct(y);
}

bool GrowingUnits::residual(const Vector& y, double mu, const Piece& piece, Vector& G) const {
  put(y, mu);
  if (!problem_.residual(x_, lambda_at(mu), piece, G)) return false;
  G.array() *= rows_.array();
  return true;
}

/// By mu: lambda grows, forces do, and the factors of the rows shrink.
/// @param image  dG/dy times the forces among y   @param dG_dmu  holds dF/dlambda; at the place of put(), with F_
void GrowingUnits::put_rate(double mu, const Vector& image, Vector& dG_dmu) const {
  dG_dmu = r_at(mu) * rows_.cwiseProduct(dG_dmu) +
           growth_of(mu) * (image - moves_.cwiseProduct(rows_).cwiseProduct(F_));
}

Vector GrowingUnits::forces_of(const Vector& y) const {
  return (moves_.array() > 0).select(Vector::Zero(y.size()), y);
}

bool GrowingUnits::derivatives(const Vector& y, double mu, const Piece& piece, Matrix& dG_dy,
                               Vector& dG_dmu) const {
  put(y, mu);
  if (!problem_.equations(x_, lambda_at(mu), piece, F_, dG_dy, dG_dmu)) return false;
  dG_dy.array().colwise() *= rows_.array();
  dG_dy.array().rowwise() *= columns_.transpose().array();
  put_rate(mu, dG_dy * forces_of(y), dG_dmu);
  return true;
}

bool GrowingUnits::structured_derivatives(const Vector& y, double mu, const Piece& piece,
                                          StructuredMatrix& dG_dy, Vector& dG_dmu) const {
  put(y, mu);
  const double lambda = lambda_at(mu);
  if (!problem_.residual(x_, lambda, piece, F_) ||
      !problem_.structured_derivatives(x_, lambda, piece, matrices_.next(), dG_dmu))
    return false;
  matrices_.put(rows_, columns_, dG_dy);
  put_rate(mu, product(dG_dy, forces_of(y)), dG_dmu);
  return true;
}

bool GrowingUnits::switches(const Vector& y, double mu, Vector& g) const {
  put(y, mu);
  return problem_.switches(x_, lambda_at(mu), g);
}

bool GrowingUnits::switch_gradients(const Vector& y, double mu, Matrix& dg_dy,
                                    Vector& dg_dmu) const {
  put(y, mu);
  if (!problem_.switch_gradients(x_, lambda_at(mu), dg_dy, dg_dmu)) return false;
  dg_dy.array().rowwise() *= columns_.transpose().array();
  dg_dmu = (r_at(mu) * dg_dmu + growth_of(mu) * (dg_dy * forces_of(y))).eval();
  return true;
}

CurvePoint GrowingUnits::inside(const Vector& x, double lambda) const {
  const auto [centre, linear] = measure_;
  CurvePoint at;
  at.lambda = centre + linear * std::asinh((lambda - centre) / linear);
  at.x = (moves_.array() > 0).select(x, x / r_at(at.lambda));
  return at;
}

CurvePoint GrowingUnits::inside(CurvePoint point) const {
  CurvePoint at = inside(point.x, point.lambda);
  if (point.tangent.dx.size() > 0) point.tangent = inside(std::move(point.tangent), at);
  point.x = std::move(at.x);
  point.lambda = at.lambda;
  return point;
}

CurvePoint GrowingUnits::outside(CurvePoint point) const {
  if (point.tangent.dx.size() > 0) point.tangent = outside(std::move(point.tangent), point);
  put(point.x, point.lambda);
  point.x = x_;
  point.lambda = lambda_at(point.lambda);
  return point;
}

// dlambda = r dmu,  dx_i = r (dy_i + r'/r y_i dmu) for unknowns of weight zero
Direction GrowingUnits::inside(Direction direction, const CurvePoint& at) const {
  const double r = r_at(at.lambda), growth = growth_of(at.lambda);
  direction.dlambda /= r;
  for (Index i = 0; i < at.x.size(); ++i)
    if (moves_[i] == 0)
      direction.dx[i] = direction.dx[i] / r - growth * at.x[i] * direction.dlambda;
  const Vector weights = problem_.metric();
  const double length =
      std::sqrt(direction.dx.cwiseAbs2().dot(weights) + direction.dlambda * direction.dlambda);
  direction.dx /= length;
  direction.dlambda /= length;
  return direction;
}

Direction GrowingUnits::outside(Direction direction, const CurvePoint& at) const {
  const double r = r_at(at.lambda), growth = growth_of(at.lambda);
  for (Index i = 0; i < at.x.size(); ++i)
    if (moves_[i] == 0)
      direction.dx[i] = r * (direction.dx[i] + growth * at.x[i] * direction.dlambda);
  direction.dlambda *= r;
  return direction;
}

}  // namespace springfold::continuation
