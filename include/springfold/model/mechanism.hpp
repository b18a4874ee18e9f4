// A mechanism as plain data: bodies joined by serial chains (virtual joint method, paper Section 2).
#pragma once

#include <array>
#include <numbers>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "springfold/core/types.hpp"
#include "springfold/model/coupled_spring.hpp"
#include "springfold/model/se3.hpp"
#include "springfold/model/spring_law.hpp"

namespace springfold::model {

/// Space in which the chains of a body close.
enum class TaskSpace {
  xy,       ///< a point in the plane: (x, y)
  planar,   ///< a body in the plane: (x, y, phi_z)
  xyz,      ///< a point in space: (x, y, z)
  spatial,  ///< a body in space: (x, y, z, rotation vector)
};

/// Number of pose coordinates: 2, 3, 3, 6.
constexpr Index dimension(TaskSpace space) {
  switch (space) {
    case TaskSpace::xy:
      return 2;
    case TaskSpace::planar:
    case TaskSpace::xyz:
      return 3;
    case TaskSpace::spatial:
      return 6;
  }
  return 0;
}

/// Number of pose coordinates that are lengths: 2, 2, 3, 3. They come first; the rest are angles.
constexpr Index translations(TaskSpace space) {
  return space == TaskSpace::xy || space == TaskSpace::planar ? 2 : 3;
}

enum class JointKind {
  revolute,   ///< coordinate in rad, right-handed about the axis
  prismatic,  ///< coordinate in the case's length unit, along the axis
};

enum class JointRole {
  passive,    ///< free coordinate, no spring: the paper's q
  preloaded,  ///< free coordinate with a spring: the paper's vartheta
  compliant,  ///< virtual spring of a link or drive: the paper's theta
  actuated,   ///< commanded coordinate rho; with a drive spring, rho + theta in series
};

/// A constant transformation along the chain: a rigid link.
struct RigidLink {
  Pose<double> transform{};
};

/// One revolute or prismatic joint. Universal and spherical joints are two and three of these.
struct Joint {
  std::string name{};  ///< unique in its chain
  JointKind kind = JointKind::revolute;
  Vec3<double> axis = Vec3<double>::UnitZ();  ///< unit vector in the frame before the joint
  JointRole role = JointRole::passive;
  /// preloaded, compliant: needed unless a coupled spring acts on it; actuated: drive stiffness
  std::optional<SpringLaw> spring{};
  bool spring_from_start = false;  ///< coordinates of `spring` are counted from the coordinate that
                                   ///< the joint has in the study's start pose
  double initial = 0;              ///< guess of the free coordinate (theta for a drive spring)
  double command = 0;              ///< actuated joints: rho
};

using Element = std::variant<RigidLink, Joint>;

/// A point that a chain carries: fixed in the frame behind its first `elements_before` elements.
/// Loads and springs may act there.
struct ChainPoint {
  std::string name{};                      ///< unique in its chain; empty: only its mass matters
  std::size_t elements_before = 0;         ///< 0: in the frame where the chain begins
  Vec3<double> at = Vec3<double>::Zero();  ///< in that frame [length]
  double mass = 0;                         ///< weight = mass * gravity acts there
  /// Moments of inertia about `at`, in the axes of that frame [mass length^2]; statics does not ask for them.
  Mat3<double> inertia = Mat3<double>::Zero();
};

/// An edge of the graph. Its elements lead from a frame fixed in body `from` to a frame fixed in
/// body `to`.
struct Chain {
  std::string name{};
  Index from = 0;                  ///< body number, 0 is the base
  Index to = 1;                    ///< body number
  Pose<double> from_attachment{};  ///< start of the chain in the frame of `from`
  Pose<double> to_attachment{};    ///< end of the chain in the frame of `to`
  std::vector<Element> elements{};
  std::vector<CoupledSpring> coupled_springs{};  ///< of its compliant or preloaded joints
  std::vector<ChainPoint> points{};
};

/// A moving body. `pose` is where it is to be looked for first.
struct Body {
  std::string name{};
  TaskSpace task_space = TaskSpace::spatial;
  /// (x, y), (x, y, phi), (x, y, z) or (x, y, z, rotation vector) in the base frame
  Vector pose{};
  double mass = 0;                             ///< weight = mass * gravity acts at `centre`
  Vec3<double> centre = Vec3<double>::Zero();  ///< centre of mass in the body's frame [length]
  /// Moments of inertia about the centre of mass, in the body's axes [mass length^2]; of planar bodies that about z
  /// counts alone. Of bodies that turn; statics does not ask for them.
  Mat3<double> inertia = Mat3<double>::Zero();
};

/// Where a load or a line spring acts: a point fixed in a body, or one fixed to a point of a chain.
struct Anchor {
  Index body = 0;         ///< body number, 0 is the base; without meaning if `chain` is set
  Index chain = -1;       ///< number of the chain, or -1: on a body
  std::size_t point = 0;  ///< of the chain: number in Chain::points
  Vec3<double> at = Vec3<double>::Zero();  ///< in the frame of the body or the point [length]
};

enum class ShapeKind {
  path,      ///< length of the way from point to point [length]; of two points: their distance
  angle,     ///< at the second point, from the first to the third [rad]
  dihedral,  ///< at the edge of points 2 and 3, between the half planes to points 1 and 4 [rad]
  area,      ///< of the polygon of the points in the xy plane, counter-clockwise [length^2]
  volume,    ///< within triangles seen counter-clockwise from outside [length^3]
  line,      ///< distance of the first point from the line through points 2 and 3 [length]
  plane,     ///< distance of the first point from the plane through points 2, 3 and 4 [length]
};

/// A number alpha that the positions of points give: model/shape.hpp says how and with which sign.
struct Shape {
  ShapeKind kind = ShapeKind::path;
  std::vector<Anchor> points{};
  bool closed = false;  ///< path: back from the last point to the first
  std::vector<std::array<std::size_t, 3>> triangles{};  ///< volume: their corners among `points`
  /// Angles are those within half a turn of this one [rad].
  double near = std::numbers::pi;
};

/// pressure: on the boundary of a `shape`, an area or a volume, from inside; it follows the boundary.
enum class LoadKind { force, moment, pressure };

/// A force or moment at a point, or a pressure. Without `follows` its direction is fixed in the base
/// frame, with it in the frame that the point belongs to.
struct Load {
  std::string name{};
  Anchor on{};
  LoadKind kind = LoadKind::force;
  bool follows = false;
  bool with_lambda = false;  ///< the load is lambda times the vector; otherwise constant
  /// [force] or [moment]; of a pressure its first entry, [force/length] or [force/length^2]
  Vec3<double> vector = Vec3<double>::Zero();
  Shape shape{};  ///< pressure: instead of `on`
};

/// A straight linear spring between two points, which pulls with stiffness (length - free). With
/// free = 0 it is a zero-free-length spring, whose energy is smooth at length zero too.
struct LineSpring {
  std::string name{};
  Anchor from{}, to{};
  double stiffness = 0;  ///< [force/length]
  double free = 0;       ///< length without force [length]
};

/// Gas that a shape encloses: pressure (nRT/V0) [(V0/V)^exponent - 1] against that of the
/// surroundings, which it has at V = V0. exponent = 1: isothermal, p = nRT (1/V - 1/V0).
struct Gas {
  double nRT = 0;       ///< pressure times V at V0 [force * length]
  double initial = 1;   ///< V0, not zero; of an area likewise [length^3] or [length^2]
  double exponent = 1;  ///< isentropic: ratio of the heat capacities
};

/// A spring in front of another one: the same force goes through both, their coordinates add up.
struct SeriesSpring {
  SpringLaw law{};
  std::optional<double> initial{};  ///< guess of its coordinate; none: where it has no force
};

/// A spring of a shape: its energy is a function of alpha alone, that of the law or of the gas. Springs
/// `before` it are in series with it: their coordinates u_i are unknowns of the equilibrium,
///
///     E = sum U_i(u_i) + U(alpha - offset - sum u_i).
struct ShapeSpring {
  std::string name{};
  Shape shape{};
  SpringLaw law{};           ///< coordinate alpha - offset - sum u_i, torque dU/dalpha
  std::optional<Gas> gas{};  ///< instead of `law`; areas and volumes
  std::vector<SeriesSpring> before{};
  double offset = 0;  ///< alpha at which all coordinates together are 0: the free length of a bar
};

/// Name of coordinate i of a spring with others in series, that of `law` being the last one: "rope.1", ...
std::string series_name(const ShapeSpring& spring, std::size_t i);

/// Bodies (without the base) and chains. Body number b of a chain is bodies[b - 1].
struct Mechanism {
  std::vector<Body> bodies{};
  std::vector<Chain> chains{};
  Vec3<double> gravity = Vec3<double>::Zero();  ///< [force/mass], base frame
  std::vector<Load> loads{};
  std::vector<LineSpring> line_springs{};
  std::vector<ShapeSpring> shape_springs{};
};

/// What is wrong with moments of inertia; empty when a rigid body can have them: symmetric, none negative, and each of
/// the principal ones at most the sum of both others.
std::string problem_in_inertia(const Mat3<double>& inertia);

/// Every rule that the mechanism breaks, as sentences; empty when usable.
std::vector<std::string> problems_in(const Mechanism& mechanism);

/// Task space in which the chain closes: that of its moving end. Where both ends move, a point (xy,
/// xyz) is held as a point, and the space has three dimensions if one of the ends' has.
/// @pre problems_in(mechanism).empty()
TaskSpace task_space_of(const Mechanism& mechanism, const Chain& chain);

/// Has the load a potential, whatever the mechanism does: dead forces, and loads whose point can
/// turn only about axes of one direction so that they stay constant. Moments on planar bodies are of this kind,
/// and on spatial bodies that turn about one direction (axis_of_turn.hpp); most follower forces are not.
/// @pre problems_in(mechanism).empty()
bool is_conservative(const Mechanism& mechanism, const Load& load);

/// Has the joint an unknown coordinate: everything but an actuated joint without drive spring.
bool has_coordinate(const Joint& joint);

/// Name of the joint's unknown coordinate: "knee"; "drive.theta" for the spring of an actuated one.
std::string coordinate_name(const Joint& joint);

}  // namespace springfold::model
