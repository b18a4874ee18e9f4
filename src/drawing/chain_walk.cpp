#include "chain_walk.hpp"

#include <algorithm>
#include <cmath>

#include "spring_state.hpp"

namespace springfold::drawing {
namespace {

using model::Joint;
using model::JointKind;
using model::JointRole;
using Pose = model::Pose<double>;

/// What a joint with several coordinates is drawn as: the role that says most.
int rank_of(JointRole role) {
  switch (role) {
    case JointRole::passive:
      return 0;
    case JointRole::compliant:
      return 1;
    case JointRole::preloaded:
      return 2;
    case JointRole::actuated:
      return 3;
  }
  return 0;
}

/// "foot" of "foot.1".
std::string common_name(const Joint& joint, bool is_composed) {
  const auto dot = joint.name.rfind('.');
  return is_composed && dot != std::string::npos ? joint.name.substr(0, dot) : joint.name;
}

class Walk {
 public:
  Walk(const statics::System& system, std::size_t number, const Posture& posture, const Pose& start,
       Scene& scene)
      : chain_{system.mechanism.chains[number]},
        slice_{system.chain_slices[number]},
        number_{static_cast<Index>(number)},
        posture_{posture},
        scene_{scene},
        frame_{start} {
    is_elastic_.assign(chain_.elements.size(), false);
    for (const model::CoupledSpring& spring : chain_.coupled_springs)
      for (const std::size_t i : spring.elements)
        is_elastic_[i] = std::get<Joint>(chain_.elements[i]).role == JointRole::compliant;
  }

  ChainFrames run() {
    here_ = add_point(scene_, frame_.p);
    note();
    for (std::size_t i = 0; i < chain_.elements.size();) i = next(i);
    frames_.end = here_;
    finish_springs();
    return std::move(frames_);
  }

 private:
  const Joint* joint_at(std::size_t i) const {
    return i < chain_.elements.size() ? std::get_if<Joint>(&chain_.elements[i]) : nullptr;
  }

  void note() {
    frames_.behind.push_back(frame_);
    frames_.points.push_back(here_);
  }

  /// Draws the element and what belongs to it. @returns the next one
  std::size_t next(std::size_t i) {
    const Joint* joint = joint_at(i);
    if (joint == nullptr) {
      frame_ = frame_ * std::get<model::RigidLink>(chain_.elements[i]).transform;
      go_to_frame(false);
      note();
      return i + 1;
    }
    if (is_elastic_[i]) return elastic(i);
    return joint->kind == JointKind::revolute ? turning(i) : slide(i);
  }

  /// A link from where the chain is to its frame; none where that is the same place for any posture.
  void go_to_frame(bool is_rail) {
    const PointId before = here_;
    here_ = add_point(scene_, frame_.p);
    scene_.links.push_back({before, here_, number_, is_rail});
  }

  double command(std::size_t i) const {
    const Index k = slice_.joint_command[joint_number(i)];
    return k < 0 ? 0 : posture_.rho[k];
  }
  double coordinate(std::size_t i) const {
    const Index k = slice_.joint_coordinate[joint_number(i)];
    return k < 0 ? 0 : posture_.z[k];
  }
  std::size_t joint_number(std::size_t element) const {
    return static_cast<std::size_t>(std::count_if(
        chain_.elements.begin(), chain_.elements.begin() + static_cast<std::ptrdiff_t>(element),
        [](const auto& e) { return std::holds_alternative<Joint>(e); }));
  }

  void move(const Joint& joint, double by) {
    if (joint.kind == JointKind::revolute)
      frame_.R = frame_.R * model::rotation_about<double>(joint.axis, by);
    else
      frame_.p += frame_.R * joint.axis * by;
  }

  /// All virtual joints of an elastic link that follow each other.
  std::size_t elastic(std::size_t i) {
    const Joint& first = *joint_at(i);
    const PointId at = here_;
    const PointId axis = add_point(scene_, frame_.p + frame_.R * first.axis);
    for (; joint_at(i) != nullptr && is_elastic_[i]; ++i) {
      move(*joint_at(i), coordinate(i));
      note();
    }
    go_to_frame(false);
    frames_.points.back() = here_;
    scene_.joints.push_back({chain_.name + "." + common_name(first, true), JointShape::elastic,
                             JointRole::compliant, at, axis, number_});
    return i;
  }

  /// Turning joints at one point: revolute, universal or spherical.
  std::size_t turning(std::size_t i) {
    JointPart part{"", JointShape::revolute, JointRole::passive, here_, 0, number_};
    const Joint& first = *joint_at(i);
    part.axis = add_point(scene_, frame_.p + frame_.R * first.axis);
    std::size_t axes = 1;
    const Joint* before = nullptr;
    for (; joint_at(i) != nullptr && joint_at(i)->kind == JointKind::revolute && !is_elastic_[i];
         ++i) {
      const Joint& joint = *joint_at(i);
      constexpr double same_axis = 1e-9;  // sine of the angle: rounding of given axes
      if (before && model::cross<double>(before->axis, joint.axis).norm() > same_axis) ++axes;
      if (rank_of(joint.role) > rank_of(part.role)) part.role = joint.role;
      add_spiral(joint, i);
      move(joint, command(i) + coordinate(i));
      note();
      before = &joint;
    }
    part.shape = axes == 1   ? JointShape::revolute
                 : axes == 2 ? JointShape::universal
                             : JointShape::spherical;
    part.name = chain_.name + "." + common_name(first, axes > 1);
    scene_.joints.push_back(part);
    return i;
  }

  void add_spiral(const Joint& joint, std::size_t i) {
    if (!joint.spring || is_nothing(*joint.spring)) return;
    const SpringState state = spring_state(*joint.spring, coordinate(i));
    for (const double threshold : thresholds_of(*joint.spring)) {
      Pose there = frame_;
      there.R = there.R * model::rotation_about<double>(joint.axis, command(i) + threshold);
      stops_.push_back({scene_.stops.size(), there.R, chain_.elements.size()});
      stops_.back().element = i + 1;
      scene_.stops.push_back({scene_.springs.size(), here_, here_, false});
    }
    const PointId before = scene_.links.empty() || scene_.links.back().chain != number_
                               ? here_
                               : scene_.links.back().from;
    spirals_.push_back(scene_.springs.size());
    scene_.springs.push_back({chain_.name + "." + joint.name, false, before, here_, here_,
                              state.is_one_sided, state.acts, state.force, state.energy});
    spiral_points_.push_back(here_);
  }

  std::size_t slide(std::size_t i) {
    const Joint& joint = *joint_at(i);
    const Pose begin = frame_;
    const PointId from = here_;
    PointId spring_from = from;
    if (joint.role == JointRole::actuated && joint.spring) {
      move(joint, command(i));
      go_to_frame(true);
      spring_from = here_;
      move(joint, coordinate(i));
    } else {
      move(joint, command(i) + coordinate(i));
    }
    const bool has_spring = joint.spring && !is_nothing(*joint.spring);
    go_to_frame(true);
    scene_.joints.push_back({chain_.name + "." + joint.name, JointShape::prismatic, joint.role,
                             here_, add_point(scene_, frame_.p + frame_.R * joint.axis), number_});
    if (has_spring) {
      const SpringState state = spring_state(*joint.spring, coordinate(i));
      for (const double threshold : thresholds_of(*joint.spring)) {
        const model::Vec3<double> axis = frame_.R * joint.axis;
        const PointId at = add_point(scene_, begin.p + axis * (command(i) + threshold));
        scene_.stops.push_back(
            {scene_.springs.size(), at, add_point(scene_, scene_.points[at] + axis), true});
      }
      scene_.springs.push_back({chain_.name + "." + joint.name, true, spring_from, spring_from,
                                here_, state.is_one_sided, state.acts, state.force, state.energy});
    }
    note();
    return i + 1;
  }

  /// Spirals end, and stops lie, in the direction of the first place behind the joint that is another.
  void finish_springs() {
    for (std::size_t k = 0; k < spirals_.size(); ++k)
      for (const LinkPart& link : scene_.links)
        if (link.chain == number_ && link.from == spiral_points_[k])
          scene_.springs[spirals_[k]].to = link.to;
    for (const PendingStop& stop : stops_) {
      StopPart& part = scene_.stops[stop.number];
      const Pose& joint = frames_.behind[stop.element];
      model::Vec3<double> ahead = model::Vec3<double>::UnitX();  // where nothing follows
      for (std::size_t i = stop.element; i < frames_.behind.size(); ++i) {
        const model::Vec3<double> way = frames_.behind[i].p - joint.p;
        if (way.isZero(0)) continue;
        ahead = joint.R.transpose() * way;
        break;
      }
      part.tip = add_point(scene_, joint.p + stop.R * ahead);
    }
  }

  struct PendingStop {
    std::size_t number = 0;
    model::Mat3<double> R{};  ///< frame behind the joint at the threshold
    std::size_t element = 0;  ///< elements up to and with the joint
  };

  const model::Chain& chain_;
  const statics::ChainSlice& slice_;
  Index number_;
  const Posture& posture_;
  Scene& scene_;
  Pose frame_;
  PointId here_ = 0;
  std::vector<bool> is_elastic_;  ///< per element
  ChainFrames frames_;
  std::vector<std::size_t> spirals_;
  std::vector<PointId> spiral_points_;
  std::vector<PendingStop> stops_;
};

}  // namespace

PointId add_point(Scene& scene, const model::Vec3<double>& p) {
  scene.points.push_back(p);
  return scene.points.size() - 1;
}

ChainFrames walk(const statics::System& system, std::size_t chain, const Posture& posture,
                 const model::Pose<double>& start, Scene& scene) {
  return Walk{system, chain, posture, start, scene}.run();
}

}  // namespace springfold::drawing
