#include "continuation/points/growing_units.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "springfold/continuation/newton.hpp"
#include "springfold/core/rounding.hpp"

namespace springfold::continuation {
namespace {

/// By how much the entry on the diagonal exceeds the others among motions: so stiff is a motion at least, however the
/// others move. What is stiff between two of them alone lets both go on together.
Vector own_stiffness(const Vector& units, const Matrix& A) {
  const Matrix sizes = (units.asDiagonal() * A * units.asDiagonal()).cwiseAbs();
  return (2 * sizes.diagonal() - sizes.rowwise().sum()).cwiseMax(0);
}

/// The least of the rows of motions: its largest entry, that by lambda among them, at any of the places.
double least_row(const Vector& units, const Vector& moves,
                 const std::vector<Linearisation>& about) {
  Vector rows = Vector::Zero(units.size());
  for (const Linearisation& at : about)
    rows = rows.cwiseMax((units.asDiagonal() * at.dF_dx * units.asDiagonal())
                             .cwiseAbs()
                             .rowwise()
                             .maxCoeff())
               .cwiseMax(units.cwiseProduct(at.dF_dlambda).cwiseAbs());
  return (moves.array() > 0 && rows.array() > 0).select(rows, infinity).minCoeff();
}

/// What lambda does to the equations of motions, at most, per unit.
double force_of_lambda(const Vector& units, const std::vector<Linearisation>& about) {
  double largest = 0;
  for (const Linearisation& at : about)
    largest = std::max(largest, units.cwiseProduct(at.dF_dlambda).lpNorm<Eigen::Infinity>());
  return largest;
}

}  // namespace

GrowingUnits::GrowingUnits(ProblemView problem)
    : problem_{problem},
      measure_{problem.lambda_measure()},
      moves_{(problem.metric().array() > 0).cast<double>()},
      stiff_{Vector::Zero(problem.size())},
      centre_{Vector::Zero(problem.size())} {}

/// The stiffness of each motion that every piece has which one switch alone, or all of them, lead to.
/// @param least  what is less is of no matter  @returns nothing where derivatives are not defined
std::optional<Vector> GrowingUnits::lasting_stiffness(const CurvePoint& start, const Vector& units,
                                                      double least) const {
  const Piece& piece = start.piece;
  std::vector<Piece> pieces{piece, Piece(piece.size(), -1), Piece(piece.size(), 1)};
  for (std::size_t j = 0; j < piece.size(); ++j) {
    pieces.push_back(piece);
    pieces.back()[j] = static_cast<Piece::value_type>(-piece[j]);
  }
  std::optional<Vector> stiffness;
  for (const Piece& one : pieces) {
    Linearisation at;
    if (!linearise_densely(problem_, start.x, start.lambda, one, at)) return std::nullopt;
    const Vector sizes = own_stiffness(units, at.dF_dx);
    stiffness = stiffness ? Vector(stiffness->cwiseMin(sizes)) : sizes;
    if (!(stiffness->array() > least).any()) break;
  }
  return stiffness;
}

/// Structured problems, and those without an energy, keep their motions as they are. So does what is stiff in one piece
/// alone: in the others it would move for orders of magnitude longer than others do.
void GrowingUnits::count_by_energy(const CurvePoint& start, const Vector& units,
                                   const std::vector<Linearisation>& about) {
  start_ = start.lambda;
  if (problem_.structured() || !problem_.symmetric() || units.size() == 0) return;
  if (!in_parts() && about.empty()) return;
  const Vector of_motions = moves_.cwiseProduct(units);
  const double row = in_parts() ? 1 : least_row(units, moves_, about);
  const double least = stiff_beside_others * row;
  // With lambda as it is, where the tolerance of the stiffest row would hide the least one.
  const double counts = in_parts() ? least : row / NewtonOptions{}.residual_tolerance;
  if (!in_parts()) {
    load_ = force_of_lambda(of_motions, about) / row;
    const bool may_be = (own_stiffness(of_motions, about.front().dF_dx).array() > counts).any();
    if (!may_be || !(load_ > 0)) return;  // what lambda does not load it never grows up to
  }
  if (const auto stiffness = lasting_stiffness(start, of_motions, counts)) {
    stiff_ = (stiffness->array() > counts).select(*stiffness / least, 0);
    centre_ = (stiffness->array() > counts).select(start.x, 0);
  }
}

bool GrowingUnits::in_parts() const { return std::isfinite(measure_.linear); }

bool GrowingUnits::is_plain() const { return !in_parts() && !(stiff_.array() > 0).any(); }

double GrowingUnits::lambda_at(double mu) const {
  const auto [centre, linear] = measure_;
  return in_parts() ? centre + linear * std::sinh((mu - centre) / linear) : mu;
}

double GrowingUnits::r_at(double mu) const {
  return in_parts() ? std::cosh((mu - measure_.centre) / measure_.linear)
                    : std::hypot(std::max(1.0, load_), load_ * (mu - start_));
}

double GrowingUnits::rate_of_lambda(double mu) const { return in_parts() ? r_at(mu) : 1; }

double GrowingUnits::growth_of(double mu) const {
  if (in_parts()) return std::tanh((mu - measure_.centre) / measure_.linear) / measure_.linear;
  const double rate = load_ / r_at(mu);
  return (mu - start_) * rate * rate;
}

Vector GrowingUnits::motions_at(double mu) const { return (1 + stiff_.array() / r_at(mu)).rsqrt(); }

void GrowingUnits::put(const Vector& y, double mu) const {
  const double r = rate_of_lambda(mu);
  columns_ = motions_at(mu);
  rows_ = (moves_.array() > 0).select(columns_ / r, 1);
  columns_ = (moves_.array() > 0).select(columns_, r);
  x_ = centre_ + columns_.cwiseProduct(y);
}

/// Of c: half of the share of stiff / r in 1 + stiff / r. Of forces that grow with r: 1.
Vector GrowingUnits::column_rates(double mu) const {
  const Eigen::ArrayXd stiff = stiff_.array() / r_at(mu);
  return (moves_.array() > 0).select(0.5 * stiff / (1 + stiff), in_parts() ? 1 : 0);
}

/// Of c, or of c / r; rows of forces stay.
Vector GrowingUnits::row_rates(double mu) const {
  return (moves_.array() > 0).select(column_rates(mu).array() - (in_parts() ? 1 : 0), 0);
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
  dG_dmu = rate_of_lambda(mu) * rows_.cwiseProduct(dG_dmu) +
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
  dg_dmu =
      (rate_of_lambda(mu) * dg_dmu + growth_of(mu) * (dg_dy * column_rates(mu).cwiseProduct(y)))
          .eval();
  return true;
}

CurvePoint GrowingUnits::inside(const Vector& x, double lambda) const {
  const auto [centre, linear] = measure_;
  CurvePoint at;
  at.lambda = in_parts() ? centre + linear * std::asinh((lambda - centre) / linear) : lambda;
  const Vector motions = motions_at(at.lambda);
  at.x = (moves_.array() > 0)
             .select((x - centre_).cwiseQuotient(motions), x / rate_of_lambda(at.lambda));
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

// dlambda = (dlambda/dmu) dmu,  dx_i = f_i (dy_i + e_i r'/r y_i dmu), f the factors of the unknowns, e their rates
Direction GrowingUnits::inside(Direction direction, const CurvePoint& at) const {
  const double r = rate_of_lambda(at.lambda), growth = growth_of(at.lambda);
  put(at.x, at.lambda);
  direction.dlambda /= r;
  direction.dx = direction.dx.cwiseQuotient(columns_) -
                 growth * direction.dlambda * column_rates(at.lambda).cwiseProduct(at.x);
  set_length_one(problem_.metric(), direction);
  return direction;
}

Direction GrowingUnits::outside(Direction direction, const CurvePoint& at) const {
  const double r = rate_of_lambda(at.lambda), growth = growth_of(at.lambda);
  put(at.x, at.lambda);
  direction.dx += growth * direction.dlambda * column_rates(at.lambda).cwiseProduct(at.x);
  direction.dx.array() *= columns_.array();
  direction.dlambda *= r;
  if (!in_parts()) set_length_one(problem_.metric(), direction);
  return direction;
}

}  // namespace springfold::continuation
