#include "shape_parts.hpp"

#include "chain_walk.hpp"
#include "spring_state.hpp"
#include "springfold/model/shape.hpp"

namespace springfold::drawing {
namespace {

using model::ShapeKind;

SpringState state_of(const model::ShapeSpring& spring, const ShapeLook& look) {
  if (spring.gas) {
    const model::ShapeEnergy gas = energy_of(*spring.gas, look.own);
    return {false, true, gas.slope, gas.energy};
  }
  SpringState state = spring_state(spring.law, look.own);
  state.energy += look.series_energy;
  return state;
}

/// From point to point; each leg has its share of the energy.
void add_way(const model::ShapeSpring& spring, const std::vector<PointId>& points, double alpha,
             const SpringState& state, Scene& scene) {
  const std::size_t legs = spring.shape.closed ? points.size() : points.size() - 1;
  for (std::size_t i = 0; i < legs; ++i) {
    const PointId from = points[i], to = points[(i + 1) % points.size()];
    const double share = alpha > 0 ? (scene.points[to] - scene.points[from]).norm() / alpha : 0;
    scene.springs.push_back({spring.name, true, from, from, to, state.is_one_sided, state.acts,
                             state.force, share * state.energy});
  }
}

}  // namespace

void add_outlines(const std::string& name, const model::Shape& shape,
                  const std::vector<PointId>& points, Scene& scene) {
  switch (shape.kind) {
    case ShapeKind::area:
      scene.outlines.push_back({name, points, true});
      return;
    case ShapeKind::volume:
      for (const auto& corners : shape.triangles)
        scene.outlines.push_back(
            {name, {points[corners[0]], points[corners[1]], points[corners[2]]}, true});
      return;
    case ShapeKind::line:
    case ShapeKind::plane:
      scene.outlines.push_back({name, {points.begin() + 1, points.end()}, false});
      return;
    case ShapeKind::path:
    case ShapeKind::angle:
    case ShapeKind::dihedral:
      return;
  }
}

void add_shape_spring(const model::ShapeSpring& spring, const std::vector<PointId>& points,
                      const ShapeLook& look, Scene& scene) {
  const SpringState state = state_of(spring, look);
  const auto add_spiral = [&](PointId from, PointId at, PointId to) {
    scene.springs.push_back({spring.name, false, from, at, to, state.is_one_sided, state.acts,
                             state.force, state.energy});
  };
  switch (spring.shape.kind) {
    case ShapeKind::path:
      return add_way(spring, points, look.alpha, state, scene);
    case ShapeKind::angle:
      return add_spiral(points[0], points[1], points[2]);
    case ShapeKind::dihedral: {
      const PointId middle =
          add_point(scene, 0.5 * (scene.points[points[1]] + scene.points[points[2]]));
      return add_spiral(points[0], middle, points[3]);
    }
    case ShapeKind::area:
    case ShapeKind::volume:
    case ShapeKind::line:
    case ShapeKind::plane:
      return add_outlines(spring.name, spring.shape, points, scene);
  }
}

}  // namespace springfold::drawing
