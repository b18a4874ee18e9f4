// Where a sheet shows points of space: orthographic, or in perspective. Private to drawing.
#pragma once

#include "painter.hpp"

namespace springfold::drawing {

/// Where a point is seen, from the middle of the panel, y up [length].
Place seen_at(const Sheet& sheet, const model::Vec3<double>& p);

/// How that place moves with the point: of a small step `way` from it.
Place seen_step(const Sheet& sheet, const model::Vec3<double>& p, const model::Vec3<double>& way);

/// The direction in which the eye is seen from a point, not a unit vector.
model::Vec3<double> towards_eye(const Sheet& sheet, const model::Vec3<double>& p);

}  // namespace springfold::drawing
