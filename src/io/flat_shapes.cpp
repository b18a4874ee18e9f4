#include "flat_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace springfold::io {
namespace {

using model::TaskSpace;

/// Heights that differ by less, of the largest one, are the same: rounding of frames that are turned.
constexpr double same_height = 1e-12;

bool is_plane_mechanism(const model::Mechanism& mechanism) {
  return std::all_of(mechanism.bodies.begin(), mechanism.bodies.end(), [](const model::Body& body) {
    return body.task_space == TaskSpace::xy || body.task_space == TaskSpace::planar;
  });
}

/// Height of a point above the plane in which the mechanism moves: always the same, whatever the joints do.
double height_of(const model::Mechanism& mechanism, const model::Anchor& anchor) {
  if (anchor.chain < 0) return anchor.at.z();
  const model::Chain& chain = mechanism.chains[static_cast<std::size_t>(anchor.chain)];
  const model::ChainPoint& point = chain.points[anchor.point];
  model::Pose<double> at = chain.from_attachment;
  for (std::size_t i = 0; i < point.elements_before; ++i)
    if (const auto* link = std::get_if<model::RigidLink>(&chain.elements[i]))
      at = at * link->transform;
  return (at.p + at.R * (point.at + anchor.at)).z();
}

bool lies_flat(const model::Mechanism& mechanism, const model::Shape& shape) {
  std::vector<double> heights;
  for (const model::Anchor& point : shape.points) heights.push_back(height_of(mechanism, point));
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  return *high - *low <= same_height * std::max(std::abs(*low), std::abs(*high));
}

constexpr const char* flat_fold =
    "its points stay in one plane, in which the whole mechanism moves: the angle of the fold is 0, "
    "pi or 2 pi and has no "
    "rate there, need \"angle\", or bodies in space (\"xyz\", \"spatial\")";

}  // namespace

void check_flat_folds(const MechanismDraft& draft, const model::Mechanism& mechanism,
                      const std::string& when, Problems& problems) {
  if (!is_plane_mechanism(mechanism)) return;
  for (std::size_t i = 0; i < draft.shape_springs.size(); ++i) {
    const model::Shape& shape = mechanism.shape_springs[i].shape;
    const ShapeSpringDraft& at = draft.shape_springs[i];
    if (shape.kind == model::ShapeKind::dihedral && lies_flat(mechanism, shape))
      problems.add(at.place, at.key, flat_fold, when);
  }
}

}  // namespace springfold::io
