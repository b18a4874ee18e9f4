// Points at which the closures of all chains together lose rank. Private to analysis.
#pragma once

#include <optional>
#include <string>

#include "path_problem.hpp"
#include "springfold/continuation/curve.hpp"

namespace springfold::analysis {

/// Share below which singular values of a chain's closure count as zero, at points that are solved.
inline constexpr double same_rank = 1e-7;

/// Number of singular values above `share` times the larger of 1 and |J|. A chain without joints has a
/// closure without columns: its rank is 0.
Index rank_of(const Matrix& J, double share);

/// How far beside a point its surroundings are looked at.
inline constexpr double look_beside = 1e-2;

/// A direction that is nothing special to the closures.
Vector any_direction(Index size);

/// The closures as equations for everything but lambda are dependent at the point and beside it, so wherever the mechanism
/// goes: they ask more of the joints than these can give.
bool closures_always_depend(const PathProblem& problem, const continuation::CurvePoint& point);

/// The closures as equations for everything that moves on the path, lambda included, have a lower rank
/// here than on both sides along the tangent (without one: beside it): a kinematic singularity. A part of the wrenches is then
/// not determined by statics, and equilibria with all its values form a line that no branch follows.
/// @returns what it is, in words; nothing where the rank is that of the surroundings
std::optional<std::string> kinematic_singularity(const PathProblem& problem,
                                                 const continuation::CurvePoint& point);

/// Is a curve that ends at `end` about to meet such a point: has the closures' smallest singular value
/// fallen below a hundredth of what it is at `other`, a point far along the curve?
/// @returns so in words; nothing where it is not
std::optional<std::string> nears_kinematic_singularity(const PathProblem& problem,
                                                       const continuation::CurvePoint& end,
                                                       const continuation::CurvePoint& other);

/// Chains whose joints hardly move their end in some direction at `end`: the smallest singular value of their
/// own closure has fallen below a hundredth of what it is at `other`. Legs that are stretched out. Where there is none, the
/// same of all closures together with what is driven held: a crank at its dead centre.
struct StretchedChains {
  std::string text{};  ///< so in words
  bool is_end_of_reach =
      false;  ///< below a thousandth, and their force has grown a hundredfold: the curve goes to
              ///< infinite forces here, and there is nothing behind
};

/// @returns nothing where there is none
std::optional<StretchedChains> stretched_chains(const PathProblem& problem,
                                                const continuation::CurvePoint& end,
                                                const continuation::CurvePoint& other);

}  // namespace springfold::analysis
