#include "springfold/continuation/response.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "springfold/continuation/entry_checks.hpp"
#include "springfold/continuation/newton.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/core/bordered_factors.hpp"
#include "springfold/core/decompositions.hpp"
#include "springfold/core/equilibration.hpp"
#include "springfold/core/finite.hpp"

namespace springfold::continuation {
namespace {

/// First critical loads in a unit of lambda: a few steps of ordinary length lie before the first one.
constexpr double critical_loads = 8;

/// Motion up to the first critical load that shows how x responds.
constexpr double clear_motion = 1.0 / 64;

/// dF/dx at one point with lambda held, its rows and columns brought to one size, factorised.
class Regular {
 public:
  bool begin(ProblemView problem, const Vector& x, double lambda, const Piece& piece) {
    if (!linearise(problem, x, lambda, piece, at_)) return false;
    const Index n = x.size();
    columns_ = rows_ = Vector::Ones(n);
    if (!at_.structured) {
      const Equilibration factors = equilibrate(at_.dF_dx);
      rows_ = factors.rows;
      columns_ = factors.columns;
      at_.dF_dx = (rows_.asDiagonal() * at_.dF_dx * columns_.asDiagonal()).eval();
      at_.dF_dlambda = rows_.cwiseProduct(at_.dF_dlambda).eval();
    }
    factors_.begin(at_, problem.symmetric());
    u_.resize(n + 1);
    return factors_.set_border(Vector::Ones(n), {Vector::Zero(n), 1});
  }

  /// dx / dlambda along the curve.
  bool tangent(Vector& dx) {
    if (!factors_.solve_for_tangent(u_.data())) return false;
    dx = columns_.cwiseProduct(u_.head(columns_.size())) / u_[columns_.size()];
    return all_finite(dx);
  }

  /// Replaces r, in the units of F, by the solution of dF/dx v = r, in those of x.
  bool solve(Vector& r) {
    const Index n = r.size();
    u_ << rows_.cwiseProduct(r), 0;
    if (!factors_.solve(u_.data())) return false;
    r = columns_.cwiseProduct(u_.head(n));
    return all_finite(r);
  }

  const Vector& units() const { return columns_; }
  std::optional<Index> negative() { return factors_.negative(); }

 private:
  Linearisation at_{};
  BorderedFactors factors_{};
  Vector rows_{}, columns_{}, u_{};
};

/// Numbers between 1/2 and 3/2 without symmetry or pattern, the same everywhere: sampling.hpp's are spread evenly, and
/// loads that alternate evenly leave the softest motions of a mechanism alone.
Vector irregular_loads(Index n) {
  Vector v(n);
  std::uint64_t state = 0x9E3779B97F4A7C15;
  for (Index i = 0; i < n; ++i) {
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    v[i] = 0.5 + static_cast<double>(state >> 11) * 0x1p-53;
  }
  return v;
}

/// Largest magnitude of an eigenvalue of (dF/dx)^-1 d(dF/dx)/dlambda along the curve, roughly, from what its powers do
/// to a vector. Its inverse is how far in lambda the next singular point seems to lie.
/// @param d  half of the way in lambda that the rate is taken over
std::optional<double> rate_of_matrix(ProblemView problem, const Vector& x, double lambda,
                                     const Piece& piece, const Vector& dx, double d,
                                     Regular& here) {
  Linearisation before, after;
  if (!linearise(problem, x - d * dx, lambda - d, piece, before) ||
      !linearise(problem, x + d * dx, lambda + d, piece, after))
    return std::nullopt;
  // The geometric mean of an even number of factors: they alternate where eigenvalues come in pairs of both signs.
  constexpr int powers = 12, settled = 4;
  Vector v = irregular_loads(x.size());
  double logarithms = 0;
  for (int k = 0; k < powers; ++k) {
    const Vector moved = here.units().cwiseProduct(v);
    Vector image = (product(after, moved) - product(before, moved)) / (2 * d);
    if (!here.solve(image)) return std::nullopt;
    v = image.cwiseQuotient(here.units());
    const double size = v.norm();
    if (!(size > 0) || !std::isfinite(size)) return 0.0;
    v /= size;
    if (k >= settled) logarithms += std::log(size);
  }
  return std::exp(logarithms / (powers - settled));
}

/// Length of dx in the metric, without entries that are nothing but what rounding leaves of loads that cancel.
double motion(const Vector& weights, const Vector& dx, const Vector& units) {
  constexpr double rounding = 64 * rounding_unit;
  const double size = dx.cwiseQuotient(units).lpNorm<Eigen::Infinity>();
  double squares = 0;
  for (Index i = 0; i < dx.size(); ++i)
    if (std::abs(dx[i]) > rounding * size * units[i]) squares += weights[i] * dx[i] * dx[i];
  return std::sqrt(squares);
}

double stiffness_of(const Vector& weights, Regular& here) {
  Vector loads = (weights.array() > 0).select(irregular_loads(weights.size()), 0);
  const double size = loads.norm();
  if (!here.solve(loads)) return 0;
  const double moved = motion(weights, loads, here.units());
  return moved > 0 ? size / moved : infinity;
}

/// How far in lambda the next singular point seems to lie; infinity: nothing is seen of one.
double critical_way(ProblemView problem, const Vector& x, double lambda, const Piece& piece,
                    const Vector& dx, double moved, Regular& here) {
  // The rate is taken over a short way in x; where x does not move, over a way that the result itself asks for.
  constexpr double short_way = told_apart, far = 1000, farther = 1 / residual_level;
  double d = moved > 0 ? short_way / moved : std::max(1.0, std::abs(lambda));
  double way = infinity;
  for (int i = 0; i < 4; ++i) {
    const auto rate = rate_of_matrix(problem, x, lambda, piece, dx, d, here);
    way = rate && *rate > 0 ? 1 / *rate : infinity;
    if (way < far * d && d < far * way) break;
    const double next = std::isfinite(way) ? way : farther * d;
    if (moved > 0 && next > d) break;
    d = next;
  }
  return way < farther * d ? way : infinity;
}

/// Newton's method at a fixed lambda that goes on also where the second correction is larger than the first, that
/// across a stiff member is tiny and says nothing of the others, and ends where a place has no more to be corrected:
/// residuals are rounding of stiff members.
std::optional<Vector> solution_near(ProblemView problem, Vector x, double lambda,
                                    const Piece& piece) {
  constexpr int steps = 12;
  const Vector weights = problem.metric();
  const Direction across{Vector::Zero(x.size()), 1};
  for (int i = 0; i < steps; ++i) {
    NewtonResult next = correct(problem, weights, std::move(x), lambda, piece, across,
                                NewtonOptions{.maximum_iterations = 1});
    if (next.status != NewtonStatus::too_many_iterations && !converged(next)) return std::nullopt;
    x = std::move(next.x);
    if (converged(next) || next.corrections.back() <= promised_place) return x;
  }
  return std::nullopt;
}

/// Is there no critical point where K and its rate promise one? A stiff member that turns takes its stiffness along,
/// and the rate of K alone tells a loss of it. The curve then goes on beyond a clear motion to both sides, about where
/// its tangent leads, with as many negative eigenvalues. @param moved |dx| @pre the promised way is shorter than that
/// motion
bool is_broken_promise(ProblemView problem, const Vector& x, double lambda, const Piece& piece,
                       const Vector& dx, double moved, Regular& here) {
  constexpr double beyond = 1.5, about = 0.5;
  const auto before = here.negative();
  if (!before) return false;
  const Vector weights = problem.metric();
  for (const double side : {-beyond, beyond}) {
    const double there = side * clear_motion / moved;
    const Vector expected = x + there * dx;
    const auto at = solution_near(problem, expected, lambda + there, piece);
    Regular beside;
    if (!at || !beside.begin(problem, *at, lambda + there, piece)) return false;
    if (motion(weights, *at - expected, here.units()) >
        about * motion(weights, there * dx, here.units()))
      return false;
    if (beside.negative() != before) return false;
  }
  return true;
}

/// |dlambda| for |dx| = 1 along the parabola of a curve that turns just beside the point: through it and a corrected
/// point `clear_motion` away on both sides. Where its vertex lies within twice that, what the tangent says holds
/// nowhere else. Points that no parabola goes through lie on two branches, as beside an imperfect branch point.
/// @returns nothing where the curve goes on straight
std::optional<double> bend_beside(ProblemView problem, const Vector& x, double lambda,
                                  const Piece& piece, const Vector& dx, double moved) {
  const Vector weights = problem.metric();
  const Direction along{dx / moved, 0};
  constexpr double about = 0.5;
  double change = 0, odd = -clear_motion / moved;
  for (const double side : {-clear_motion, clear_motion}) {
    const NewtonResult there = correct(problem, weights, x + side * along.dx, lambda, piece, along,
                                       NewtonOptions{.maximum_iterations = 12});
    if (!converged(there)) return std::nullopt;
    change += 0.5 * (there.lambda - lambda);
    odd += std::copysign(0.5, side) * (there.lambda - lambda);
  }
  if (!(std::abs(odd) <= about * std::abs(change))) return std::nullopt;
  const double bend = std::abs(change) / (clear_motion * clear_motion);
  return 2 * bend * moved * 2 * clear_motion >= 1 ? std::optional(bend) : std::nullopt;
}

/// Is the least stiffness, small as it may be beside others, that of soft members, and not what loads leave that nearly
/// cancel it? Multipliers that act on ways of length 1 take or give as much stiffness as they are large, and where they
/// are a thousand times what is left they may have cancelled the rest; special points are placed to `poor` at worst, in
/// parts of lambda.
bool is_of_soft_members(const Vector& weights, const Vector& x, double lambda, double way,
                        double stiffness) {
  double multiplier = 0;
  for (Index i = 0; i < x.size(); ++i)
    if (weights[i] == 0) multiplier = std::max(multiplier, std::abs(x[i]));
  return poor * std::abs(lambda) <= way && tiny_share * multiplier <= stiffness;
}

/// Is dF/dx singular, to what special points are located to at worst, or where its members are soft at best? Its
/// entries count beside what they are a little aside: a row or column that vanishes at the point would otherwise look
/// like one in a small unit.
bool is_singular(ProblemView problem, const Vector& x, double lambda, const Piece& piece,
                 bool is_soft) {
  if (problem.structured()) return false;
  Linearisation here;
  if (!linearise(problem, x, lambda, piece, here) || x.size() == 0) return false;
  const Vector weights = problem.metric();
  Matrix sizes = here.dF_dx.cwiseAbs();
  Vector direction = Vector::LinSpaced(x.size(), 1, 2).normalized();
  for (Index i = 0; i < x.size(); ++i)
    direction[i] = weights[i] > 0 ? direction[i] / std::sqrt(weights[i]) : 0;
  for (const double h : {-small_share, small_share}) {
    Linearisation aside;
    if (linearise(problem, x + h * direction, lambda, piece, aside))
      sizes = sizes.cwiseMax(negligible_share * (aside.dF_dx - here.dF_dx).cwiseAbs());
  }
  const Equilibration scale = equilibrate(sizes);
  const Matrix equilibrated = scale.rows.asDiagonal() * here.dF_dx * scale.columns.asDiagonal();
  if (vanishing_values(divided_svd(equilibrated).values) == 0) return false;
  return !is_soft || divided_svd(here.dF_dx).values.tail<1>()[0] <= promised_place;
}

}  // namespace

std::optional<Response> response_at(ProblemView problem, const Vector& x, double lambda,
                                    const Piece& piece) {
  check_point(problem, x, lambda, piece);
  const Vector weights = problem.metric();
  Regular here;
  Vector dx;
  if (!here.begin(problem, x, lambda, piece) || !here.tangent(dx)) return std::nullopt;
  const double moved = motion(weights, dx, here.units());
  const double way = critical_way(problem, x, lambda, piece, dx, moved, here);
  Response response;
  double change = 1;  // in lambda: what multipliers are measured over
  response.stiffness = stiffness_of(weights, here);
  const bool responds =
      moved > 0 && (way * moved >= clear_motion ||
                    is_broken_promise(problem, x, lambda, piece, dx, moved, here));
  if (responds) {
    change = 1 / moved;
    response.lambda = slopes_in_a_unit * change;
  } else if (const auto bend = moved > 0 && std::isfinite(way)
                                   ? bend_beside(problem, x, lambda, piece, dx, moved)
                                   : std::nullopt) {
    change = 1 / moved;
    response.lambda = slopes_in_a_unit * *bend;
    response.stiffness =
        infinity;  // what a turn of the load beside the point leaves is no member's
  } else if (std::isfinite(way)) {
    // At a special point the next one is this one, which is no unit of anything.
    if (way < tiny_share &&
        is_singular(problem, x, lambda, piece,
                    is_of_soft_members(weights, x, lambda, way, response.stiffness)))
      return std::nullopt;
    change = critical_loads * way;
    response.lambda = change;
  }
  for (Index i = 0; i < dx.size(); ++i)
    if (weights[i] == 0)
      response.multiplier = std::max(response.multiplier, std::abs(dx[i]) * change);
  return response;
}

}  // namespace springfold::continuation
