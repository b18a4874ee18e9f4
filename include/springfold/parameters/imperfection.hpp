// How imperfections lower critical loads: exponents and coefficients from the form of the equations at the point.
#pragma once

#include <optional>
#include <vector>

#include "springfold/continuation/curve.hpp"
#include "springfold/parameters/two_parameter.hpp"

namespace springfold::continuation {

/// The equations reduced to the k modes that vanish at a singular point (Liapunov, Schmidt), up to the terms that
/// decide the law. With x = x0 + V xi + (what the other equations ask for, orthogonal to V) and an imperfection m
///
///     g_i(xi, l, m) = a_i l + 1/2 A_i[xi, xi] + (B xi)_i l + 1/2 D_i l^2 + 1/6 G_i[xi, xi, xi] + gamma_i m + ...,
///
/// l = lambda - lambda0. Columns of V and W span the right and left null space of dF/dx and are orthonormal.
struct ReducedForm {
  Matrix V{}, W{};                  ///< n x k
  Vector by_lambda{};               ///< a, k entries; zero at branch points
  std::vector<Matrix> quadratic{};  ///< A_i, k x k each
  Matrix mixed{};                   ///< B, k x k
  Vector curvature{};               ///< D, k entries
  std::vector<Matrix> cubic{};      ///< G_i[v_j, ., .] at [i k + j], k x k each
  Direction tangent{};  ///< of the path through the point: its part along V, and dlambda
};

/// Second and third derivatives of F by differences of the exact dF/dx, errors about 1e-11.
/// @param start    a limit or branch point, located; its `kind` is not used
/// @param tangent  of the path that leads there from the unloaded state
/// @returns nothing outside the domain of F, and where no eigenvalue of dF/dx vanishes
std::optional<ReducedForm> reduced_form(const Family& family, const CriticalStart& start,
                                        const Direction& tangent);

/// Is this the form of a symmetric branch point of one mode, lambda - lambda0 = -G/(6 B) xi^2 on the branch that
/// leaves?
bool is_symmetric_point(const ReducedForm& form);

/// gamma = W^T dF/dm by six-point differences; nothing outside the domain. @param start  as above
std::optional<Vector> imperfection_part(const Family& family, const CriticalStart& start,
                                        const ReducedForm& form);

/// Where a parameter keeps a branch point to first order it may break it to second order: an imperfection of the square
/// of the parameter, whose load is - F_mm of what must act on the modes so that the branch point stays one, halved.
/// @param start  of kind branch_point, located
/// @returns n entries, f with gamma = W^T f of the imperfection (mu - mu0)^2; zero where the branch point is kept;
/// nothing where it cannot be followed
std::optional<Vector> second_order_force(const Family& family, const CriticalStart& start);

/// The load at which the imperfect structure becomes critical on its path from the unloaded state:
/// lambda = lambda0 - t coefficient |m|^exponent + higher order, where t = 1 if lambda grows on the path of the
/// perfect structure at the point, and -1 if it falls there.
struct ImperfectionLaw {
  double exponent = 1;  ///< 1, 2/3 or 1/2; twice that of the square of a parameter
  double coefficient =
      0;  ///< > 0: the critical load is lowered; < 0, a limit point behind it: not sensitive
  int sign =
      0;  ///< of m: with which it holds, where the load falls with both, with which it falls most; 0: with both
};

/// @param gamma  of a unit imperfection, k entries
/// @returns nothing where these terms do not decide: gamma = 0, no critical point of the imperfect path near
/// (the imperfection only smooths the bend), more than two modes, or forms of higher order.
///
/// One mode: exponent 1/2 where branches cross (A != 0), 2/3 where the branch is symmetric (A = 0, G != 0), in
/// closed form; 1 at limit points. Two modes: the reduced equation without its unit, a curve of two unknowns, is traced
/// from the unloaded side to its first critical point; at hilltops (a != 0) the exponent is 1.
/// Source: Koiter 1945; Thompson, Hunt 1973, chapters 3 and 5; hilltops: Thompson, Schorrock 1975.
std::optional<ImperfectionLaw> imperfection_law(const ReducedForm& form, const Vector& gamma);

/// The unit combination c, |c| = 1, of several imperfections that lowers the critical load most.
struct WorstImperfection {
  ImperfectionLaw law{};
  Vector shape{};  ///< c, as many entries as `gammas` has columns; the law holds for m > 0
};

/// @param gammas  a column for every imperfection
std::optional<WorstImperfection> worst_imperfection(const ReducedForm& form, const Matrix& gammas);

}  // namespace springfold::continuation
