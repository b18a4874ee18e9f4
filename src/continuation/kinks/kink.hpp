// Where a piecewise-smooth curve meets its switching surfaces. Private to the engine.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "continuation/kinks/switch_rates.hpp"
#include "continuation/points/step.hpp"
#include "springfold/continuation/numerics.hpp"
#include "springfold/continuation/ray.hpp"

namespace springfold::continuation {

/// Switches at one point whose 2^k pieces are looked at.
inline constexpr std::size_t most_active = 12;

/// What is said of more.
inline std::string too_many_act(std::size_t count) {
  return "too many switches act at one point: " + std::to_string(count) +
         ", and the pieces of at most " + std::to_string(most_active) + " are looked at";
}

/// All ways to leave a point of the curve on which the switches `active` are zero. Every one of the
/// 2^k pieces around it is linearised, and of its two tangents those are kept that lead into it (a
/// one-sided linear complementarity problem, solved by enumeration; Cottle, Pang and Stone 1992):
///
///     | dF/dx  dF/dlambda | tau = 0,      piece_j (dg_j . tau) > 0  for all active j.
///
/// Where dg_j . tau = 0, corrected points of the piece's own curve, up to 1e-2 away, decide: if the
/// curve bends to the piece's side it is a way out, if to the other side it is none, and if it stays
/// within the surface the switch rests: both pieces beside it share this ray, and it is given once,
/// in `piece` if that is one of the two and regular. A piece that is singular here (its branch point lies
/// on the surface) is left by all its branches, see exits.hpp; none where its cone holds no direction of
/// its kernel but those that all pieces share.
///
/// The order is fixed: by pieces, counted in binary with the first active switch as the lowest
/// digit. Without active switches these are the two directions of the curve.
/// @pre active.size() <= most_active
Rays rays_at(const Walker& walker, const Vector& x, double lambda, const Piece& piece,
             const std::vector<Index>& active);

inline bool contains(const std::vector<Index>& switches, Index j) {
  return std::find(switches.begin(), switches.end(), j) != switches.end();
}

/// Are two pieces on the same sides of all surfaces but these?
bool differ_only(const Piece& a, const Piece& b, const std::vector<Index>& where);

/// The point as one of the piece on the other sides of these surfaces.
inline CurvePoint behind(CurvePoint point, std::span<const Index> crossed) {
  for (const Index j : crossed) {
    auto& side = point.piece[static_cast<std::size_t>(j)];
    side = side > 0 ? -1 : 1;
  }
  return point;
}

/// Switches that are zero at a point, within options.simultaneous.
std::vector<Index> active_switches(const Walker& walker, const Vector& x, double lambda);

/// Switches that stay zero along the whole step: the curve runs within their surfaces.
std::vector<Index> resting_switches(const Walker& walker, const CurvePoint& from,
                                    const CurvePoint& to);

/// The first switching surface that the curve meets on the step from -> to.
struct KinkSearch {
  enum class Status {
    none,        ///< the step stays in its piece
    found,       ///< `point` is on the first surface
    suspicious,  ///< a surface could not be located: take a shorter step
  };
  Status status = Status::none;
  CurvePoint point{};
  double before = 0, after = 0;  ///< step lengths that bracket it
  Index met = -1;                ///< the switch whose zero `point` is
  std::vector<Index> active{};   ///< switches that are zero there, this one among them
  bool singular = false;         ///< it is a branch point of the piece on which the curve arrives
  Index suspect = -1;            ///< the switch that asks for a shorter step
  std::vector<Index> touched{};  ///< switches that touch zero on this step without crossing it
};

/// Switches that are zero at the point of a kink, in order, with the one that is met.
std::vector<Index> active_or_met(const Walker& walker, const KinkSearch& kink);

/// Each switching function is judged by its values and slopes at both ends and by its value
/// half-way. Where these leave room for more than one zero, or for none, all its zeros on the step
/// are looked for on the curve itself, so that a surface crossed and crossed back within one step is
/// found twice. An extremum that reaches zero within the rounding of the corrected points (about
/// 1e-12) is a touch and no kink. Switches that rest are passed over.
/// @param left  switches that are zero at `from` because the curve leaves them there
KinkSearch first_kink(const Walker& walker, const CurvePoint& from, const CurvePoint& to,
                      const std::vector<Index>& left);

/// Switches that are zero at the kink, and not just near to zero there; the one that is met acts in any case.
/// @param left  those that the step leaves where it begins
std::vector<Index> acting_at(const Walker& walker, const CurvePoint& from, const KinkSearch& kink,
                             const std::vector<Index>& left);

/// Of several switches that act, those whose surfaces the curve surely meets behind the first one are left to the next
/// step: where F = 0 and g_j = 0 is known to rounding, however near it is.
void part_surfaces(const Walker& walker, const CurvePoint& from, const std::vector<Index>& left,
                   KinkSearch& kink);

/// The curve's own point on the surface of switch j near a point of it, by F = 0 and g_j = 0, with its tangent.
/// @param from  where the step begins, from which its s is counted
std::optional<CurvePoint> place_on_surface(const Walker& walker, const CurvePoint& from,
                                           const CurvePoint& near, Index j);

/// Where one switch acts the kink's point is that of F = 0, g_j = 0: lambda on a steep curve is then as exact as both
/// are, not as the place along the curve. What does not settle stays as it is.
void settle_on_surface(const Walker& walker, const CurvePoint& from, KinkSearch& kink);

/// The same at a point from which half-branches leave, which is located by the eigenvalues of other pieces.
inline constexpr double half_branch_rank = 10 * located_rank;

/// As rays_at, with the smallest ratio of singular values that counts as full rank of a piece.
/// @param along  tangent of the point's own piece, which is regular here although a branch point may be so near that
///               its equations look singular; nullptr: not known
/// @param polished   as regular_ways() has it: a start, which was not located
/// @param among      of regular pieces the ways of these alone are kept; nullptr: of all 2^k
Rays rays_around(const Walker& walker, const CurvePoint& at, const std::vector<Index>& active,
                 double full_rank, const Direction* along = nullptr, bool polished = false,
                 const std::vector<Piece>* among = nullptr);

/// A direction in which a curve of the piece leaves, whether it leads into the piece or not.
struct PieceWay {
  Direction tangent{};
  std::optional<CurvePoint>
      start{};          ///< set where the piece is singular: the curve a little further
  double accuracy = 0;  ///< of the tangent
  std::optional<CurvePoint> beyond{};  ///< as a Ray has it
};

struct PieceWays {
  std::vector<PieceWay> list{};
  bool singular =
      false;          ///< the extended Jacobian of the piece has no full rank here: list is empty
  std::string why{};  ///< set: not all of them could be found
  double conditioning = 0;  ///< of a regular piece: least ratio of pivots; 0: not known
};

/// A curve along its tangent, and back.
PieceWays both_ways(const Direction& tangent);

/// The two directions of the curve of a piece that is regular here.
/// @param full_rank  smallest ratio of pivots that counts as full rank
/// @param polished   the point solves the equations to rounding: then rows and columns of different sizes are brought
///                   to one size before it is called singular. Located points are too inexact for that
PieceWays regular_ways(const Walker& walker, const CurvePoint& at, double full_rank, bool polished);

/// What is known of the active surfaces at a point.
struct Surfaces {
  std::vector<Index> active{};
  Matrix dg_dx{};
  Vector dg_dlambda{};
  Vector g{};  ///< values of all switches; empty: not asked for
};

/// All ways of a piece that is singular here, with starts before the next switching surface. Those of
/// which the directions `known` are tangents already are not looked for if the piece's cone
/// { piece_j dg_j . t >= 0 } holds nothing else of the kernel.
PieceWays singular_ways(const Walker& walker, const CurvePoint& at, const Surfaces& surfaces,
                        const std::vector<Direction>& known);

/// Does the curve at `start`, which leaves `at` along `tangent`, lie within its piece and clear of the surfaces
/// ahead: no switch has come more than half-way to zero, and those that were zero go away from it?
bool before_next_surface(const Walker& walker, const CurvePoint& at, const Surfaces& surfaces,
                         const CurvePoint& start, const Direction& tangent);

}  // namespace springfold::continuation
