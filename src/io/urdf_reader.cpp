// The only file that knows urdfdom. Without it there is a function that says so.
#include <algorithm>
#include <cmath>
#include <map>

#include "robot.hpp"
#include "springfold/io/import_urdf.hpp"
#include "springfold/model/mechanism.hpp"
#include "xml_places.hpp"

#if SPRINGFOLD_HAS_URDF
#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

namespace springfold::io {
namespace {

/// What urdfdom says while it reads. It writes to the terminal otherwise.
class UrdfMessages : public console_bridge::OutputHandler {
 public:
  UrdfMessages() : before_{console_bridge::getOutputHandler()} {
    console_bridge::useOutputHandler(this);
  }
  UrdfMessages(const UrdfMessages&) = delete;
  UrdfMessages& operator=(const UrdfMessages&) = delete;
  ~UrdfMessages() override { console_bridge::useOutputHandler(before_); }
  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR && error.empty()) error = text;
  }
  std::string error{};  ///< the first one: others follow from it

 private:
  console_bridge::OutputHandler* before_;
};

/// Its parser calls itself for every element within another one: so deep, at most.
constexpr int deepest_element = 1000;

bool is_too_deep(const std::string& bytes) {
  int depth = 0;
  for (std::size_t at = bytes.find('<'); at != std::string::npos; at = bytes.find('<', at + 1)) {
    if (bytes.compare(at, 4, "<!--") == 0) {
      at = std::min(bytes.find("-->", at), bytes.size());
      if (at == bytes.size()) return false;
      continue;
    }
    if (bytes.compare(at, 2, "</") == 0)
      --depth;
    else if (bytes.compare(at, 2, "<?") != 0 && bytes.compare(at, 2, "<!") != 0 &&
             ++depth > deepest_element)
      return true;
    const std::size_t end = bytes.find('>', at);
    if (end != std::string::npos && end > at && bytes[end - 1] == '/') --depth;
  }
  return false;
}

model::Vec3<double> vector_of_urdf(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

/// Rotation vector of a unit quaternion.
model::Vec3<double> turn_of_urdf(const urdf::Rotation& q) {
  const model::Vec3<double> v{q.x, q.y, q.z};
  const double sine = v.norm();
  if (sine == 0) return v;
  const double half = std::atan2(sine, q.w);
  return v * (2 * (q.w < 0 ? half - std::acos(-1.0) : half) / sine);
}

/// Elements that are read, or told of in words of their own, by the one around them.
XmlUse use_of(const std::string& around, const std::string& name) {
  struct Known {
    const char *around, *name;
    XmlUse use = XmlUse::read;
  };
  using enum XmlUse;
  static constexpr Known all[]{{"", "robot"},
                               {"robot", "link"},
                               {"robot", "joint"},
                               {"link", "inertial"},
                               {"inertial", "origin"},
                               {"inertial", "mass"},
                               {"inertial", "inertia"},
                               {"link", "visual", whole},
                               {"link", "collision", whole},
                               {"joint", "origin"},
                               {"joint", "parent"},
                               {"joint", "child"},
                               {"joint", "axis"},
                               {"joint", "limit"},
                               {"joint", "dynamics"},
                               {"joint", "mimic"},
                               {"joint", "safety_controller"}};
  for (const Known& known : all)
    if (around == known.around && name == known.name) return known.use;
  return unread;
}

class UrdfTree {
 public:
  UrdfTree(const std::string& file, Problems& problems) : place_{file, 0, 0}, problems_{problems} {}

  Robot read(const urdf::ModelInterface& model, const std::string& bytes) {
    robot_.name = model.getName();
    if (!every_link_has_one_parent(model)) return {};
    add(*model.getRoot());
    if (robot_.links.size() != model.links_.size())
      refuse("", "only " + std::to_string(robot_.links.size()) + " of " +
                     std::to_string(model.links_.size()) +
                     " links hang on the root, need a tree: joints in a circle have none");
    for (const auto& [names, count] : unread_elements(bytes, use_of))
      counts_["<" + names.second + "> in <" + names.first + ">"] = count;
    tell();
    return std::move(robot_);
  }

 private:
  void refuse(const std::string& key, const std::string& what) { problems_.add(place_, key, what); }

  /// Otherwise links would be met again on their own way.
  bool every_link_has_one_parent(const urdf::ModelInterface& model) {
    std::map<std::string, std::string> joints;  // by their links
    for (const auto& [name, joint] : model.joints_) {
      const auto [found, is_first] = joints.emplace(joint->child_link_name, name);
      if (!is_first)
        refuse("joint \"" + name + "\"",
               "leads to link \"" + found->first + "\" as joint \"" + found->second +
                   "\" does, need a tree: one joint to every link, and no joints in a circle");
    }
    return joints.size() == model.joints_.size();
  }

  /// The root and all that hang on it, level by level. @pre every link has one parent
  void add(const urdf::Link& root) {
    std::vector<std::pair<const urdf::Link*, std::size_t>> waiting{{&root, 0}};
    for (std::size_t next = 0; next < waiting.size(); ++next) {
      const auto [link, parent] = waiting[next];
      robot_.links.push_back(link_of(*link, parent));
      for (const auto& child : link->child_links) waiting.emplace_back(child.get(), next);
    }
  }

  RobotLink link_of(const urdf::Link& from, std::size_t parent) {
    RobotLink link{.name = from.name, .parent = parent};
    if (from.inertial) {
      link.mass = from.inertial->mass;
      link.com = vector_of_urdf(from.inertial->origin.position);
      put_inertia(*from.inertial, link);
      if (!(link.mass >= 0) || !std::isfinite(link.mass) || !link.com.allFinite())
        refuse("link \"" + from.name + "\"", "got a mass that is no number >= 0, need one");
    }
    if (!from.visual_array.empty()) ++counts_["shapes to be seen"];
    if (!from.collision_array.empty()) ++counts_["shapes to collide with"];
    if (from.parent_joint) put_joint(*from.parent_joint, link);
    return link;
  }

  /// The file has them in the axes of the inertial frame.
  void put_inertia(const urdf::Inertial& from, RobotLink& link) {
    const double xx = from.ixx, yy = from.iyy, zz = from.izz;
    const double xy = from.ixy, xz = from.ixz, yz = from.iyz;
    model::Mat3<double> I;
    I << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    if (I.isZero(0)) return;
    const model::Mat3<double> R = model::exp_rotation(turn_of_urdf(from.origin.rotation));
    if (!R.isIdentity(0)) {
      const model::Mat3<double> turned = R * I * R.transpose();
      I = 0.5 * (turned + turned.transpose());
    }
    std::string problem = model::problem_in_inertia(I);
    if (problem.empty() && !(link.mass > 0)) problem = "it has no mass";
    if (problem.empty())
      link.inertia = I;
    else
      robot_.left_out.push_back("left out: the moments of inertia of link \"" + link.name +
                                "\": " + problem);
  }

  void put_joint(const urdf::Joint& from, RobotLink& link) {
    const std::string key = "joint \"" + from.name + "\"";
    link.joint_name = from.name;
    const urdf::Pose& origin = from.parent_to_joint_origin_transform;
    link.shift = vector_of_urdf(origin.position);
    link.turn = turn_of_urdf(origin.rotation);
    link.axis = vector_of_urdf(from.axis);
    switch (from.type) {
      case urdf::Joint::FIXED:
        break;
      case urdf::Joint::REVOLUTE:
      case urdf::Joint::CONTINUOUS:
        link.joint = RobotJoint::revolute;
        break;
      case urdf::Joint::PRISMATIC:
        link.joint = RobotJoint::prismatic;
        break;
      default:
        refuse(key,
               "got a floating or planar joint, need revolute, continuous, prismatic or fixed");
        return;
    }
    if (!link.shift.allFinite() || !link.turn.allFinite())
      refuse(key, "got an origin that is no number, need finite ones [m, rad]");
    if (link.joint != RobotJoint::fixed && !(link.axis.allFinite() && link.axis.norm() > 0))
      refuse(key, "got an axis without a direction, need three numbers, not all zero");
    if (from.limits && link.joint != RobotJoint::fixed) ++counts_["limits of joints"];
    if (from.dynamics) ++counts_["damping and friction of joints"];
    if (from.safety) ++counts_["safety controllers"];
    if (from.mimic)
      robot_.left_out.push_back("joint \"" + from.name + "\" mimics \"" + from.mimic->joint_name +
                                "\": here it has a drive of its own");
  }

  void tell() {
    for (const auto& [what, count] : counts_)
      robot_.left_out.push_back("left out: " + what + " (" + std::to_string(count) + ")");
  }

  Place place_;
  Problems& problems_;
  Robot robot_{};
  std::map<std::string, int> counts_{};
};

}  // namespace

bool reads_urdf() { return true; }

Robot read_urdf(const std::string& bytes, const std::string& file, Problems& problems) {
  if (is_too_deep(bytes)) {
    problems.add({file, 0, 0}, "", "elements are nested too deeply, need a robot");
    return {};
  }
  UrdfMessages messages;
  const auto model = urdf::parseURDF(bytes);
  if (!model || !model->getRoot()) {
    const auto broken = broken_xml(bytes, file);  // urdfdom does not say where
    if (broken) {
      problems.add(broken->place, "", "no URDF: " + broken->what);
      return {};
    }
    problems.add({file, 0, 0}, "",
                 "no URDF: " + (messages.error.empty() ? "nothing can be read" : messages.error) +
                     ", need a robot of links and joints");
    return {};
  }
  return UrdfTree(file, problems).read(*model, bytes);
}

}  // namespace springfold::io

#else

namespace springfold::io {

bool reads_urdf() { return false; }

Robot read_urdf(const std::string&, const std::string& file, Problems& problems) {
  problems.add(
      {file, 0, 0}, "",
      "this springfold was built without urdfdom (Debian: liburdfdom-dev), need one with it");
  return {};
}

}  // namespace springfold::io

#endif
