// Motions in a landscape: overdamped, and with masses. Private to analysis.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "closings.hpp"
#include "descent.hpp"

namespace springfold::analysis {

/// A mass at a point that moves with the state: kinetic energy m |v|^2 / 2, v = jacobian x'.
struct MassPoint {
  double mass = 0;
  Matrix jacobian{};  ///< rows: components of the velocity; columns: the moving unknowns
  bool has_speed =
      true;  ///< one of the case; otherwise it stands for the turning of a body with others
};

/// What moves: the landscape's damping, and masses if there are any.
struct Motion {
  const Landscape& landscape;
  /// All masses in a state; empty: none, the overdamped motion.
  std::function<std::vector<MassPoint>(const Vector& x)> masses{};
  double damping_factor = 1;  ///< of the landscape's damping
  /// For every mass the second derivatives of its three coordinates by the moving unknowns. Empty: the integrator takes
  /// difference quotients in place of the Jacobian.
  std::function<std::vector<std::array<Matrix, 3>>(const Vector& x)> curvatures{};
};

struct FlowOptions {
  double relative = 1e-8, absolute = 1e-11;  ///< error of a step
  int most_steps = 20000;
  bool keep_way = false;
  std::function<bool()> goes_on{};  ///< asked now and then; false: the motion is given up
  /// Asked now and then of a motion with masses that lasts: the state of rest that it cannot leave any more with the
  /// energy that it has in all, if there is one.
  std::function<std::optional<RestState>(const Vector& x, double energy)> caught_by{};
};

struct Flow {
  enum class End {
    rest,       ///< at `state`
    swings_on,  ///< about `state`, which it cannot leave any more, for longer than steps are allowed
    runs_away,  ///< a coordinate left all bounds
    refused,    ///< some motion has no mass, or no damping
    failed,     ///< the integrator gave up, or took too many steps
  };
  End end = End::failed;
  RestState state{};
  double time = 0;          ///< until it was near rest
  double left = 0;          ///< where it swings on: energy above that of `state`
  double would_settle = 0;  ///< and the time until it settles, as its energy falls there
  double settled = 0;       ///< until all but a ten-thousandth of the energy was dissipated
  double dissipated = 0;    ///< integral of x' . damping x'
  double peak_speed = 0;    ///< with masses: largest |v| of a mass
  Vector
      peak_multipliers{};  ///< with masses: largest size of every multiplier, a component of a chain's wrench
  double closure = 0;             ///< largest gap of the closures on the way
  std::vector<Index> switched{};  ///< switches that changed side, in order
  int steps = 0;
  std::vector<std::pair<double, Vector>>
      way{};  ///< times and states of all steps, if they are wanted
};

/// Right-hand side of x' = f(x), or of (x, v)' with masses, on one piece.
struct FlowRate {
  Vector rate{};
  Vector multipliers{};
  double power = 0;  ///< dissipated
};

/// Equations of the overdamped motion on the closures e = 0, with J = de/dx and damping D,
///
///     D x' + J^T nu = -grad Pi,     J x' = -gamma e,
///
/// the last one in place of J x' = 0, so that rounding does not add up.
std::optional<FlowRate> overdamped_rate(const Motion& motion, const Vector& x, const Piece& piece);

/// d(rate)/dx, exact. @param at  as overdamped_rate gave it
std::optional<Matrix> overdamped_jacobian(const Motion& motion, const Vector& x, const Piece& piece,
                                          const FlowRate& at);

/// With masses: M v' + J^T nu = -grad Pi - D v - (terms of the masses' curved ways), likewise closed.
/// @returns v' and multipliers; nothing where a motion has no mass
std::optional<FlowRate> inertial_rate(const Motion& motion, const Vector& x, const Vector& v,
                                      const Piece& piece);

/// d(v')/d(x, v), n x 2n: exact but for the third derivatives, which are differences along v of fourth order.
/// @pre  motion.curvatures
/// @param at  as inertial_rate gave it
std::optional<Matrix> inertial_jacobian(const Motion& motion, const Vector& x, const Vector& v,
                                        const Piece& piece, const FlowRate& at);

/// Moves a state to the nearest one whose closures hold to rounding.
/// @returns the closures there; nothing where there is no such state near
std::optional<Closings> put_on_closures(const Landscape& landscape, Vector& x, const Piece& piece);

/// By CVODE: backward differentiation formulas, the exact Jacobian, states put on the closures, roots where switches
/// change sides and where a coordinate leaves all bounds.
Flow flow_by_cvode(const Motion& motion, const Vector& from, const FlowOptions& options = {});

/// Coordinates beyond this, in sizes of the mechanism or radians, have run away.
inline constexpr double flow_bound = 1e3;

}  // namespace springfold::analysis
