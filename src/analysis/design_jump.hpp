// The least change where a requirement jumps. Private to analysis.
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "design_requirements.hpp"

namespace springfold::analysis {

/// Changes are drawn back to what still meets the requirements this closely, relative.
inline constexpr double closely = 1e-14;
/// Ends that are as near to each other, relative, are the same place.
inline constexpr double alike = 1e-2;
inline bool are_alike(const Vector& a, const Vector& b) {
  return (a - b).norm() <= alike * (1 + a.norm());
}

/// The designs whose boundary is searched; all in changes u.
struct JumpProblem {
  Vector low{}, high{};  ///< bounds
  bool is_sum = false;   ///< small is the sum of the sizes; otherwise the norm
  /// Some of the requirements, all if `only` is empty, in the way in which they hold or come nearest to it; rates are
  /// those by u, as far as they are defined. Nothing where they cannot be judged.
  std::function<std::optional<Assessment>(const Vector& u, const std::vector<std::size_t>& only)>
      judge{};
  std::function<bool()> stopped{};
};

/// The largest of the inequalities of the requirements, or of those in `only`.
double most_missed(const Assessment& at, const std::vector<std::size_t>& only = {});
/// Do the requirements hold, or those in `only`?
bool holds(const std::optional<Assessment>& at, const std::vector<std::size_t>& only = {});

/// A place on the boundary, on its side that meets the requirements.
struct JumpEnd {
  Vector changes{};
  Vector inwards{};                    ///< a direction that leads into the requirements
  bool jumps = false;                  ///< next to it a requirement is missed by far
  std::vector<std::size_t> jumping{};  ///< which ones; empty: designs there cannot be judged
  /// Slope of a function that is negative where the requirements that jump hold and zero on the boundary; empty: not
  /// told.
  Vector slope{};
  bool is_known = false;  ///< the search came to a known end, and stopped
};

/// Where requirements begin to be missed on the straight way from + part * way: they hold at `good`, not at `bad`.
struct Bracket {
  Vector from{}, way{};
  double good = 0, bad = 1;
  double missed = HUGE_VAL;  ///< the largest inequality at `bad`; HUGE_VAL: not known
};

/// Bisects to this width, or to rounding, from a place that meets the requirements towards another one that does not.
Bracket bracket(const JumpProblem& problem, const Vector& from, const Vector& to, double width);
/// The same from a wider bracket.
Bracket narrowed(const JumpProblem& problem, Bracket at, double width);
/// Its place that meets the requirements.
inline Vector met_place(const Bracket& at) { return at.from + at.good * at.way; }

/// The end of the straight way from a place that meets the requirements to one that does not.
JumpEnd drawn_to(const JumpProblem& problem, const Vector& from, const Vector& to);

/// The same if something jumps there, or designs beyond it cannot be judged; nothing otherwise.
std::optional<JumpEnd> jump_between(const JumpProblem& problem, const Vector& from,
                                    const Vector& to);

/// Where requirements jump no derivative leads to the place: it is bracketed on the straight way to where the change
/// were least if there were no jump, which is the case itself unless other requirements keep from it.
/// @param changes  of a design that meets the requirements, as the case itself does not
JumpEnd drawn_back(const JumpProblem& problem, const Vector& changes);

/// Follows the boundary from a place to where the change is least. Normal and curvature are those of boundary points
/// beside the place; steps that do not make the change smaller are not taken.
/// @param known  ends of other searches
JumpEnd least_on_boundary(const JumpProblem& problem, JumpEnd from,
                          const std::vector<Vector>& known);

}  // namespace springfold::analysis
