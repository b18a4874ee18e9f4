// Solutions of F(x, lambda) = 0 at one lambda, by deflation from many starts.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "springfold/continuation/newton.hpp"

namespace springfold::continuation {

struct SearchOptions {
  Vector low{}, high{};         ///< box of the starts, n entries each, low <= high
  int starts = 64;              ///< the middle of the box, then in turn random points of the box
                                ///<   and random points beside known solutions
  std::uint64_t seed = 1;       ///< of the random starts
  double shift = 1;             ///< deflation factor 1 / r^power + shift, r: distance to a known
  double power = 2;             ///<   solution, every unknown divided by its side of the box
  int iterations = 100;         ///< of the deflated Newton method, from each start
  int maximum_solutions = 100;  ///< the search ends when it has found as many
  double same = 1e-6;           ///< solutions nearer than this (the largest entry, every unknown
                                ///<   divided by its side of the box) are one
  double switch_tolerance = 1e-10;                 ///< a switch this close to zero has no side
  NewtonOptions newton{.maximum_iterations = 50};  ///< the final, undeflated iteration
};

/// Every rule the options break, as sentences a user can act on; empty when usable.
/// @param size  number of unknowns
std::vector<std::string> problems_in(const SearchOptions& options, Index size);

/// AT LEAST these solutions exist. Nothing is proved about others: a solution that is not listed
/// may exist, inside the box or outside, however many starts were used.
struct SearchResult {
  std::vector<Vector> solutions{};   ///< new ones only, in the order of their entries
  std::vector<Piece> pieces{};       ///< one per solution
  std::vector<std::string> notes{};  ///< one per solution: what is special about it, or empty
  int starts_used = 0;
  bool limit_reached = false;  ///< ended by maximum_solutions: there may well be more
  int dead_ends = 0;           ///< searches that led nowhere; every start ends with one
  int wrong_pieces = 0;        ///< solutions of a piece that do not lie on it, not listed
};

/// Solutions of F(x, lambda) = 0 that are not in `known`, by Newton's method on
///
///     G(x) = M(x) F(x),   M(x) = prod_i (1 / |x - x_i|^power + shift),
///
/// x_i the known and the found solutions, from which it is driven away (Farrell, Birkisson, Funke 2015). Its step is
/// the step of F times a number, so that it costs nothing. It is damped by the natural monotonicity test (Deuflhard
/// 2004), and tried once more undamped. From each start the search is repeated until it leads nowhere. Each solution is
/// then brought to the residual tolerance without deflation.
///
/// Piecewise-smooth problems: iterates take the piece that the signs of their switches name
/// (semismooth Newton); a solution counts only if it lies on its piece. One with a switch at zero
/// counts, with a note. Where dF/dx is singular (at a limit or branch point) solutions are less
/// exact; a note says so.
///
/// Unknowns with a period (problem.periods()) are given within half a period from the middle of the
/// box, and are the same when they differ by periods. Double covers are given on the side of the
/// middle, and are the same with changed signs.
/// @pre `known` satisfy F = 0
/// @throws std::invalid_argument where sizes do not fit together, or problems_in(options, problem.size()) is not empty
SearchResult search_at(ProblemView problem, double lambda, const std::vector<Vector>& known,
                       const SearchOptions& options);

}  // namespace springfold::continuation
