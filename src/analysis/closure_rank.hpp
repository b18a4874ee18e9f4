// Points at which the closures of all chains together lose rank. Private to analysis.
#pragma once

#include <optional>
#include <string>
#include <vector>

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

/// The closures as equations for everything but lambda are dependent at the point and beside it, so wherever the
/// mechanism goes: they ask more of the joints than these can give.
bool closures_always_depend(const PathProblem& problem, const continuation::CurvePoint& point);

/// Do closures that are redundant contradict each other at a solution of the equations? These leave open what is said
/// twice: the chains have a gap there, and it is no state of the mechanism.
bool closures_contradict(const PathProblem& problem, const continuation::CurvePoint& point);

/// The closures as equations for everything that moves on the path, lambda included, have a lower rank here than on
/// both sides along the tangent (without one: beside it): a kinematic singularity. A part of the wrenches is then not
/// determined by statics, and equilibria with all its values form a line that no branch follows.
/// @returns what it is, in words; nothing where the rank is that of the surroundings
std::optional<std::string> kinematic_singularity(const PathProblem& problem,
                                                 const continuation::CurvePoint& point);

/// The end of a curve, and what it is compared with. Both ends may be special, as the two dead centres of a crank are:
/// of each measure the largest value at the far points counts, of forces the middle one.
struct EndOfCurve {
  const continuation::CurvePoint& end;
  const continuation::CurvePoint& before;  ///< the last point that is another one
  std::vector<const continuation::CurvePoint*>
      far;  ///< points between both ends, and the other end
};

/// Is a curve about to meet such a point at its end: has the closures' smallest singular value
/// fallen below a hundredth of what it is far along the curve?
/// @returns so in words; nothing where it is not
std::optional<std::string> nears_kinematic_singularity(const PathProblem& problem,
                                                       const EndOfCurve& curve);

/// Chains whose joints hardly move their end in some direction at the end of a curve: the smallest singular value of
/// their own closure has fallen below a hundredth of what it is far along the curve. Legs that are stretched out. Where
/// there is none, the same of all closures together with what is driven held: a crank at its dead centre, or, where
/// they lose rank with what is driven let go too, panels of an origami vertex that lie flat.
struct StretchedChains {
  std::string text{};  ///< so in words
  bool is_end_of_reach =
      false;  ///< the curve goes to infinite forces here, and there is nothing behind: the value is
              ///< below a thousandth and the force has grown a hundredfold, or the force grows as
              ///< the inverse of the value
  bool has_grown = false;  ///< the former
  /// The closures lose rank together, whatever moves: a kinematic singularity. The joints move on there, in more ways
  /// than one, and the forces come back from the other infinity.
  bool moves_on = false;
};

/// What is said of a curve that ends there.
inline std::string end_of_reach(const StretchedChains& legs) {
  return (legs.moves_on ? "infinite forces: " : "end of the reach: ") + legs.text;
}

/// @returns nothing where there is none
std::optional<StretchedChains> stretched_chains(const PathProblem& problem,
                                                const EndOfCurve& curve);

}  // namespace springfold::analysis
