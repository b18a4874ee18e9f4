// Special points of curves, followed in a second parameter.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "springfold/continuation/curve.hpp"
#include "springfold/continuation/options.hpp"
#include "springfold/continuation/problem.hpp"

namespace springfold::continuation {

/// F(x, lambda; mu) = 0: for every mu a problem of the same size, with the same switches.
struct Family {
  /// The problem at mu, valid until the next call; nothing where the family is not defined.
  std::function<std::optional<ProblemView>(double mu)> at{};
  double step = 0x1p-8;  ///< of differences in mu, a power of two
  /// A value between which and this mu the equations are known to be affine in mu, for all x and lambda; at least
  /// `step` away. Nothing where that is not sure. May be missing.
  std::function<std::optional<double>(double mu)> line{};
};

/// A function of the state that is zero at a point of kind `zero`; nothing outside its domain.
using StateFunction =
    std::function<std::optional<double>(const Vector& x, double lambda, double mu)>;

/// The rate of something along the tangent of a point, at a second parameter; nothing outside its domain.
using RateFunction = std::function<std::optional<double>(const CurvePoint& point, double mu)>;

/// The equations of a family in which lambda prescribes a coordinate, with that coordinate free:
///
///     E(X; mu) = p e,     X = (x, lambda)     with p the force along the coordinate, e the unit vector of its row.
///
/// Without that row they are those of the family, multiplied by any regular matrix. Where p has an extremum along the
/// curve of one mu it has a limit point in p, with all that limit points degenerate into.
struct Freed {
  /// E at mu, of n + 1 unknowns and with the family's switches, lambda without a meaning; valid until the next call.
  /// Nothing where the family is not defined. Empty: there are no such equations.
  std::function<std::optional<ProblemView>(double mu)> at{};
  /// Of the coordinate among the unknowns, and of its row; before it and behind it stands x.
  Index place = -1;
  double unit = 1;  ///< coordinate = unit * lambda
};

enum class CriticalKind {
  limit_point,   ///< dF/dx singular, dF/dlambda outside its range: F = 0, bordered function g = 0
  branch_point,  ///< dF/dx singular on a branch that the parameters keep
  surface,       ///< switching, corner: F = 0, g_j = 0
  zero,          ///< F = 0, a function of the caller = 0
};

/// A special point of the curve at one mu, where the following begins.
struct CriticalStart {
  CriticalKind kind = CriticalKind::limit_point;
  Vector x{};
  double lambda = 0, mu = 0;
  Piece piece{};          ///< of the arriving side
  Piece behind{};         ///< kind surface: of the leaving side
  Index switching = -1;   ///< kind surface: which switch is zero
  int corank = 1;         ///< kind branch_point: how many eigenvalues vanish
  StateFunction value{};  ///< kind zero
  RateFunction turns{};   ///< kind surface, a corner: of what turns back there; none: of lambda
  /// Kind limit_point: modes that vanish at the same point and along which the curve does not move, left and right
  /// ones, n x h each; hilltop_start() finds them. Empty: none.
  Matrix held_left{}, held_right{};
  /// The forms, n x h, that stay zero along a curve that keeps them. Empty: `held_right` itself, which is so where the
  /// symmetry that the modes break is orthogonal.
  Matrix held_by{};
  /// Kind branch_point: switches that are zero all along the branch, which is crossed in `piece` to one side of them.
  /// The curve ends where one of them leaves zero, and where the mode comes to its surface.
  std::vector<Index> resting{};
  /// Kind zero, where the function is the rate of the force along the curve of one mu: what is followed is the limit
  /// point of these equations instead. Kind branch_point: hilltops of the force are told too.
  Freed freed{};
  /// Of equations with a coordinate free, lambda being the force along it: the place of the coordinate in x. What is
  /// told of lambda is told of the coordinate, and the force is no part of the arc length. -1: of all others.
  Index driven = -1;
};

/// A point of a critical curve. Rates are by its arc length, in the problem's metric.
struct CriticalPoint {
  double s = 0;
  Vector x{};
  double lambda = 0, mu = 0;
  Vector dx{};
  double dlambda = 0, dmu = 0;
};

/// What happens on a critical curve.
enum class Degeneracy {
  cusp,                   ///< two limit points merge: mu turns back
  isola_centre,           ///< a closed branch shrinks to a point: mu turns back
  crossing,               ///< two branches cross: mu turns back
  hilltop,                ///< branch point on a limit point, of lambda or of the force (Freed)
  branch_points_merge,    ///< a pair of branch points is born: mu turns back
  corank_two,             ///< a second eigenvalue vanishes
  fold_meets_activation,  ///< the limit point, or the branch point, reaches a switching surface
  corner_loses_reversal,  ///< the slope of lambda behind the surface passes zero
  touches_surface,        ///< two crossings of the surface merge: mu turns back
  two_switches,           ///< another switch is zero at the same point
  bends_other_way,        ///< a symmetric branch point: supercritical before, subcritical behind
  turn,                   ///< mu turns back on a curve of zeros
  extremum,               ///< lambda is stationary along the curve
  user,                   ///< an event of the caller
};

struct CriticalHit {
  Degeneracy kind = Degeneracy::user;
  std::string name{};  ///< the caller's event, or the switch
  CriticalPoint point{};
  int tag = 0;  ///< of the caller's event
};

struct CriticalEvent {
  std::string name{};
  std::function<double(const CriticalPoint&)> value{};
  EventAction action = EventAction::record;
  bool of_place = false;  ///< the value depends on x, lambda and mu alone: it needs no rates
  /// Sign of the value on the side where the curve may be, of events that stop it; 0: both.
  int inside = 0;
  int tag = 0;  ///< the caller's, handed on to its hits
};

/// Points of a critical curve between the accepted ones, see points_between().
struct FurtherPoints {
  double spacing = 0;  ///< > 0: at the multiples of this arc length
  double most = std::numeric_limits<double>::infinity();  ///< of a stretch that has more, none
};

struct CriticalCurve {
  std::vector<CriticalPoint>
      points{};                     ///< accepted points, the start first; further points among them
  std::vector<CriticalHit> hits{};  ///< in the order of s
  StopReason stop = StopReason::bad_start;
  std::string stop_detail{};
  /// Kind branch_point: false where the second parameter does not keep the branch, so that
  /// there is no curve of branch points.
  bool kept = true;
  double left_out = 0;  ///< about so many further points were more than `most`
  int missed = 0;       ///< places of further points at which the corrector found none
};

/// Follows a special point in (lambda, mu) by `trace`, both being free, as the zero of a minimally
/// augmented system (Govaerts 2000, chapter 4). With fixed borders B, C
///
///     | dF/dx  B | | V |   | 0 |
///     |          | |   | = |   |,     G = 0  <=>  dF/dx is singular;
///     | C^T    0 | | G |   | I |
///
/// limit points solve F = 0, G = 0 for (x, lambda). Branch points of any corank k solve
///
///     F + B beta = 0,     W^T dF/dlambda = 0,     trace G = 0     for (x, lambda, beta), W of the transposed system,
///
/// where beta = 0 all along says that the parameter keeps the branch, as symmetries do.
/// Points on surfaces solve F = 0, g_j = 0. Derivatives of G need those of dF/dx along V only: the problem's own second
/// derivatives, or differences of sixth order of the exact dF/dx. They enter the matrix of Newton's method, not the
/// equations: located points are as exact as F and dF/dx.
///
/// The piece of the start holds all along: where another surface is reached the curve ends and says so. mu may turn
/// back; a caller's event ends the curve. Where one that has an inside is zero at the start, the way that leaves it
/// ends there. An event that is zero to rounding all along has no places.
/// @throws std::invalid_argument where sizes do not fit together, at the start or at another mu
/// @param growing  which way first: mu grows, or falls
CriticalCurve follow_critical(const Family& family, const CriticalStart& start, bool growing,
                              const std::vector<CriticalEvent>& events, const TraceOptions& options,
                              const std::function<bool(const CriticalPoint&)>& observer = {},
                              const FurtherPoints& further = {});

/// The special point itself to rounding, at its mu; nothing when Newton's method does not converge nearby.
std::optional<CriticalPoint> polish_critical(const Family& family, const CriticalStart& start);

/// How a special point moves with the parameter: dx/dmu and dlambda/dmu (dmu = 1), by the same equations.
/// Nothing at degenerate points, and at branch points that the parameter does not keep.
std::optional<CriticalPoint> critical_rate(const Family& family, const CriticalStart& start);

/// The limit point of a path at a branch point at which lambda turns back, a hilltop, with the other modes held: along
/// the path it is an ordinary one. Nothing where lambda does not turn back, or no other mode vanishes.
/// @param branch_point  kind branch_point, with its corank
/// @param path          the tangent of the path there
std::optional<CriticalStart> hilltop_start(const Family& family, const CriticalStart& branch_point,
                                           const Direction& path);

/// "cusp", "fold meets activation", ...
std::string_view to_string(Degeneracy kind);

/// What two points of a kind merge at, where the curve of them turns back in its parameter.
Degeneracy turn_of(CriticalKind kind);

}  // namespace springfold::continuation
