#include "continuation/points/normalised.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "springfold/continuation/newton.hpp"
#include "springfold/core/scaling.hpp"

namespace springfold::continuation {
namespace {

/// Power of two that brings a weight of the metric into [1, 4).
double unit_of(double weight) {
  if (!(weight > 0) || !std::isfinite(weight)) return 1;
  return std::ldexp(1, -static_cast<int>(std::floor(0.5 * std::ilogb(weight))));
}

/// A problem that changes the sizes of what it gives would have the engine read beyond their ends.
void expect_size(Index found, Index needed, const char* what) {
  if (found != needed)
    throw std::invalid_argument(std::string(what) + " has size " + std::to_string(found) +
                                " in the middle of a curve, needed: " + std::to_string(needed));
}

/// How far beside the start the equations are looked at as well: at the start itself all their
/// derivatives may vanish.
constexpr std::array<double, 3> distances_beside{0, 1.0 / 128, 1.0 / 8};

}  // namespace

Normalised::Normalised(ProblemView problem, const Vector& x, double lambda, const Piece& piece)
    : growing_{problem},
      problem_{problem},
      unit_{problem.metric().unaryExpr(&unit_of)},
      start_{x},
      start_lambda_{lambda},
      start_piece_{piece} {
  const Index n = problem.size();
  force_ = problem.symmetric() ? unit_ : Vector::Ones(n);
  surface_ = Vector::Ones(problem.switch_count());
  AboutStart about;
  double largest = 0;
  if (!growing_.in_parts())
    each_about_start([&](const Linearisation& at) {
      if (growing_.may_count_by_energy()) take_in(at, unit_, problem.metric(), about);
      largest = std::max(largest, largest_in(at));
    });
  growing_.count_by_energy({.x = x, .lambda = lambda, .piece = piece}, unit_, about);
  if (!growing_.is_plain()) {
    problem_ = ProblemView(growing_);
    const CurvePoint start = growing_.inside(x, lambda);
    start_ = start.x;
    start_lambda_ = start.lambda;
    largest = largest_about_start();
  }
  force_ /= power_of_two_near(largest);
  places_ = size_of_places();
  scale_switches(start_, start_lambda_);
}

/// Largest entry of [dG/dy dG/dlambda], of a problem with unknowns.
double Normalised::largest_in(const Linearisation& at) const {
  const double rate = force_.cwiseProduct(at.dF_dlambda).cwiseAbs().maxCoeff();
  if (at.structured) return std::max(rate, scaled(*at.structured, force_, unit_).largest);
  const Matrix K = force_.asDiagonal() * at.dF_dx * unit_.asDiagonal();
  return std::max(rate, K.cwiseAbs().maxCoeff());
}

/// Looks at the equations at the start and beside it, one place after the other.
/// @param see  takes a linearisation
template <class See>
void Normalised::each_about_start(const See& see) const {
  if (unit_.size() == 0) return;
  for (const double d : distances_beside) {
    Linearisation at;
    if (linearise(problem_, start_ + d * unit_, start_lambda_ + d, start_piece_, at)) see(at);
  }
}

/// The same of what is left where lambda is orders of magnitude larger than at the start: of all but the stiffness that
/// it finds there, and does not change. 0: not known.
double Normalised::largest_that_stays(const Vector& x, double lambda, const Piece& piece) const {
  constexpr double d = distances_beside.back();
  Linearisation at, aside;
  if (problem_.structured() || !linearise_densely(problem_, x, lambda, piece, at) ||
      !linearise_densely(problem_, x + d * unit_, lambda + d, piece, aside))
    return 0;
  Matrix K = at.dF_dx;
  const double r = growing_.r_at(lambda + d) / growing_.r_at(lambda);
  const Vector weights = problem_.metric();
  const Vector c = growing_.motions_at(lambda).cwiseQuotient(growing_.motions_at(lambda + d));
  for (Index j = 0; j < K.cols(); ++j)
    for (Index i = 0; i < K.rows(); ++i)
      if (weights[i] > 0 && weights[j] > 0)
        K(i, j) = (r * c[i] * c[j] * aside.dF_dx(i, j) - K(i, j)) / d;
  return std::max((force_.asDiagonal() * K * unit_.asDiagonal()).cwiseAbs().maxCoeff(),
                  force_.cwiseProduct(at.dF_dlambda).lpNorm<Eigen::Infinity>());
}

/// The largest entry there where units grow with lambda.
double Normalised::largest_about_start() const {
  double largest =
      growing_.in_parts() ? largest_that_stays(start_, start_lambda_, start_piece_) : 0;
  if (!(largest > 0))
    each_about_start([&](const Linearisation& at) { largest = std::max(largest, largest_in(at)); });
  return largest;
}

/// Where unknowns count by their energy: what rounding makes of their places, which stay as they are, in the equations.
double Normalised::size_of_places() const {
  Linearisation at;
  if (growing_.is_plain() || problem_.structured() ||
      !linearise_densely(problem_, start_, start_lambda_, start_piece_, at))
    return 1;
  const Matrix K = force_.asDiagonal() * at.dF_dx;
  return std::max(1.0, (K.cwiseAbs() * growing_.places_at(start_lambda_)).maxCoeff());
}

double Normalised::growth(const Piece& piece) const {
  if (piece == start_piece_) return places_;
  for (const auto& [known, growth] : growths_)
    if (known == piece) return growth;
  Linearisation at;
  const bool is_known = unit_.size() > 0 && linearise(problem_, start_, start_lambda_, piece, at);
  const double growth = is_known ? std::max(places_, largest_in(at)) : places_;
  growths_.emplace_back(piece, growth);
  return growth;
}

void Normalised::scale_switches(const Vector& x, double lambda) {
  Matrix dg_dx;
  Vector dg_dlambda;
  if (surface_.size() == 0 || !problem_.switch_gradients(x, lambda, dg_dx, dg_dlambda)) return;
  for (Index j = 0; j < surface_.size(); ++j) {
    const Vector slope = dg_dx.row(j).transpose().cwiseProduct(unit_);
    surface_[j] = 1 / power_of_two_near(std::hypot(slope.norm(), dg_dlambda[j]));
  }
}

bool Normalised::residual(const Vector& y, double lambda, const Piece& piece, Vector& G) const {
  x_ = y.cwiseProduct(unit_);
  if (!problem_.residual(x_, lambda, piece, G)) return false;
  expect_size(G.size(), force_.size(), "the residual");
  G.array() *= force_.array();
  return true;
}

bool Normalised::derivatives(const Vector& y, double lambda, const Piece& piece, Matrix& dG_dy,
                             Vector& dG_dlambda) const {
  x_ = y.cwiseProduct(unit_);
  if (!problem_.derivatives(x_, lambda, piece, dG_dy, dG_dlambda)) return false;
  scale(dG_dy, dG_dlambda);
  return true;
}

bool Normalised::equations(const Vector& y, double lambda, const Piece& piece, Vector& G,
                           Matrix& dG_dy, Vector& dG_dlambda) const {
  x_ = y.cwiseProduct(unit_);
  if (!problem_.equations(x_, lambda, piece, G, dG_dy, dG_dlambda)) return false;
  expect_size(G.size(), force_.size(), "the residual");
  G.array() *= force_.array();
  scale(dG_dy, dG_dlambda);
  return true;
}

void Normalised::scale(Matrix& dG_dy, Vector& dG_dlambda) const {
  const Index n = unit_.size();
  expect_size(dG_dy.rows(), n, "dF_dx (rows)");
  expect_size(dG_dy.cols(), n, "dF_dx (columns)");
  expect_size(dG_dlambda.size(), n, "dF_dlambda");
  const double* __restrict const force = force_.data();
  for (Index j = 0; j < n; ++j) {
    double* __restrict const column = dG_dy.col(j).data();
    const double unit = unit_[j];
    for (Index i = 0; i < n; ++i) column[i] *= force[i] * unit;
  }
  dG_dlambda.array() *= force_.array();
}

bool Normalised::structured_derivatives(const Vector& y, double lambda, const Piece& piece,
                                        StructuredMatrix& dG_dy, Vector& dG_dlambda) const {
  x_ = y.cwiseProduct(unit_);
  if (!problem_.structured_derivatives(x_, lambda, piece, matrices_.next(), dG_dlambda))
    return false;
  expect_size(dG_dlambda.size(), unit_.size(), "dF_dlambda");
  matrices_.put(force_, unit_, dG_dy);
  dG_dlambda.array() *= force_.array();
  return true;
}

bool Normalised::switches(const Vector& y, double lambda, Vector& h) const {
  x_ = y.cwiseProduct(unit_);
  if (!problem_.switches(x_, lambda, h)) return false;
  expect_size(h.size(), surface_.size(), "switches()");
  h.array() *= surface_.array();
  return true;
}

bool Normalised::switch_gradients(const Vector& y, double lambda, Matrix& dh_dy,
                                  Vector& dh_dlambda) const {
  x_ = y.cwiseProduct(unit_);
  if (!problem_.switch_gradients(x_, lambda, dh_dy, dh_dlambda)) return false;
  expect_size(dh_dy.rows(), surface_.size(), "dg_dx (rows)");
  expect_size(dh_dy.cols(), unit_.size(), "dg_dx (columns)");
  expect_size(dh_dlambda.size(), surface_.size(), "dg_dlambda");
  dh_dy.array().colwise() *= surface_.array();
  dh_dy.array().rowwise() *= unit_.transpose().array();
  dh_dlambda.array() *= surface_.array();
  return true;
}

Ray Normalised::inside(const Ray& ray, const CurvePoint& at) const {
  CurvePoint beginning = at;
  beginning.x.array() *= unit_.array();
  Ray result = ray;
  if (!growing_.is_plain()) result.tangent = growing_.inside(std::move(result.tangent), beginning);
  result.tangent.dx = in_units(result.tangent.dx);
  if (ray.start) result.start = inside(*ray.start);
  if (ray.beyond) result.beyond = inside(*ray.beyond);
  return result;
}

Ray Normalised::outside(const Ray& ray, const CurvePoint& at) const {
  CurvePoint beginning = at;
  beginning.x.array() *= unit_.array();
  Ray result = ray;
  result.tangent.dx.array() *= unit_.array();
  if (!growing_.is_plain()) result.tangent = growing_.outside(std::move(result.tangent), beginning);
  if (ray.start) result.start = outside(*ray.start);
  if (ray.beyond) result.beyond = outside(*ray.beyond);
  return result;
}

CurvePoint Normalised::in_own(CurvePoint point) const {
  point.x = in_units(point.x);
  if (point.tangent.dx.size() > 0) point.tangent.dx = in_units(point.tangent.dx);
  return point;
}

CurvePoint Normalised::inside(const Vector& x, double lambda) const {
  if (!growing_.is_plain()) return in_own(growing_.inside(x, lambda));
  CurvePoint at;
  at.x = in_units(x);
  at.lambda = lambda;
  return at;
}

CurvePoint Normalised::inside(const CurvePoint& point) const {
  return in_own(growing_.is_plain() ? point : growing_.inside(point));
}

CurvePoint Normalised::outside(CurvePoint point) const {
  point.x.array() *= unit_.array();
  if (point.tangent.dx.size() > 0) point.tangent.dx.array() *= unit_.array();
  return growing_.is_plain() ? std::move(point) : growing_.outside(std::move(point));
}

Hit Normalised::outside(const Hit& hit) const {
  Hit result = hit;
  result.point = outside(hit.point);
  for (CurvePoint& point : result.leaving) point = outside(std::move(point));
  for (CurvePoint& point : result.leaving_beside) point = outside(std::move(point));
  return result;
}

std::vector<Event> Normalised::inside(const std::vector<Event>& events) const {
  std::vector<Event> result = events;
  const auto of_point_outside = [this](std::function<double(const CurvePoint&)> value) {
    return [this, value = std::move(value), there = CurvePoint{}](const CurvePoint& point) mutable {
      there = point;  // into the memory of the last one
      there = outside(std::move(there));
      return value(there);
    };
  };
  for (Event& event : result) {
    event.value = of_point_outside(std::move(event.value));
    if (event.noise) event.noise = of_point_outside(std::move(event.noise));
  }
  return result;
}

StepObserver Normalised::inside(const StepObserver& observer) const {
  if (!observer) return {};
  return [this, &observer](const CurvePoint& point) { return observer(outside(point)); };
}

HitObserver Normalised::inside(const HitObserver& observer) const {
  if (!observer) return {};
  return [this, &observer](const Hit& hit) { return observer(outside(hit)); };
}

DiagramOptions Normalised::inside(const DiagramOptions& options) const {
  DiagramOptions result = options;
  const auto moved_out = [this](const auto& ask) {
    return [this, ask](const CurvePoint& point) { return ask(outside(point)); };
  };
  if (options.left_out) result.left_out = moved_out(options.left_out);
  if (options.ends_at) result.ends_at = moved_out(options.ends_at);
  if (options.outside) result.outside = moved_out(options.outside);
  return result;
}

Curve Normalised::outside(Curve curve) const {
  for (CurvePoint& point : curve.points) point = outside(std::move(point));
  for (Hit& hit : curve.hits) hit = outside(hit);
  return curve;
}

Diagram Normalised::outside(Diagram diagram) const {
  for (Branch& branch : diagram.branches) branch.curve = outside(std::move(branch.curve));
  for (Junction& junction : diagram.junctions) {
    junction.point = outside(junction.point);
    for (Way& way : junction.ways) {
      way.point = outside(way.point);
      way.start = outside(way.start);
      if (way.beyond) way.beyond = outside(*way.beyond);
    }
  }
  for (Doubt& doubt : diagram.doubts)
    if (doubt.place) doubt.place = outside(*doubt.place);
  return diagram;
}

}  // namespace springfold::continuation
