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

/// The least of the rows of motions; infinity: there is none.
double least_row(const AboutStart& about, const Vector& moves) {
  return (moves.array() > 0 && about.rows.array() > 0).select(about.rows, infinity).minCoeff();
}

}  // namespace

void take_in(const Linearisation& at, const Vector& units, const Vector& weights,
             AboutStart& about) {
  const Vector of_motions = (weights.array() > 0).select(units, 0);
  if (about.own.size() == 0) {
    about.own = own_stiffness(of_motions, at.dF_dx);
    about.rows = Vector::Zero(units.size());
  }
  about.rows =
      about.rows
          .cwiseMax(
              (units.asDiagonal() * at.dF_dx * units.asDiagonal()).cwiseAbs().rowwise().maxCoeff())
          .cwiseMax(units.cwiseProduct(at.dF_dlambda).cwiseAbs());
  about.by_lambda =
      std::max(about.by_lambda, of_motions.cwiseProduct(at.dF_dlambda).lpNorm<Eigen::Infinity>());
}

GrowingUnits::GrowingUnits(ProblemView problem)
    : problem_{problem},
      measure_{problem.lambda_measure()},
      moves_{(problem.metric().array() > 0).cast<double>()},
      stiff_{Vector::Zero(problem.size())},
      centre_{Vector::Zero(problem.size())} {}

/// The stiffness of each motion that every piece has which one switch alone, or all of them, lead to.
/// @param stiffness  in the start's own piece, empty: not known yet  @param least  what is less is of no matter
/// @returns nothing where derivatives are not defined
std::optional<Vector> GrowingUnits::lasting_stiffness(const CurvePoint& start, const Vector& units,
                                                      Vector stiffness, double least) const {
  const Piece& piece = start.piece;
  Linearisation at;
  if (stiffness.size() == 0) {
    if (!linearise_densely(problem_, start.x, start.lambda, piece, at)) return std::nullopt;
    stiffness = own_stiffness(units, at.dF_dx);
  }
  std::vector<Piece> others{Piece(piece.size(), -1), Piece(piece.size(), 1)};
  for (std::size_t j = 0; j < piece.size(); ++j) {
    others.push_back(piece);
    others.back()[j] = static_cast<Piece::value_type>(-piece[j]);
  }
  for (const Piece& one : others) {
    if (!(stiffness.array() > least).any()) break;
    if (!linearise_densely(problem_, start.x, start.lambda, one, at)) return std::nullopt;
    stiffness = stiffness.cwiseMin(own_stiffness(units, at.dF_dx));
  }
  return stiffness;
}

/// In parts of lambda: stiff beside a row of the size that the problem has in its own units. As it is: where the
/// tolerance of the stiffest row would hide the least one, and lambda loads motions. What it does not load it never
/// grows up to.
std::optional<GrowingUnits::Asked> GrowingUnits::asked_of_stiffness(const AboutStart& about) const {
  if (in_parts()) return Asked{.counts = stiff_beside_others, .grown = stiff_beside_others};
  if (about.own.size() == 0) return std::nullopt;
  const double row = least_row(about, moves_), load = about.by_lambda / row;
  if (!(load > 0)) return std::nullopt;
  return Asked{.counts = row / NewtonOptions{}.residual_tolerance,
               .grown = stiff_beside_others * row,
               .load = load};
}

/// Structured problems, and those without an energy, keep their motions as they are. So does what is stiff in one piece
/// alone: in the others it would move for orders of magnitude longer than others do.
void GrowingUnits::count_by_energy(const CurvePoint& start, const Vector& units,
                                   const AboutStart& about) {
  start_ = start.lambda;
  if (!may_count_by_energy() || units.size() == 0) return;
  const auto asked = asked_of_stiffness(about);
  if (!asked) return;
  load_ = asked->load;
  const auto stiffness =
      lasting_stiffness(start, moves_.cwiseProduct(units), about.own, asked->counts);
  if (!stiffness) return;
  stiff_ = (stiffness->array() > asked->counts).select(*stiffness / asked->grown, 0);
  centre_ = (stiffness->array() > asked->counts).select(start.x, 0);
}

bool GrowingUnits::in_parts() const { return std::isfinite(measure_.linear); }

bool GrowingUnits::is_plain() const { return !in_parts() && !(stiff_.array() > 0).any(); }

GrowingUnits::Growth GrowingUnits::growth_at(double mu) const {
  if (in_parts()) {
    const auto [centre, linear] = measure_;
    const double part = (mu - centre) / linear, r = std::cosh(part);
    return {.lambda = centre + linear * std::sinh(part),
            .r = r,
            .lambda_rate = r,
            .r_rate = std::tanh(part) / linear,
            .forces = 1};
  }
  const double r = std::hypot(std::max(1.0, load_), load_ * (mu - start_)), rate = load_ / r;
  return {.lambda = mu, .r = r, .r_rate = (mu - start_) * rate * rate};
}

double GrowingUnits::mu_of(double lambda) const {
  const auto [centre, linear] = measure_;
  return in_parts() ? centre + linear * std::asinh((lambda - centre) / linear) : lambda;
}

Vector GrowingUnits::motions_at(const Growth& at) const {
  return (1 + stiff_.array() / at.r).rsqrt();
}

void GrowingUnits::put(const Vector& y, const Growth& at) const {
  columns_ = motions_at(at);
  rows_ = (moves_.array() > 0).select(columns_ / at.lambda_rate, 1);
  columns_ = (moves_.array() > 0).select(columns_, at.lambda_rate);
  x_ = centre_ + columns_.cwiseProduct(y);
}

/// Of c: half of the share of stiff / r in 1 + stiff / r.
Vector GrowingUnits::column_rates(const Growth& at) const {
  const Eigen::ArrayXd stiff = stiff_.array() / at.r;
  return (moves_.array() > 0).select(0.5 * stiff / (1 + stiff), at.forces);
}

/// By mu: lambda grows, forces and motions do, and the factors of the rows, c or c / r, change; rows of forces stay.
/// @param columns  column_rates()  @param image  dG/dy times the rates of x at y, in parts of that of r
/// @param dG_dmu holds dF/dlambda; at the place of put(), with F_
void GrowingUnits::put_rate(const Growth& at, const Vector& columns, const Vector& image,
                            Vector& dG_dmu) const {
  const Vector rows = (moves_.array() > 0).select(columns.array() - at.forces, 0);
  dG_dmu = at.lambda_rate * rows_.cwiseProduct(dG_dmu) +
           at.r_rate * (image + rows.cwiseProduct(rows_).cwiseProduct(F_));
}

bool GrowingUnits::residual(const Vector& y, double mu, const Piece& piece, Vector& G) const {
  const Growth at = growth_at(mu);
  put(y, at);
  if (!problem_.residual(x_, at.lambda, piece, G)) return false;
  G.array() *= rows_.array();
  return true;
}

bool GrowingUnits::derivatives(const Vector& y, double mu, const Piece& piece, Matrix& dG_dy,
                               Vector& dG_dmu) const {
  const Growth at = growth_at(mu);
  put(y, at);
  if (!problem_.equations(x_, at.lambda, piece, F_, dG_dy, dG_dmu)) return false;
  dG_dy.array().colwise() *= rows_.array();
  dG_dy.array().rowwise() *= columns_.transpose().array();
  const Vector rates = column_rates(at);
  put_rate(at, rates, dG_dy * rates.cwiseProduct(y), dG_dmu);
  return true;
}

bool GrowingUnits::structured_derivatives(const Vector& y, double mu, const Piece& piece,
                                          StructuredMatrix& dG_dy, Vector& dG_dmu) const {
  const Growth at = growth_at(mu);
  put(y, at);
  if (!problem_.residual(x_, at.lambda, piece, F_) ||
      !problem_.structured_derivatives(x_, at.lambda, piece, matrices_.next(), dG_dmu))
    return false;
  matrices_.put(rows_, columns_, dG_dy);
  const Vector rates = column_rates(at);
  put_rate(at, rates, product(dG_dy, rates.cwiseProduct(y)), dG_dmu);
  return true;
}

bool GrowingUnits::switches(const Vector& y, double mu, Vector& g) const {
  const Growth at = growth_at(mu);
  put(y, at);
  return problem_.switches(x_, at.lambda, g);
}

bool GrowingUnits::switch_gradients(const Vector& y, double mu, Matrix& dg_dy,
                                    Vector& dg_dmu) const {
  const Growth at = growth_at(mu);
  put(y, at);
  if (!problem_.switch_gradients(x_, at.lambda, dg_dy, dg_dmu)) return false;
  dg_dy.array().rowwise() *= columns_.transpose().array();
  dg_dmu =
      (at.lambda_rate * dg_dmu + at.r_rate * (dg_dy * column_rates(at).cwiseProduct(y))).eval();
  return true;
}

CurvePoint GrowingUnits::inside(const Vector& x, double lambda) const {
  CurvePoint point;
  point.lambda = mu_of(lambda);
  const Growth at = growth_at(point.lambda);
  point.x =
      (moves_.array() > 0).select((x - centre_).cwiseQuotient(motions_at(at)), x / at.lambda_rate);
  return point;
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
  const Growth at = growth_at(point.lambda);
  put(point.x, at);
  point.x = x_;
  point.lambda = at.lambda;
  return point;
}

// dlambda = (dlambda/dmu) dmu,  dx_i = f_i (dy_i + e_i r'/r y_i dmu), f the factors of the unknowns, e their rates
Direction GrowingUnits::inside(Direction direction, const CurvePoint& point) const {
  const Growth at = growth_at(point.lambda);
  put(point.x, at);
  direction.dlambda /= at.lambda_rate;
  direction.dx = direction.dx.cwiseQuotient(columns_) -
                 at.r_rate * direction.dlambda * column_rates(at).cwiseProduct(point.x);
  set_length_one(problem_.metric(), direction);
  return direction;
}

Direction GrowingUnits::outside(Direction direction, const CurvePoint& point) const {
  const Growth at = growth_at(point.lambda);
  put(point.x, at);
  direction.dx += at.r_rate * direction.dlambda * column_rates(at).cwiseProduct(point.x);
  direction.dx.array() *= columns_.array();
  direction.dlambda *= at.lambda_rate;
  if (!in_parts()) set_length_one(problem_.metric(), direction);
  return direction;
}

}  // namespace springfold::continuation
