#include "springfold/model/mechanism.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <set>

#include "springfold/core/decompositions.hpp"
#include "springfold/model/closure.hpp"
#include "springfold/model/shape.hpp"

namespace springfold::model {
namespace {

bool is_rotation(const Mat3<double>& R) {
  return R.allFinite() && (R * R.transpose() - Mat3<double>::Identity()).norm() < 1e-9 &&
         R.determinant() > 0;
}

void check_unique(const std::string& name, const std::string& where, std::set<std::string>& names,
                  std::vector<std::string>& problems) {
  if (!name.empty() && !names.insert(name).second)
    problems.push_back(where + ": name: \"" + name + "\" is used twice");
}

/// Names are how results and messages speak of things.
void check_name(const std::string& name, const std::string& where, std::set<std::string>& names,
                std::vector<std::string>& problems) {
  if (name.empty()) problems.push_back(where + ": name: is empty, need one");
  check_unique(name, where, names, problems);
}

void check_mass(double mass, const std::string& where, std::vector<std::string>& problems) {
  if (!(mass >= 0) || !std::isfinite(mass))
    problems.push_back(where + ": mass: need a finite number >= 0");
}

void check_joint(const Joint& joint, bool coupled, const std::string& where,
                 std::vector<std::string>& problems) {
  const auto say = [&](const std::string& what) { problems.push_back(where + ": " + what); };
  if (!(std::abs(joint.axis.norm() - 1) < 1e-9)) say("axis: need a unit vector");
  if (!std::isfinite(joint.initial)) say("initial: need a finite number");
  if (!std::isfinite(joint.command)) say("value: need a finite number");
  const bool needs_spring =
      !coupled && (joint.role == JointRole::preloaded || joint.role == JointRole::compliant);
  if (needs_spring && !joint.spring) say("spring: a joint with this role needs a spring");
  if (joint.role == JointRole::passive && joint.spring)
    say("spring: a passive joint has none; give it the role preloaded");
  if (!joint.spring) return;
  for (const std::string& problem : problems_in(*joint.spring)) say("spring." + problem);
}

/// Coupled springs; says of each element whether one acts on it.
std::vector<bool> check_coupled(const Chain& chain, const std::string& where,
                                std::vector<std::string>& problems) {
  std::vector<bool> coupled(chain.elements.size(), false);
  for (const CoupledSpring& spring : chain.coupled_springs) {
    const auto say = [&](const std::string& what) {
      const std::size_t first = spring.elements.empty() ? 0 : spring.elements.front();
      problems.push_back(where + ".elements[" + std::to_string(first + 1) + "]: " + what);
    };
    const auto m = static_cast<Index>(spring.elements.size());
    if (spring.stiffness.rows() != m || spring.stiffness.cols() != m || spring.free.size() != m) {
      say("stiffness: need one row, column and free value for every joint");
      continue;
    }
    const std::string problem = problem_in(spring.stiffness, Definiteness::semidefinite);
    if (!problem.empty()) say("stiffness: " + problem);
    if (problem.empty() && spring.stiffness != spring.stiffness.transpose())
      say("stiffness: need an exactly symmetric matrix");
    if (!spring.free.allFinite()) say("free: need finite numbers");
    const Joint* first = nullptr;
    for (const std::size_t i : spring.elements) {
      const auto* joint =
          i < chain.elements.size() ? std::get_if<Joint>(&chain.elements[i]) : nullptr;
      const bool elastic = joint != nullptr && (joint->role == JointRole::compliant ||
                                                joint->role == JointRole::preloaded);
      if (!elastic || joint->spring || coupled[i])
        say("stiffness: a coupled spring acts on virtual or preloaded joints that have no other "
            "spring");
      else if (first != nullptr && first->role != joint->role)
        say("stiffness: a coupled spring acts on virtual or on preloaded joints, not on both");
      if (first == nullptr) first = joint;
      if (i < chain.elements.size()) coupled[i] = true;
    }
  }
  return coupled;
}

void check_inertia(const Mat3<double>& inertia, const std::string& where,
                   std::vector<std::string>& problems) {
  if (inertia.isZero(0)) return;
  const std::string problem = problem_in_inertia(inertia);
  if (!problem.empty()) problems.push_back(where + "inertia: " + problem);
}

void check_points(const Chain& chain, const std::string& where,
                  std::vector<std::string>& problems) {
  std::set<std::string> names;
  for (const ChainPoint& point : chain.points) {
    const std::string at = where + ".points[\"" + point.name + "\"]: ";
    if (point.elements_before > chain.elements.size())
      problems.push_back(at + "lies behind the end of the chain");
    if (!point.name.empty() && !names.insert(point.name).second)
      problems.push_back(at + "the name is used twice");
    if (!point.at.allFinite()) problems.push_back(at + "at: need finite numbers");
    if (!(point.mass >= 0) || !std::isfinite(point.mass))
      problems.push_back(at + "mass: need a finite number >= 0");
    check_inertia(point.inertia, at, problems);
  }
}

void check_chain(const Mechanism& mechanism, const Chain& chain, const std::string& where,
                 std::vector<std::string>& problems) {
  const auto say = [&](const std::string& what) { problems.push_back(where + ": " + what); };
  const auto bodies = static_cast<Index>(mechanism.bodies.size());
  const bool ends_exist =
      chain.from >= 0 && chain.from <= bodies && chain.to >= 0 && chain.to <= bodies;
  if (!ends_exist) return say("from, to: no such body");
  if (chain.from == chain.to) say("from, to: the chain must join two different bodies");
  if (chain.elements.empty()) say("elements: a chain needs at least one element");
  for (const Pose<double>* pose : {&chain.from_attachment, &chain.to_attachment})
    if (!pose->p.allFinite() || !is_rotation(pose->R)) say("attachment: need a rigid motion");

  const std::vector<bool> coupled = check_coupled(chain, where, problems);
  std::set<std::string> names;
  for (std::size_t i = 0; i < chain.elements.size(); ++i) {
    const std::string element = where + ".elements[" + std::to_string(i + 1) + "]";
    if (const auto* joint = std::get_if<Joint>(&chain.elements[i])) {
      check_joint(*joint, coupled[i], element, problems);
      check_name(joint->name, element, names, problems);
      continue;
    }
    const auto& T = std::get<RigidLink>(chain.elements[i]).transform;
    if (!T.p.allFinite() || !is_rotation(T.R))
      problems.push_back(element + ": rigid: need a rigid motion");
  }
  check_points(chain, where, problems);
}

bool is_planar(TaskSpace space) { return space == TaskSpace::xy || space == TaskSpace::planar; }

/// @param turns  the point must have axes of its own
void check_anchor(const Mechanism& mechanism, const Anchor& anchor, bool turns,
                  const std::string& where, std::vector<std::string>& problems) {
  const auto say = [&](const std::string& what) { problems.push_back(where + ": " + what); };
  if (!anchor.at.allFinite()) say("at: need finite numbers");
  if (anchor.chain >= 0) {
    const auto chain = static_cast<std::size_t>(anchor.chain);
    if (chain >= mechanism.chains.size() || anchor.point >= mechanism.chains[chain].points.size())
      say("no such point of a chain");
    return;
  }
  if (anchor.body < 0 || anchor.body > static_cast<Index>(mechanism.bodies.size()))
    return say("no such body");
  if (anchor.body == 0) return;
  const TaskSpace space = mechanism.bodies[static_cast<std::size_t>(anchor.body - 1)].task_space;
  const bool is_point = space == TaskSpace::xy || space == TaskSpace::xyz;
  if (is_point && !anchor.at.isZero(0))
    say("at: a body that is a point has no other points, need none");
  if (is_point && turns)
    say("a body that is a point does not turn: moments and loads that follow it have no meaning");
  if (space == TaskSpace::planar && anchor.at[2] != 0) say("at: need a point in the plane, z = 0");
}

void check_shape(const Mechanism& mechanism, const Shape& shape, const std::string& where,
                 std::vector<std::string>& problems) {
  for (std::size_t i = 0; i < shape.points.size(); ++i)
    check_anchor(mechanism, shape.points[i], false, where + ": of[" + std::to_string(i + 1) + "]",
                 problems);
  for (const std::string& problem : problems_in(shape)) problems.push_back(where + ": " + problem);
  const bool in_plane = std::all_of(mechanism.bodies.begin(), mechanism.bodies.end(),
                                    [](const Body& body) { return is_planar(body.task_space); });
  if (in_plane && (shape.kind == ShapeKind::volume || shape.kind == ShapeKind::plane))
    problems.push_back(where + ": shape: all bodies move in the plane: need an area or a line");
}

void check_shape_spring(const Mechanism& mechanism, const ShapeSpring& spring,
                        const std::string& where, std::vector<std::string>& problems) {
  const auto say = [&](const std::string& what) { problems.push_back(where + ": " + what); };
  check_shape(mechanism, spring.shape, where, problems);
  if (!std::isfinite(spring.offset)) say("free: need a finite number");
  if (spring.gas && !spring.before.empty()) say("gas: a gas has no springs in series with it");
  const std::size_t in_series = spring.before.size();
  for (std::size_t i = 0; i < in_series; ++i) {
    const std::string at = "series[" + std::to_string(i + 1) + "].";
    for (const std::string& problem : problems_in(spring.before[i].law)) say(at + problem);
    if (!std::isfinite(spring.before[i].initial.value_or(0))) say("initial: need a finite number");
  }
  if (!spring.gas) {
    const std::string at =
        in_series > 0 ? "series[" + std::to_string(in_series + 1) + "]." : std::string{"law."};
    for (const std::string& problem : problems_in(spring.law)) say(at + problem);
    return;
  }
  const ShapeKind kind = spring.shape.kind;
  if (kind != ShapeKind::area && kind != ShapeKind::volume)
    say("gas: need the shape \"area\" or \"volume\"");
  if (!(spring.gas->nRT >= 0) || !std::isfinite(spring.gas->nRT))
    say("gas.nRT: need a finite number >= 0");
  if (!std::isfinite(spring.gas->initial) || spring.gas->initial == 0)
    say("gas.initial: need a finite number that is not 0");
  if (!(spring.gas->exponent > 0) || !std::isfinite(spring.gas->exponent))
    say("gas.exponent: need a finite number > 0");
}

void check_pressure(const Mechanism& mechanism, const Load& load, const std::string& where,
                    std::vector<std::string>& problems) {
  check_shape(mechanism, load.shape, where, problems);
  if (!load.vector.allFinite()) problems.push_back(where + ": pressure: need a finite number");
  if (load.shape.kind != ShapeKind::area && load.shape.kind != ShapeKind::volume)
    problems.push_back(where + ": shape: a pressure acts on an area or a volume");
}

void check_load(const Mechanism& mechanism, const Load& load, const std::string& where,
                std::vector<std::string>& problems) {
  if (load.kind == LoadKind::pressure) return check_pressure(mechanism, load, where, problems);
  const auto say = [&](const std::string& what) { problems.push_back(where + ": " + what); };
  const bool moment = load.kind == LoadKind::moment;
  const std::string key = moment ? "moment" : "force";
  check_anchor(mechanism, load.on, moment || load.follows, where, problems);
  if (!load.vector.allFinite()) say(key + ": need finite numbers");
  if (load.on.chain >= 0) return;
  if (load.on.body == 0) return say("on: the base does not move, need a moving body or a point");
  if (load.on.body < 0 || load.on.body > static_cast<Index>(mechanism.bodies.size())) return;
  const Body& body = mechanism.bodies[static_cast<std::size_t>(load.on.body - 1)];
  if (!is_planar(body.task_space)) return;
  if (moment && !load.vector.head(2).isZero(0)) say("moment: in the plane it is about z");
  if (!moment && load.vector[2] != 0) say("force: in the plane it has no z component");
}

void check_line_spring(const Mechanism& mechanism, const LineSpring& spring,
                       const std::string& where, std::vector<std::string>& problems) {
  const auto say = [&](const std::string& what) { problems.push_back(where + ": " + what); };
  check_anchor(mechanism, spring.from, false, where + ": from", problems);
  check_anchor(mechanism, spring.to, false, where + ": to", problems);
  if (!(spring.stiffness >= 0) || !std::isfinite(spring.stiffness))
    say("stiffness: need a finite number >= 0");
  if (!(spring.free >= 0) || !std::isfinite(spring.free)) say("free: need a finite number >= 0");
  const bool grounded =
      spring.from.chain < 0 && spring.from.body == 0 && spring.to.chain < 0 && spring.to.body == 0;
  if (grounded) say("from, to: one of both must be able to move");
}

void check_loads(const Mechanism& mechanism, std::vector<std::string>& problems) {
  if (!mechanism.gravity.allFinite()) problems.push_back("gravity: need finite numbers");
  std::set<std::string> names;
  for (std::size_t i = 0; i < mechanism.loads.size(); ++i) {
    const std::string where = "load[" + std::to_string(i + 1) + "]";
    check_unique(mechanism.loads[i].name, where, names, problems);
    check_load(mechanism, mechanism.loads[i], where, problems);
  }
  names.clear();
  for (std::size_t i = 0; i < mechanism.line_springs.size(); ++i) {
    const std::string where = "spring[" + std::to_string(i + 1) + "]";
    check_unique(mechanism.line_springs[i].name, where, names, problems);
    check_line_spring(mechanism, mechanism.line_springs[i], where, problems);
  }
  for (std::size_t i = 0; i < mechanism.shape_springs.size(); ++i) {
    const std::string where = "shape[" + std::to_string(i + 1) + "]";
    check_unique(mechanism.shape_springs[i].name, where, names, problems);
    check_shape_spring(mechanism, mechanism.shape_springs[i], where, problems);
  }
}

}  // namespace

std::string problem_in_inertia(const Mat3<double>& inertia) {
  if (!inertia.allFinite()) return "need finite numbers";
  const double size = inertia.cwiseAbs().maxCoeff();
  constexpr double rounding = 1e-12;
  if ((inertia - inertia.transpose()).cwiseAbs().maxCoeff() > rounding * size)
    return "need a symmetric matrix";
  // The mass has second moments tr(I)/2 - I, and none of them is negative.
  const Matrix second = inertia.trace() / 2 * Matrix::Identity(3, 3) - inertia;
  if (symmetric_eigenvalues(second)[0] < -rounding * size)
    return "no body has these moments: none may be negative, and none larger than the sum of both "
           "others";
  return "";
}

std::vector<std::string> problems_in(const Mechanism& mechanism) {
  std::vector<std::string> problems;
  if (mechanism.bodies.empty()) problems.push_back("body: a mechanism needs a moving body");
  if (mechanism.chains.empty() && mechanism.line_springs.empty() && mechanism.shape_springs.empty())
    problems.push_back("chain: a mechanism needs a chain");
  std::set<std::string> names{"base"};
  for (std::size_t b = 0; b < mechanism.bodies.size(); ++b) {
    const Body& body = mechanism.bodies[b];
    const std::string where = "body[" + std::to_string(b + 1) + "]";
    check_name(body.name, where, names, problems);
    if (body.pose.size() != dimension(body.task_space) || !body.pose.allFinite())
      problems.push_back(where + ": pose: need " + std::to_string(dimension(body.task_space)) +
                         " finite numbers");
    check_mass(body.mass, where, problems);
    check_inertia(body.inertia, where + ": ", problems);
    if (!body.inertia.isZero(0) && translations(body.task_space) == dimension(body.task_space))
      problems.push_back(where + ": inertia: a point does not turn");
    if (!body.centre.allFinite()) problems.push_back(where + ": com: need finite numbers");
    if (body.mass != 0 && body.centre.allFinite())
      check_anchor(mechanism, {.body = static_cast<Index>(b + 1), .at = body.centre}, false,
                   where + ": com", problems);
  }
  names.clear();
  for (std::size_t i = 0; i < mechanism.chains.size(); ++i) {
    const Chain& chain = mechanism.chains[i];
    const std::string where = "chain[" + std::to_string(i + 1) + "]";
    check_name(chain.name, where, names, problems);
    check_chain(mechanism, chain, where, problems);
  }
  check_loads(mechanism, problems);
  return problems;
}

TaskSpace task_space_of(const Mechanism& mechanism, const Chain& chain) {
  const auto space_of = [&](Index body) {
    return mechanism.bodies[static_cast<std::size_t>(body - 1)].task_space;
  };
  if (chain.from == 0) return space_of(chain.to);
  if (chain.to == 0) return space_of(chain.from);
  const TaskSpace a = space_of(chain.from), b = space_of(chain.to);
  if (a == b) return a;
  const auto is_point = [](TaskSpace s) { return s == TaskSpace::xy || s == TaskSpace::xyz; };
  if (!is_point(a) && !is_point(b)) return TaskSpace::spatial;
  return is_planar(a) && is_planar(b) ? TaskSpace::xy : TaskSpace::xyz;
}

bool has_coordinate(const Joint& joint) {
  return joint.role != JointRole::actuated || joint.spring.has_value();
}

std::string coordinate_name(const Joint& joint) {
  return joint.role == JointRole::actuated ? joint.name + ".theta" : joint.name;
}

std::string series_name(const ShapeSpring& spring, std::size_t i) {
  return spring.name + "." + std::to_string(i + 1);
}

bool is_flat(const CompiledChain& chain) {
  const auto about_z = [](const Pose<double>& T) {
    return T.R.col(2) == Vec3<double>::UnitZ() && T.R.row(2).transpose() == Vec3<double>::UnitZ();
  };
  const auto step_is_flat = [&](const CompiledChain::JointStep& step) {
    return about_z(step.before) &&
           (!step.revolute || step.axis.cwiseAbs() == Vec3<double>::UnitZ());
  };
  return is_planar(chain.space) && (!chain.from_moves || is_planar(chain.from_space)) &&
         (!chain.to_moves || is_planar(chain.to_space)) && about_z(chain.last) &&
         about_z(chain.to_attachment) &&
         std::all_of(chain.joints.begin(), chain.joints.end(), step_is_flat);
}

CompiledChain compile(const Mechanism& mechanism, const Chain& chain) {
  CompiledChain compiled;
  compiled.space = task_space_of(mechanism, chain);
  compiled.from_moves = chain.from > 0;
  compiled.to_moves = chain.to > 0;
  const auto space_of = [&](Index body) {
    return body > 0 ? mechanism.bodies[static_cast<std::size_t>(body - 1)].task_space
                    : compiled.space;
  };
  compiled.from_space = space_of(chain.from);
  compiled.to_space = space_of(chain.to);
  compiled.to_attachment = chain.to_attachment;
  Pose<double> pending = chain.from_attachment;
  for (const Element& element : chain.elements) {
    if (const auto* link = std::get_if<RigidLink>(&element)) {
      pending = pending * link->transform;
      continue;
    }
    const auto& joint = std::get<Joint>(element);
    compiled.joints.push_back({pending, joint.axis, joint.kind == JointKind::revolute});
    pending = Pose<double>{};
  }
  compiled.last = pending;
  compiled.flat = is_flat(compiled);
  return compiled;
}

}  // namespace springfold::model
