#include "counted_turns.hpp"

#include <cmath>

namespace springfold::io {
namespace {

using model::Anchor;

bool ray_stands(const Anchor& anchor) { return anchor.body == 0; }

/// Where the node is drawn.
model::Vec3<double> node_at(const model::Mechanism& mechanism, const Anchor& anchor) {
  if (ray_stands(anchor)) return anchor.at;
  model::Vec3<double> p = model::Vec3<double>::Zero();
  p.head(2) = mechanism.bodies[static_cast<std::size_t>(anchor.body - 1)].pose.head(2);
  return p;
}

/// From the moving one of both points, or from the corner, to the other: a hinge, and a slide along what it turns.
/// @param end  of the ray; becomes the point of the chain that lies there and turns with it
void add_ray(const std::string& name, const Anchor& corner, Anchor& end,
             model::Mechanism& mechanism) {
  if (ray_stands(corner) && ray_stands(end)) return;
  const bool backwards = ray_stands(end);  // chains end at bodies
  const Anchor& from = backwards ? end : corner;
  const Anchor& to = backwards ? corner : end;
  const model::Vec3<double> way = node_at(mechanism, to) - node_at(mechanism, from);
  model::Chain chain{.name = name, .from = from.body, .to = to.body};
  chain.from_attachment.p = from.at;
  chain.elements = {model::Joint{.name = "angle", .initial = std::atan2(way[1], way[0])},
                    model::Joint{.name = "length",
                                 .kind = model::JointKind::prismatic,
                                 .axis = model::Vec3<double>::UnitX(),
                                 .initial = way.norm()}};
  chain.points = {{.elements_before = backwards ? std::size_t{1} : std::size_t{2}}};
  end = {.chain = std::ssize(mechanism.chains), .point = 0};
  mechanism.chains.push_back(std::move(chain));
}

}  // namespace

void add_ray_chains(const MechanismDraft& draft, model::Mechanism& mechanism) {
  for (std::size_t i = 0; i < draft.shape_springs.size(); ++i) {
    if (!draft.shape_springs[i].shape.turns) continue;
    model::ShapeSpring& spring = mechanism.shape_springs[i];
    std::vector<Anchor>& points = spring.shape.points;
    const Anchor corner = points[1];
    add_ray(spring.name + ".first", corner, points[0], mechanism);
    add_ray(spring.name + ".last", corner, points[2], mechanism);
  }
}

}  // namespace springfold::io
