// Springs of shapes and pressures as parts of a scene. Private to drawing.
#pragma once

#include "springfold/drawing/scene.hpp"

namespace springfold::drawing {

/// Present value of a shape, the coordinate of its law, and the energy of springs in series before that.
struct ShapeLook {
  double alpha = 0, own = 0, series_energy = 0;
};

/// A way as coils, an angle and a fold as spirals, a distance as a coil and an outline, the others as outlines.
/// @param points  of the shape
void add_shape_spring(const model::ShapeSpring& spring, const std::vector<PointId>& points,
                      const ShapeLook& look, Scene& scene);

/// The sides of an area, the triangles of a volume, the line or the plane of a distance.
void add_outlines(const std::string& name, const model::Shape& shape,
                  const std::vector<PointId>& points, Scene& scene);

}  // namespace springfold::drawing
