// Quadratic forms that change from cone to cone: stability where springs are at rest.
#pragma once

#include <optional>

#include "springfold/core/types.hpp"

namespace springfold {

/// Q(v) = v^T H v + sum_j jumps_j ([directions_j v]_+)^2: twice the energy of an elastic system with
/// one-sided springs that are just at rest. On each of the 2^k cones of signs of `directions` v it is an
/// ordinary quadratic form.
struct PiecewiseForm {
  Matrix H{};           ///< r x r, symmetric: where no spring acts
  Matrix directions{};  ///< k x r
  Vector jumps{};       ///< k
};

enum class Definiteness {
  positive,      ///< Q(v) > 0 for every v that is not zero (strictly copositive on each cone)
  not_positive,  ///< Q(v) < 0 for some v
  undecided,     ///< the least value is zero within rounding, or there are too many cones
};

struct FormJudgement {
  Definiteness verdict = Definiteness::undecided;
  double least =
      0;  ///< least value of Q on the unit sphere of a metric in which H has entries of about one
  Index fewest =
      0;           ///< least and largest number of negative eigenvalues of the forms of those cones
  Index most = 0;  ///< that have an interior
};

/// Q is continuously differentiable, so its least value on an ellipsoid v^T B v = 1 is taken at an
/// eigenvector of one of the 2^k forms (with respect to B). B is generic, so that no eigenvalue but zero
/// is multiple; Q itself is evaluated at every eigenvector, and the least of these values decides.
/// @param form  at most `most_cones` directions; with more the verdict is undecided
FormJudgement judge(const PiecewiseForm& form);

/// Largest number of directions whose 2^k cones are looked at.
inline constexpr Index most_cones = 12;

/// A vector v with rows v > 0, entry by entry, |v| = 1 (Gordan 1873); rows that are zero are passed over.
/// @returns nothing where there is none, or the cone is narrower than 1e-9
std::optional<Vector> inside_cone(const Matrix& rows);

/// Are the rows independent of each other, those aside that are zero? Then inside_cone finds a vector whatever their
/// signs are.
bool all_cones_have_room(const Matrix& rows);

/// Does rows v >= 0 hold only where rows v = 0 (Stiemke 1915)? Then the cone is a subspace, perhaps {0}.
bool is_subspace(const Matrix& rows);

/// min |A w - b| with w >= 0 (Lawson and Hanson 1974, chapter 23).
Vector nonnegative_least_squares(const Matrix& A, const Vector& b);

/// What a symmetric matrix with a known number of negative eigenvalues says of its form in the few
/// directions in which springs switch.
///
/// The pieces of a resting state are M_p = M + sum_j p_j jumps_j e_j e_j^T, with columns e_j of E. With the
/// compliance G = E^T M^-1 E, whose range holds all values y = E^T u that the other equations admit, the
/// piece's form with everything else at its best is y^T (G^+ + diag(p_j jumps_j)) y there, and
///
///     n_-(M) = across + n_-(G):   `across` eigenvalues are negative whatever the springs do
///
/// (Haynsworth's additivity of inertia).
struct CondensedForm {
  PiecewiseForm form{};
  Index across = 0;
};

/// @param G         k x k compliance of the springs' coordinates, of the piece `sides`
/// @param negative  negative eigenvalues of M
/// @param jumps     what the diagonal gains where a spring begins to act (side +1)
/// @param sides     +1 or -1 per spring: the piece of which G is
/// @returns nothing where the rank of G cannot be told
std::optional<CondensedForm> condensed_form(const Matrix& G, Index negative, const Vector& jumps,
                                            const Vector& sides);

}  // namespace springfold
