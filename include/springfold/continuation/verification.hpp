// What is known of a finished curve, arc by arc: a test of Newton and Kantorovich, in floating point and after the
// fact.
#pragma once

#include <string_view>
#include <vector>

#include "springfold/continuation/curve.hpp"
#include "springfold/continuation/options.hpp"
#include "springfold/continuation/problem.hpp"

namespace springfold::continuation {

std::string_view to_string(ArcEvidence evidence);

/// Cuts a curve at its points and kinks, and tests a model u(t) of each arc between them (a polynomial through up to
/// four points with their tangents). With the matrix at the middle of the arc,
///
///     M = | F_x     F_lambda |        S = first n columns of M^-1,      e = max_t |S F(u(t))|,
///         | (w tau)^T        |        Z(r) = max_{t, |v| <= r} |S (J(u(t) + v) - J(middle))|,   J = [F_x F_lambda],
///
/// the equations F = 0, tau . (u - u(t)) = 0 have for every t one solution within r of u(t), if e <= (1 - Z(r)) r and
/// Z(r) < 1 (Kantorovich 1948): the points at both ends lie on one curve, and no other comes nearer to it than r. Where
/// F is singular beside the tangent, at simple branch points, the bordered system takes its place:
///
///     M = | F_x     F_lambda   b |
///         | (w tau)^T          0 |    in (x, lambda, sigma), with the weakest singular vectors b and c.
///         | c^T                0 |
///
/// It shows that F + sigma b = 0 is one smooth surface there. The curve passes through along its own branch if sigma is
/// rounding along the model, and if the points behind and ahead, each continued by the other side's model, agree to a
/// share of the distance of the branch that crosses.
///
/// e and Z are measured, not bounded: at the ends and the middle of the arc, and at points displaced by r to both sides
/// in the direction in which M is weakest, times safety factors (numerics.hpp). Statements hold for the equations of
/// the arc's own piece. Problems in structured form are not tested: their arcs are `sampled`.
/// @param curve  as trace() returns it, of this problem
/// @returns arcs in order, without gaps on each piece
/// @throws std::invalid_argument where sizes do not fit together
std::vector<Arc> verified_arcs(ProblemView problem, const Curve& curve,
                               const TraceOptions& options);

/// Lengths of arcs, all and verified.
struct ArcLengths {
  double all = 0, verified = 0;
  double share() const { return all > 0 ? verified / all : 1; }
};
ArcLengths lengths_of(const std::vector<Arc>& arcs);

}  // namespace springfold::continuation
