// A mechanism in one posture as parts that can be drawn: points in space, and links, joints, springs,
// bodies and loads between them. All from the model alone.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "springfold/core/types.hpp"
#include "springfold/model/mechanism.hpp"
#include "springfold/statics/system.hpp"

namespace springfold::drawing {

/// A force and moment on a body at its origin, world axes: what a study adds to the mechanism.
struct BodyWrench {
  Index body = 1;  ///< body number
  model::Vec3<double> force = model::Vec3<double>::Zero();
  model::Vec3<double> moment = model::Vec3<double>::Zero();
  /// The study drives the body along `force` or about `moment`: a direction, not a force.
  bool is_direction = false;
};

/// The state that is drawn, in the order and units of a statics::System.
struct Posture {
  Vector z{};         ///< coordinates, chain wrenches (NaN: not known), poses
  Vector rho{};       ///< commands
  double lambda = 0;  ///< factor of loads that grow with lambda
  std::vector<BodyWrench> wrenches{};
};

/// The mechanism's own guess: initial coordinates, bodies where they are to be looked for first.
Posture guess_posture(const statics::System& system);

using PointId = std::size_t;  ///< number in Scene::points

enum class JointShape {
  revolute,
  prismatic,
  universal,
  spherical,
  elastic,  ///< virtual joints with which an elastic link gives way
  pin,      ///< the end of a chain that holds a point, not a direction
};

struct LinkPart {
  PointId from = 0, to = 0;
  Index chain = 0;
  bool is_rail = false;  ///< the way of a slide, not a body
};

struct JointPart {
  std::string name{};  ///< "leg.knee", "leg.foot" (universal, spherical); pins: empty
  JointShape shape = JointShape::revolute;
  model::JointRole role = model::JointRole::passive;
  PointId at = 0;
  PointId axis = 0;  ///< a point further along the joint's axis; not used by pins
  Index chain = 0;
};

/// What a spring between two points is drawn as, where it is no coil.
enum class Member {
  none,
  bar,
  cable,  ///< it only pulls
  strut,  ///< it only pushes
};

struct SpringPart {
  std::string name{};
  bool is_line = true;  ///< a coil from `from` to `to`; otherwise a spiral at `at`, wound from the
                        ///< direction of `from` to that of `to`
  PointId from = 0, at = 0, to = 0;
  bool is_one_sided = false;  ///< has a segment without force: acts here or not
  bool acts = true;
  double force = 0;   ///< force or torque with which it resists [force] or [moment]
  double energy = 0;  ///< [force * length]
  Member member = Member::none;
};

/// The sides of a shape on which a spring, a gas or a pressure acts: an area, a triangle of a surface,
/// the line or the triangle of the plane from which a distance is measured.
struct OutlinePart {
  std::string name{};
  std::vector<PointId> corners{};
  bool is_filled = false;  ///< an area or a surface
  bool acts = true;        ///< false: a spring that has no force here
};

/// Where a one-sided spring begins to act: a mark that the link behind the joint, or the slide, reaches.
struct StopPart {
  std::size_t spring = 0;
  PointId at = 0;   ///< the joint, or the threshold of a slide
  PointId tip = 0;  ///< further along the direction of the link there; of a slide along its axis
  bool is_slide = false;
};

struct BodyPart {
  std::string name{};
  PointId origin = 0;
  std::vector<PointId>
      corners{};  ///< attachment points of chains, springs and loads, and the origin
};

struct LoadPart {
  std::string name{};
  PointId at = 0;
  model::Vec3<double> vector = model::Vec3<double>::Zero();  ///< [force] or [moment], world axes
  bool is_moment = false;
  bool is_direction = false;  ///< of a prescribed displacement
  bool is_weight = false;
};

/// A place at which the mechanism is fastened to the base.
struct BasePart {
  PointId at = 0;
  PointId towards = 0;  ///< where the mechanism goes on
};

/// The end of a chain and the place where it belongs: apart in a guess that does not close.
struct GapPart {
  PointId end = 0, attachment = 0;
  Index chain = 0;
};

struct NamedPoint {
  std::string name{};
  PointId at = 0;
};

/// Points and parts come in an order that depends on the mechanism alone, not on the posture.
struct Scene {
  std::vector<model::Vec3<double>> points{};  ///< world axes [length]
  std::vector<LinkPart> links{};
  std::vector<JointPart> joints{};
  std::vector<SpringPart> springs{};
  std::vector<OutlinePart> outlines{};
  std::vector<StopPart> stops{};
  std::vector<BodyPart> bodies{};
  std::vector<LoadPart> loads{};
  std::vector<BasePart> base{};
  std::vector<GapPart> gaps{};
  std::vector<NamedPoint> names{};
  std::vector<std::string> chains{};
  std::vector<double> chain_forces{};  ///< size of the force at each chain's end; NaN: not known
  bool is_planar = true;               ///< all bodies stay in the xy plane
};

/// @param system  prepared from the mechanism in its own units
/// @pre posture.z and posture.rho have the sizes of the system; poses and coordinates are finite
Scene scene_of(const statics::System& system, const Posture& posture);

/// The farthest that a chain's end lies from its attachment, relative to the size of the scene.
double largest_gap(const Scene& scene);

/// Diagonal of the box around all points [length]; 1 where all are one point.
double size_of(const Scene& scene);

}  // namespace springfold::drawing
