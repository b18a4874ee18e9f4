// The statics of a mechanism, prepared for evaluation: who stands where in the vector of unknowns.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "springfold/core/types.hpp"
#include "springfold/model/closure.hpp"
#include "springfold/model/mechanism.hpp"
#include "springfold/model/point.hpp"
#include "springfold/model/shape.hpp"

namespace springfold::statics {

/// Where a chain's unknowns stand in z = (x_1, F_1, x_2, F_2, ..., u_1, u_2, ..., t_1, t_2, ...), where u are the
/// coordinates of springs in series with those of shapes.
struct ChainSlice {
  Index x = 0, x_count = 0;  ///< coordinates
  Index F = 0, F_count = 0;  ///< wrench, as many as the task space has dimensions
  Index from = -1, to = -1;  ///< first pose coordinate of the end bodies in z; -1: base
  std::vector<Index> joint_coordinate{};  ///< per joint: its unknown in z, or -1
  std::vector<Index> joint_command{};     ///< per joint: its command in rho, or -1
  std::vector<Index> z_of{};              ///< per variable of the closure: its place in z, or -1
  std::vector<Index> rho_of{};            ///< likewise: its command in rho, or -1
};

/// How a spatial body turns that can turn about one direction only: moments on it have a potential (turn_moment.hpp).
struct BodyTurn {
  model::Vec3<double> axis = model::Vec3<double>::UnitZ();
  /// Exp(phi) reference is what the body has turned from where all joints are at zero.
  model::Mat3<double> reference = model::Mat3<double>::Identity();
  /// The angle is the sum of such coordinates, each times its sign.
  struct Part {
    Index z = -1;    ///< place in z, or -1
    Index rho = -1;  ///< likewise a command
    double sign = 1;
  };
  std::vector<Part> angle{};
};

struct BodySlice {
  Index t = 0, count = 0;  ///< pose coordinates in z
  Index W = 0;             ///< the body's wrench in the stacked load vector
  std::optional<BodyTurn> turn{};
};

/// A spring on one coordinate.
struct CoordinateSpring {
  Index coordinate = 0;  ///< in z
  std::string name{};    ///< "leg_x.knee"
  model::CompiledSpring law{};
  Index first_switch = 0;  ///< its breakpoints' place in the piece, in increasing order
};

/// A spring that couples several coordinates: torques stiffness (c - free).
struct CoordinateGroup {
  std::vector<Index> coordinates{};  ///< in z
  Matrix stiffness{};                ///< symmetric
  Vector free{};
};

/// A breakpoint of a spring: the piece's entry is +1 above, -1 below.
struct Switch {
  Index coordinate = 0;  ///< in z; -1: that of a shape
  double breakpoint = 0;
  std::size_t spring = 0;  ///< number among System::springs, or among System::shapes
  bool of_shape() const { return coordinate < 0; }
};

/// A point at which something acts, and where its variables stand.
struct PointSlice {
  std::string name{};  ///< "leg.knee"; empty: not named in the case
  Index body = 0;      ///< where the way to it begins, 0: at the base
  model::CompiledPoint point{};
  std::vector<Index> z{};    ///< per variable: its unknown in z, or -1
  std::vector<Index> rho{};  ///< per variable: its command in rho, or -1
};

/// A load or weight at a point.
struct PointLoad {
  std::size_t point = 0;
  model::LoadKind kind = model::LoadKind::force;
  bool follows = false;
  Index number = -1;  ///< among the mechanism's loads, or -1: a weight
  model::Vec3<double> vector = model::Vec3<double>::Zero();
  bool about_one_axis =
      false;  ///< a moment with a potential, at a body with a BodyTurn or on a chain from it
};

/// A line spring between two points.
struct PointSpring {
  std::size_t from = 0, to = 0;
  double stiffness = 0, free = 0;
};

/// A spring of a shape, or a pressure on one.
struct PointShape {
  std::string name{};
  model::CompiledShape shape{};
  std::vector<std::size_t> points{};
  model::CompiledSpring law{};
  std::optional<model::Gas> gas{};  ///< instead of the law
  Index load = -1;                  ///< a pressure: its number among the mechanism's loads
  double pressure = 0;
  Index first_switch = 0;  ///< breakpoints of the law: their place in the piece
  /// Springs in series before the law: their coordinates in z, from `inner` on, are taken from alpha, and `offset`.
  Index inner = 0, inner_count = 0;
  double offset = 0;
  /// Angles in the plane: by how much the frame of the third point is turned against that of the
  /// first in the mechanism's guess. What they turn further, beyond whole turns, the angle counts.
  double turned = 0;
  bool is_pressure() const { return load >= 0; }
};

/// Immutable; share it between threads, give each its own Workspace.
struct System {
  model::Mechanism mechanism{};
  std::vector<model::CompiledChain> chains{};
  std::vector<ChainSlice> chain_slices{};
  std::vector<BodySlice> body_slices{};
  std::vector<CoordinateSpring> springs{};
  std::vector<CoordinateGroup> coupled{};
  std::vector<Switch> switches{};
  std::vector<PointSlice> points{};  ///< the chains' named ones first, in order
  std::vector<PointLoad> loads{};
  std::vector<PointSpring> line_springs{};
  std::vector<PointShape> shapes{};  ///< the springs in order, then the pressures
  /// A line spring or shape joins two chains, or a chain and springs in series: they do not couple through
  /// bodies alone, and sums over chains are no use.
  bool chains_coupled = false;
  Index first_inner = 0;  ///< coordinates of springs in series of shapes: from here to first_pose
  /// Closure equations that depend on the others in every assembled state, see redundancy.hpp. Of
  /// the wrenches that they leave undetermined the equilibrium takes those of smallest norm.
  Index redundant = 0;
  std::vector<std::string>
      coordinate_names{};                    ///< per entry of z; wrenches "leg.Fx", poses "tool.x"
  std::vector<bool> is_length{};             ///< per entry of z: unknown is a length, not an angle;
                                             ///< wrenches: a force, not a moment
  std::vector<bool> is_wrench{};             ///< per entry of z: a chain wrench
  std::vector<std::string> command_names{};  ///< per entry of rho: "leg_x.drive"
  std::vector<bool> command_is_length{};     ///< per entry of rho
  Vector commands{};                         ///< rho as the mechanism gives it
  Index size = 0;                            ///< of z
  Index load_size = 0;                       ///< of the stacked body wrenches
  Index first_pose = 0;                      ///< where the poses begin in z

  Index closure_count() const;  ///< number of closure equations, sum of all F_count
  Index inner_count() const { return first_pose - first_inner; }
  /// Do the chains couple through bodies alone, and does nothing else stand before the poses?
  bool is_sum_over_chains() const {
    return !chains_coupled && redundant == 0 && inner_count() == 0;
  }
};

/// Names of the pose coordinates: "x", "y", "z", "rx", "ry", "rz" of a spatial body.
std::vector<std::string> pose_names(model::TaskSpace space);

/// @pre model::problems_in(mechanism).empty()
System prepare(const model::Mechanism& mechanism);

/// The mechanism's own guess: initial coordinates, zero wrenches, body poses.
Vector guess(const System& system);

/// Segments in which the springs of state z are; at a breakpoint the upper one.
/// @param rho  commands; without them those of the system
Piece piece_at(const System& system, const Vector& z, const Vector& rho);
Piece piece_at(const System& system, const Vector& z);

/// Segment of a spring in a piece.
std::size_t segment_of(const CoordinateSpring& spring, const Piece& piece);
std::size_t segment_of(const PointShape& shape, const Piece& piece);

/// The same system with the frames of spatial bodies turned against the bodies: the rotation vector of
/// body b, from zero, is then measured against `rotations[b]` instead of the world,
///
///     R_b = Exp(phi_b) rotations[b],
///
/// so that there is no rotation at which it is singular. Other bodies' entries are not used. All that
/// is fixed in a body must be turned here.
/// @param turned  a copy of `system`; only what is fixed in the bodies is written
void turn_frames(const System& system, const std::vector<model::Mat3<double>>& rotations,
                 System& turned);

/// Everything that the equilibrium depends on besides z.
struct Inputs {
  Vector rho{};    ///< commands of the actuated joints
  Vector W{};      ///< load_size: external wrench on every body, world axes, at the body's origin
  Vector loads{};  ///< per load of the mechanism a factor; empty: all 1
};

/// Storage that evaluations reuse.
struct Workspace {
  std::vector<model::Closure<double>> closures{};
  std::vector<Vector> variables{};
  std::vector<Vector> wrenches{};
  struct Point {
    Vector variables{}, forces{};
    model::PointMotion<double> at{};
    bool is_used = false;  ///< by a load or a line spring
  };
  std::vector<Point> points{};
  struct Shape {
    Vector positions{};
    model::ShapeValue<double> at{};
    Vector slopes{};  ///< d alpha by the variables of its points, one point behind the other
  };
  Shape shape{};
  Matrix gauge{};  ///< redundant closures: A = the derivative of the gradient - gauge^T gauge
  Vector undetermined{};  ///< redundant closures: zero where they do not contradict each other
};

/// Gradient of the Lagrangian L = sum U_i - work - sum F_i . e_i (paper eq. (4), (5)):
///
///     row x_i:  U_i' - J_i^T F_i      forces in every joint
///     row F_i:  -e_i                  closure
///     row t_b:  sum F_i - W_b         balance of every body (as generalised forces of t_b)
///
/// Loads, weights, line springs and shapes of points add their generalised forces to the rows x_i and t_b.
/// Redundant closures add terms that are zero where e = 0 and the wrenches have the smallest norm.
///
/// @param piece  which smooth continuation of the springs to use
/// @returns false when the result is not finite
bool equilibrium_residual(const System& system, const Piece& piece, const Vector& z,
                          const Inputs& inputs, Workspace& work, Vector& residual);

/// The same and its derivatives: A = d residual/dz, symmetric where all loads have a potential, and
/// optionally the columns d residual/d rho (size x number of commands).
bool equilibrium_matrix(const System& system, const Piece& piece, const Vector& z,
                        const Inputs& inputs, Workspace& work, Vector& residual, Matrix& A,
                        Matrix* dR_drho = nullptr);

/// Spring energy in the state z, each spring in its own segment; line springs and shapes included.
/// @param rho  commands
double spring_energy(const System& system, const Vector& z, const Vector& rho);
/// The same with the commands that the mechanism gives.
double spring_energy(const System& system, const Vector& z);

/// Minus the work of weights and loads from the world's origin and zero angles: their potential,
/// where all of them have one.
double load_potential(const System& system, const Vector& z, const Inputs& inputs);

/// Position of a point in the state z [length].
model::Vec3<double> position_of(const System& system, std::size_t point, const Vector& z,
                                const Vector& rho);

/// Length of a line spring in the state z, and the force with which it pulls.
struct LineSpringState {
  double length = 0, force = 0;
};
LineSpringState line_spring_state(const System& system, std::size_t spring, const Vector& z,
                                  const Vector& rho);

/// d residual/d(factors) times `rates`: minus the generalised forces of the mechanism's loads, each
/// times its rate. @returns size entries
Vector load_rate(const System& system, const Vector& z, const Vector& rho, const Vector& rates);
/// The same into `rate`; `work` is storage, its contents are lost.
void put_load_rate(const System& system, const Vector& z, const Vector& rho, const Vector& rates,
                   Workspace& work, Vector& rate);

/// Adds d residual/dW times W_rate to `rate`: load_columns times W_rate, without the columns.
void add_wrench_rate(const System& system, const Vector& z, const Vector& W_rate, Vector& rate);

/// Columns d residual/dW: minus the generalised force of a unit wrench component on each body,
/// size x load_size.
Matrix load_columns(const System& system, const Vector& z);

}  // namespace springfold::statics
