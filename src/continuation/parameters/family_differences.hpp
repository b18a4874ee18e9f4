// Equations of a family's members, and their derivatives that only differences give.
#pragma once

#include <functional>
#include <optional>

#include "springfold/continuation/two_parameter.hpp"

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

/// w^T D^2F [V, .] by (x, lambda), n + 1 entries: differences of J along V. @param V  n + 1 entries
std::optional<Vector> second_along(const Family& family, const Vector& x, double lambda, double mu,
                                   const Piece& piece, const Vector& w, const Vector& V);

/// second_along() by two points.
std::optional<Vector> rough_second_along(const Family& family, const Vector& x, double lambda,
                                         double mu, const Piece& piece, const Vector& w,
                                         const Vector& V);

/// Derivative by mu of what members of the family tell, nothing outside of its domain: by the grid of `step`, or of one that is four times as wide where its last two orders show that it is as good:
/// then neighbouring places share more members of the family.
std::optional<Vector> derivative_by_parameter(const std::function<std::optional<Vector>(double)>& f,
                                              double mu, double step);

/// The same where a few digits are enough: by the four places of the wide grid around mu, or as above.
std::optional<Vector> rough_derivative_by_parameter(
    const std::function<std::optional<Vector>(double)>& f, double mu, double step);

}  // namespace springfold::continuation
