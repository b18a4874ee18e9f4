// Equations of a family's members, and their derivatives that only differences give.
#pragma once

#include <functional>
#include <optional>

#include "springfold/parameters/two_parameter.hpp"

namespace springfold::continuation {

/// Differences along directions move the largest entry by this much at their nearest points.
inline constexpr double directional_step = 0x1p-8;

/// The equations at one place of one member of the family.
struct BaseTerms {
  Vector F{};
  Matrix J{};  ///< [dF/dx dF/dlambda], n x (n + 1)
  Matrix A{};  ///< storage, as `b`
  Vector b{};
};

/// False outside the domain.
bool base_terms(const Family& family, const Vector& x, double lambda, double mu, const Piece& piece,
                BaseTerms& terms);

/// Rough: a few digits, at less than half of the cost.
enum class Exactness { exact, rough };

/// Of a distance; nothing outside of its domain.
using SampledFunction = std::function<std::optional<Vector>(double)>;

/// Derivative at zero by six-point differences, with shorter steps where the function bends so much that the first ones
/// do not resolve it: the orders of one step's places disagree. Nothing where f has no value at one of them.
std::optional<Vector> derivative_at_zero(const SampledFunction& f, double step,
                                         double* error = nullptr);
/// The same for the second derivative.
std::optional<Vector> second_derivative_at_zero(const SampledFunction& f, double step);

/// w^T D^2F [V, .] by (x, lambda), n + 1 entries: the problem's own, or differences of J along V.
/// @param V  n + 1 entries
std::optional<Vector> second_along(const Family& family, const Vector& x, double lambda, double mu,
                                   const Piece& piece, const Vector& w, const Vector& V,
                                   Exactness exactness = Exactness::exact);

/// Derivative by mu of what members of the family tell, nothing outside of its domain. By the grid of four times
/// `step`, since neighbouring places share more of its members, or by the first narrower one whose last orders show
/// that it is exact: no grid may reach across a place where the family jumps, bends or ends. If none shows it, the
/// least doubtful one is taken. Rough: by the four places of the wide grid around mu, where they agree.
/// @param error  what is expected to be wrong with an exact one
std::optional<Vector> derivative_by_parameter(const std::function<std::optional<Vector>(double)>& f,
                                              double mu, double step, Exactness exactness,
                                              double& error);

}  // namespace springfold::continuation
