#include "shape_parts.hpp"

#include <optional>

#include "chain_walk.hpp"
#include "spring_state.hpp"
#include "springfold/model/se3.hpp"
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

/// The point of the line, or of the plane, that is nearest to the first point; nothing where these are none.
std::optional<model::Vec3<double>> foot_of(const std::vector<PointId>& points, const Scene& scene) {
  using Place3 = model::Vec3<double>;
  const Place3 p = scene.points[points[0]], a = scene.points[points[1]];
  const Place3 along = scene.points[points[2]] - a;
  if (points.size() == 3) {
    const double square = along.squaredNorm();
    return square > 0 ? std::optional<Place3>(a + (p - a).dot(along) / square * along)
                      : std::nullopt;
  }
  const Place3 normal = model::cross<double>(along, Place3(scene.points[points[3]] - a));
  const double square = normal.squaredNorm();
  return square > 0 ? std::optional<Place3>(p - (p - a).dot(normal) / square * normal)
                    : std::nullopt;
}

/// A distance is a coil from the point to the nearest one of the line or plane.
void add_distance(const model::ShapeSpring& spring, const std::vector<PointId>& points,
                  const SpringState& state, Scene& scene) {
  const PointId foot = add_point(scene, foot_of(points, scene).value_or(scene.points[points[0]]));
  scene.springs.push_back({spring.name, true, points[0], points[0], foot, state.is_one_sided,
                           state.acts, state.force, state.energy});
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
    case ShapeKind::line:
    case ShapeKind::plane:
      add_distance(spring, points, state, scene);
      return add_outlines(spring.name, spring.shape, points, scene);
    case ShapeKind::area:
    case ShapeKind::volume: {
      const std::size_t first = scene.outlines.size();
      add_outlines(spring.name, spring.shape, points, scene);
      for (std::size_t i = first; i < scene.outlines.size(); ++i)
        scene.outlines[i].acts = state.acts;
      return;
    }
  }
}

}  // namespace springfold::drawing
