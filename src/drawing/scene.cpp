#include "springfold/drawing/scene.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "chain_walk.hpp"
#include "shape_parts.hpp"
#include "springfold/model/rotation_vector.hpp"
#include "springfold/statics/shapes.hpp"

namespace springfold::drawing {
namespace {

using Pose = model::Pose<double>;
using Vec = model::Vec3<double>;

Pose frame_of(const model::Body& body, const Vector& t) {
  Pose frame;
  frame.p = Vec(t[0], t[1], translations(body.task_space) == 3 ? t[2] : 0);
  if (body.task_space == model::TaskSpace::planar)
    frame.R = model::rotation_about<double>(Vec::UnitZ(), t[2]);
  if (body.task_space == model::TaskSpace::spatial)
    frame.R = model::exp_rotation<double>(Vec(t[3], t[4], t[5]));
  return frame;
}

/// Everything that is built while the parts are put together.
class Builder {
 public:
  Builder(const statics::System& system, const Posture& posture)
      : system_{system}, mechanism_{system.mechanism}, posture_{posture} {}

  Scene build() {
    scene_.is_planar =
        std::all_of(mechanism_.bodies.begin(), mechanism_.bodies.end(),
                    [](const model::Body& b) { return translations(b.task_space) == 2; });
    add_bodies();
    for (std::size_t i = 0; i < mechanism_.chains.size(); ++i) add_chain(i);
    add_line_springs();
    add_shapes();
    add_loads();
    add_weights();
    for (const BodyWrench& wrench : posture_.wrenches) add_wrench(wrench);
    return std::move(scene_);
  }

 private:
  Pose body_frame(Index body) const {
    return body == 0 ? Pose{} : bodies_[static_cast<std::size_t>(body - 1)];
  }

  void add_bodies() {
    for (std::size_t b = 0; b < mechanism_.bodies.size(); ++b) {
      const statics::BodySlice& slice = system_.body_slices[b];
      bodies_.push_back(frame_of(mechanism_.bodies[b], posture_.z.segment(slice.t, slice.count)));
      const PointId origin = add_point(scene_, bodies_.back().p);
      scene_.bodies.push_back({mechanism_.bodies[b].name, origin, {origin}});
    }
  }

  void add_corner(Index body, PointId at) {
    if (body > 0) scene_.bodies[static_cast<std::size_t>(body - 1)].corners.push_back(at);
  }

  void add_chain(std::size_t i) {
    const model::Chain& chain = mechanism_.chains[i];
    scene_.chains.push_back(chain.name);
    const std::size_t first_link = scene_.links.size();
    chains_.push_back(
        walk(system_, i, posture_, body_frame(chain.from) * chain.from_attachment, scene_));
    const ChainFrames& frames = chains_.back();
    const PointId begin = frames.points.front(), end = frames.end;
    const auto number = static_cast<Index>(i);
    const PointId attachment = add_point(scene_, (body_frame(chain.to) * chain.to_attachment).p);
    scene_.gaps.push_back({end, attachment, number});
    add_corner(chain.from, begin);
    add_corner(chain.to, attachment);
    const bool has_links = scene_.links.size() > first_link;
    if (chain.from == 0)
      scene_.base.push_back({begin, has_links ? scene_.links[first_link].to : end});
    if (chain.to == 0)
      scene_.base.push_back({attachment, has_links ? scene_.links.back().from : begin});
    const model::TaskSpace space = model::task_space_of(mechanism_, chain);
    const bool is_pin = space == model::TaskSpace::xy || space == model::TaskSpace::xyz;
    if (is_pin)
      scene_.joints.push_back({"", JointShape::pin, model::JointRole::passive, end, end, number});
    for (const model::ChainPoint& point : chain.points)
      if (!point.name.empty())
        scene_.names.push_back({chain.name + "." + point.name, place_of(i, point)});
    const statics::ChainSlice& slice = system_.chain_slices[i];
    scene_.chain_forces.push_back(posture_.z.segment(slice.F, translations(space)).norm());
  }

  /// The point itself, or a new one with a link to it where it lies beside the frame's origin.
  PointId place_of(std::size_t chain, const model::ChainPoint& point) {
    const ChainFrames& frames = chains_[chain];
    const PointId origin = frames.points[point.elements_before];
    if (point.at.isZero(0)) return origin;
    const PointId at =
        add_point(scene_, (frames.behind[point.elements_before] * shift(point.at)).p);
    scene_.links.push_back({origin, at, static_cast<Index>(chain), false});
    return at;
  }

  static Pose shift(const Vec& p) { return {model::Mat3<double>::Identity(), p}; }

  Pose frame_at(const model::Anchor& anchor) const {
    if (anchor.chain < 0) return body_frame(anchor.body) * shift(anchor.at);
    const auto chain = static_cast<std::size_t>(anchor.chain);
    const model::ChainPoint& point = mechanism_.chains[chain].points[anchor.point];
    return chains_[chain].behind[point.elements_before] * shift(point.at + anchor.at);
  }

  PointId add_anchor(const model::Anchor& anchor) {
    const PointId at = add_point(scene_, frame_at(anchor).p);
    if (anchor.chain < 0) add_corner(anchor.body, at);
    return at;
  }

  void add_line_springs() {
    for (std::size_t i = 0; i < mechanism_.line_springs.size(); ++i) {
      const model::LineSpring& spring = mechanism_.line_springs[i];
      const PointId from = add_anchor(spring.from), to = add_anchor(spring.to);
      const double longer = (scene_.points[to] - scene_.points[from]).norm() - spring.free;
      scene_.springs.push_back({spring.name, true, from, from, to, false, spring.stiffness > 0,
                                spring.stiffness * longer,
                                0.5 * spring.stiffness * longer * longer});
      const auto is_base = [](const model::Anchor& a) { return a.chain < 0 && a.body == 0; };
      if (is_base(spring.from)) scene_.base.push_back({from, to});
      if (is_base(spring.to)) scene_.base.push_back({to, from});
    }
  }

  std::vector<PointId> add_anchors(const model::Shape& shape) {
    std::vector<PointId> list;
    for (const model::Anchor& point : shape.points) list.push_back(add_anchor(point));
    return list;
  }

  void add_shapes() {
    for (std::size_t i = 0; i < mechanism_.shape_springs.size(); ++i) {
      const model::ShapeSpring& spring = mechanism_.shape_springs[i];
      const std::vector<PointId> points = add_anchors(spring.shape);
      const statics::ShapeState at =
          statics::shape_state(system_, i, posture_.z, {posture_.rho, {}, {}});
      add_shape_spring(spring, points,
                       {at.value, at.own, statics::series_energy(system_, i, posture_.z)}, scene_);
      const auto is_base = [](const model::Anchor& a) { return a.chain < 0 && a.body == 0; };
      const bool is_way = spring.shape.kind == model::ShapeKind::path;
      for (std::size_t k = 0; is_way && k < points.size(); ++k)
        if (is_base(spring.shape.points[k]))
          scene_.base.push_back({points[k], points[k > 0 ? k - 1 : 1]});
    }
    for (const model::Load& load : mechanism_.loads)
      if (load.kind == model::LoadKind::pressure)
        add_outlines(load.name, load.shape, add_anchors(load.shape), scene_);
  }

  void add_loads() {
    for (const model::Load& load : mechanism_.loads) {
      if (load.kind == model::LoadKind::pressure) continue;  // add_shapes
      const Pose frame = frame_at(load.on);
      const double factor = load.with_lambda ? posture_.lambda : 1;
      const Vec vector = factor * (load.follows ? Vec(frame.R * load.vector) : load.vector);
      scene_.loads.push_back(
          {load.name, add_anchor(load.on), vector, load.kind == model::LoadKind::moment});
    }
  }

  void add_weight(const Vec& at, double mass) {
    if (mass == 0 || mechanism_.gravity.isZero(0)) return;
    scene_.loads.push_back(
        {"", add_point(scene_, at), mass * mechanism_.gravity, false, false, true});
  }

  void add_weights() {
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      add_weight((bodies_[b] * shift(mechanism_.bodies[b].centre)).p, mechanism_.bodies[b].mass);
    for (std::size_t i = 0; i < mechanism_.chains.size(); ++i)
      for (const model::ChainPoint& point : mechanism_.chains[i].points)
        add_weight((chains_[i].behind[point.elements_before] * shift(point.at)).p, point.mass);
  }

  void add_wrench(const BodyWrench& wrench) {
    const PointId at = scene_.bodies[static_cast<std::size_t>(wrench.body - 1)].origin;
    // Also where they are zero: the parts are the same in all postures.
    scene_.loads.push_back({"", at, wrench.force, false, wrench.is_direction});
    scene_.loads.push_back({"", at, wrench.moment, true, wrench.is_direction});
  }

  const statics::System& system_;
  const model::Mechanism& mechanism_;
  const Posture& posture_;
  Scene scene_;
  std::vector<Pose> bodies_;
  std::vector<ChainFrames> chains_;
};

}  // namespace

Posture guess_posture(const statics::System& system) {
  Posture posture{.z = statics::guess(system), .rho = system.commands};
  for (Index i = 0; i < system.size; ++i)
    if (system.is_wrench[static_cast<std::size_t>(i)])
      posture.z[i] = std::numeric_limits<double>::quiet_NaN();
  return posture;
}

Scene scene_of(const statics::System& system, const Posture& posture) {
  assert(posture.z.size() == system.size && posture.rho.size() == system.commands.size());
  return Builder{system, posture}.build();
}

double size_of(const Scene& scene) {
  if (scene.points.empty()) return 1;
  Vec low = scene.points.front(), high = low;
  for (const LinkPart& link : scene.links)
    for (const PointId i : {link.from, link.to}) {
      low = low.cwiseMin(scene.points[i]);
      high = high.cwiseMax(scene.points[i]);
    }
  const double size = (high - low).norm();
  return size > 0 ? size : 1;
}

double largest_gap(const Scene& scene) {
  double largest = 0;
  for (const GapPart& gap : scene.gaps)
    largest = std::max(largest, (scene.points[gap.end] - scene.points[gap.attachment]).norm());
  return largest / size_of(scene);
}

}  // namespace springfold::drawing
