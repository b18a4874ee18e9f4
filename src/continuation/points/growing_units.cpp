#include "continuation/points/growing_units.hpp"

#include <cmath>
#include <vector>

namespace springfold::continuation {

GrowingUnits::GrowingUnits(ProblemView problem, const Vector& x, double lambda, const Piece& piece)
    : problem_{problem}, measure_{problem.lambda_measure()} {
  if (is_plain()) return;
  moves_ = (problem.metric().array() > 0).cast<double>();
  stiff_ = Vector::Zero(moves_.size());
  count_by_energy(x, lambda, piece);
}

/// Largest stiffness in the row of each motion that every piece has which one switch alone, or all of them, lead to.
/// @returns nothing where derivatives are not defined
std::optional<Vector> GrowingUnits::lasting_stiffness(const Vector& x, double lambda,
                                                      const Piece& piece) const {
  std::vector<Piece> pieces{piece, Piece(piece.size(), -1), Piece(piece.size(), 1)};
  for (std::size_t j = 0; j < piece.size(); ++j) {
    pieces.push_back(piece);
    pieces.back()[j] = static_cast<Piece::value_type>(-piece[j]);
  }
  std::optional<Vector> least;
  for (const Piece& one : pieces) {
    Linearisation at;
    if (!linearise_densely(problem_, x, lambda, one, at)) return std::nullopt;
    const Matrix A = moves_.asDiagonal() * at.dF_dx * moves_.asDiagonal();
    const Vector sizes = A.cwiseAbs().rowwise().maxCoeff();
    least = least ? Vector(least->cwiseMin(sizes)) : sizes;
    if (!(least->array() > stiff_beside_others).any()) break;
  }
  return least;
}

/// Structured problems keep their motions as they are. So does what is stiff in one piece alone: in the others it would
/// move for orders of magnitude longer than others do.
void GrowingUnits::count_by_energy(const Vector& x, double lambda, const Piece& piece) {
  if (problem_.structured() || x.size() == 0) return;
  if (const auto stiffness = lasting_stiffness(x, lambda, piece)) {
    const Vector sizes = *stiffness / stiff_beside_others;
    stiff_ = (sizes.array() > 1).select(sizes, 0);
  }
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

Vector GrowingUnits::motions_at(double mu) const { return (1 + stiff_.array() / r_at(mu)).rsqrt(); }

void GrowingUnits::put(const Vector& y, double mu) const {
  const double r = r_at(mu);
  columns_ = motions_at(mu);
  rows_ = (moves_.array() > 0).select(columns_ / r, 1);
  columns_ = (moves_.array() > 0).select(columns_, r);
  x_ = columns_.cwiseProduct(y);
}

/// Of c: half of the share of stiff / r in 1 + stiff / r. Of r itself: 1.
Vector GrowingUnits::column_rates(double mu) const {
  const Eigen::ArrayXd stiff = stiff_.array() / r_at(mu);
  return (moves_.array() > 0).select(0.5 * stiff / (1 + stiff), 1);
}

/// Of c / r; rows of forces stay.
Vector GrowingUnits::row_rates(double mu) const {
  return (moves_.array() > 0).select(column_rates(mu).array() - 1, 0);
}

bool GrowingUnits::residual(const Vector& y, double mu, const Piece& piece, Vector& G) const {
  put(y, mu);
  if (!problem_.residual(x_, lambda_at(mu), piece, G)) return false;
  G.array() *= rows_.array();
  return true;
}

/// By mu: lambda grows, forces and motions do, and the factors of the rows shrink.
/// @param image  dG/dy times the rates of x at y, in parts of that of r @param dG_dmu holds dF/dlambda; at the place of
///               put(), with F_
void GrowingUnits::put_rate(double mu, const Vector& image, Vector& dG_dmu) const {
  dG_dmu = r_at(mu) * rows_.cwiseProduct(dG_dmu) +
           growth_of(mu) * (image + row_rates(mu).cwiseProduct(rows_).cwiseProduct(F_));
}

bool GrowingUnits::derivatives(const Vector& y, double mu, const Piece& piece, Matrix& dG_dy,
                               Vector& dG_dmu) const {
  put(y, mu);
  if (!problem_.equations(x_, lambda_at(mu), piece, F_, dG_dy, dG_dmu)) return false;
  dG_dy.array().colwise() *= rows_.array();
  dG_dy.array().rowwise() *= columns_.transpose().array();
  put_rate(mu, dG_dy * column_rates(mu).cwiseProduct(y), dG_dmu);
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
  put_rate(mu, product(dG_dy, column_rates(mu).cwiseProduct(y)), dG_dmu);
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
  dg_dmu = (r_at(mu) * dg_dmu + growth_of(mu) * (dg_dy * column_rates(mu).cwiseProduct(y))).eval();
  return true;
}

CurvePoint GrowingUnits::inside(const Vector& x, double lambda) const {
  const auto [centre, linear] = measure_;
  CurvePoint at;
  at.lambda = centre + linear * std::asinh((lambda - centre) / linear);
  const Vector motions = motions_at(at.lambda);
  at.x = (moves_.array() > 0).select(x.cwiseQuotient(motions), x / r_at(at.lambda));
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

// dlambda = r dmu,  dx_i = f_i (dy_i + e_i r'/r y_i dmu), f the factors of the unknowns, e their rates in parts of r's
Direction GrowingUnits::inside(Direction direction, const CurvePoint& at) const {
  const double r = r_at(at.lambda), growth = growth_of(at.lambda);
  put(at.x, at.lambda);
  direction.dlambda /= r;
  direction.dx = direction.dx.cwiseQuotient(columns_) -
                 growth * direction.dlambda * column_rates(at.lambda).cwiseProduct(at.x);
  const Vector weights = problem_.metric();
  const double length =
      std::sqrt(direction.dx.cwiseAbs2().dot(weights) + direction.dlambda * direction.dlambda);
  direction.dx /= length;
  direction.dlambda /= length;
  return direction;
}

Direction GrowingUnits::outside(Direction direction, const CurvePoint& at) const {
  const double r = r_at(at.lambda), growth = growth_of(at.lambda);
  put(at.x, at.lambda);
  direction.dx += growth * direction.dlambda * column_rates(at.lambda).cwiseProduct(at.x);
  direction.dx.array() *= columns_.array();
  direction.dlambda *= r;
  return direction;
}

}  // namespace springfold::continuation
