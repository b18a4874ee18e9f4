#include "parameters/family_differences.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include "springfold/continuation/numerics.hpp"
#include "springfold/core/differences.hpp"
#include "springfold/core/finite.hpp"

namespace springfold::continuation {
namespace {

/// As directional_step, of two points, where the error that is left may be a ten-millionth.
constexpr double rough_step = 0x1p-10;

/// How much wider a grid is that neighbouring places share.
constexpr double wider = 4;

/// The narrowest grid, of the step: beside places where the family is not smooth, or ends. Rounding costs as many
/// digits.
constexpr double narrowest = 0x1p-6;

/// All members of a family have the unknowns and the switches of the first one.
void check_shape(ProblemView problem, Index size, const Piece& piece) {
  if (problem.size() != size)
    throw std::invalid_argument("a problem of the family has " + std::to_string(problem.size()) +
                                " unknowns, needed: " + std::to_string(size));
  if (problem.switch_count() != static_cast<Index>(piece.size()))
    throw std::invalid_argument("a problem of the family has " +
                                std::to_string(problem.switch_count()) +
                                " switches, the piece has " + std::to_string(piece.size()));
}

/// Central differences through six places, and what they are expected to be off: the next order changes them by as much
/// less as the last one did beside the order before.
struct SixPoints {
  Vector value{};
  double expected_error = 0;
};

/// @param quotient  the central difference over [-t, t]; its error is even in t, of the first derivative as of the
///                  second
std::optional<SixPoints> six_points(const SampledFunction& quotient, double h) {
  std::array<Vector, 3> slopes;
  for (std::size_t k = 0; k < slopes.size(); ++k) {
    auto slope = quotient(static_cast<double>(k + 1) * h);
    if (!slope) return std::nullopt;
    slopes[k] = std::move(*slope);
  }
  const Vector by_four = (4 * slopes[0] - slopes[1]) / 3;
  SixPoints found{.value = 1.5 * slopes[0] - 0.6 * slopes[1] + 0.1 * slopes[2]};
  const double last = (found.value - by_four).lpNorm<Eigen::Infinity>(),
               before = (by_four - slopes[0]).lpNorm<Eigen::Infinity>();
  found.expected_error = before > last ? last * (last / before) : last;
  return found;
}

std::optional<Vector> limit_of(const SampledFunction& quotient, double step,
                               double* error = nullptr) {
  std::optional<SixPoints> best;
  for (double h = step; h >= narrowest * step; h /= wider) {
    auto found = six_points(quotient, h);
    if (!found) break;
    const double left = found->expected_error;
    if (!best || left < best->expected_error) best = std::move(found);
    if (left <= one_place * std::max(1.0, best->value.lpNorm<Eigen::Infinity>())) break;
  }
  if (best && error != nullptr)
    *error = best->expected_error / std::max(1.0, best->value.lpNorm<Eigen::Infinity>());
  return best ? std::optional<Vector>(std::move(best->value)) : std::nullopt;
}

}  // namespace

std::optional<Vector> derivative_at_zero(const SampledFunction& f, double step, double* error) {
  const auto quotient = [&](double t) -> std::optional<Vector> {
    const auto above = f(t), below = f(-t);
    if (!above || !below) return std::nullopt;
    return Vector((*above - *below) / (2 * t));
  };
  return limit_of(quotient, step, error);
}

std::optional<Vector> second_derivative_at_zero(const SampledFunction& f, double step) {
  const auto middle = f(0);
  if (!middle) return std::nullopt;
  const auto quotient = [&](double t) -> std::optional<Vector> {
    const auto above = f(t), below = f(-t);
    if (!above || !below) return std::nullopt;
    return Vector((*above - 2 * *middle + *below) / (t * t));
  };
  return limit_of(quotient, step);
}

bool base_terms(const Family& family, const Vector& x, double lambda, double mu, const Piece& piece,
                BaseTerms& terms) {
  const auto problem = family.at(mu);
  if (!problem) return false;
  const Index n = x.size();
  check_shape(*problem, n, piece);
  if (!problem->equations(x, lambda, piece, terms.F, terms.A, terms.b)) return false;
  terms.J.resize(n, n + 1);
  terms.J.leftCols(n) = terms.A;
  terms.J.col(n) = terms.b;
  return all_finite(terms.F) && all_finite(terms.J);
}

std::optional<Vector> second_along(const Family& family, const Vector& x, double lambda, double mu,
                                   const Piece& piece, const Vector& w, const Vector& V,
                                   Exactness exactness) {
  const Index n = x.size();
  const double largest = V.lpNorm<Eigen::Infinity>();
  if (!(largest > 0)) return Vector::Zero(n + 1);
  const auto problem = family.at(mu);
  if (!problem) return std::nullopt;
  check_shape(*problem, n, piece);
  if (Vector value; problem->second_along(x, lambda, piece, w, V, value))
    return all_finite(value) ? std::optional<Vector>(std::move(value)) : std::nullopt;
  Vector there, F, by_lambda;
  Matrix by_x;
  const auto weighted = [&](double t) -> std::optional<Vector> {
    there = x + t * V.head(n);
    if (!problem->equations(there, lambda + t * V[n], piece, F, by_x, by_lambda) || !all_finite(F))
      return std::nullopt;
    Vector value(n + 1);
    value.head(n).noalias() = by_x.transpose() * w;
    value[n] = by_lambda.dot(w);
    return all_finite(value) ? std::optional<Vector>(std::move(value)) : std::nullopt;
  };
  if (exactness == Exactness::exact)
    return derivative_at_zero(weighted, directional_step / largest);
  const double t = rough_step / largest;
  const auto above = weighted(t), below = weighted(-t);
  if (!above || !below) return std::nullopt;
  return Vector((*above - *below) / (2 * t));
}

std::optional<Vector> derivative_by_parameter(const std::function<std::optional<Vector>(double)>& f,
                                              double mu, double step, Exactness exactness,
                                              double& error) {
  const auto size_of = [](const Vector& value) {
    return std::max(1.0, value.lpNorm<Eigen::Infinity>());
  };
  if (exactness == Exactness::rough) {
    const auto rough = rough_grid_derivative(f, mu, wider * step);
    if (rough && rough->doubt <= small_share * size_of(rough->value)) return rough->value;
  }
  std::optional<GridDerivative> best;
  for (double h = wider * step; h >= narrowest * step; h /= wider) {
    auto found = grid_derivative(f, mu, h, one_place);
    if (!found) continue;  // a grid that reaches less far may have all of its places
    const double left = found->expected_error;
    if (!best || left < best->expected_error) best = std::move(found);
    if (left <= one_place * size_of(best->value)) break;
  }
  if (!best) return std::nullopt;
  error = best->expected_error / size_of(best->value);
  return best->value;
}

}  // namespace springfold::continuation
