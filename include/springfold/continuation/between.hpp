// Points of a curve at even distances: as many as a table or a figure wants, whatever steps the
// engine took.
#pragma once

#include "springfold/continuation/curve.hpp"
#include "springfold/continuation/options.hpp"
#include "springfold/continuation/problem.hpp"

namespace springfold::continuation {

/// Points of a curve between the accepted ones.
struct Between {
  std::vector<CurvePoint> points{};  ///< in the order of s
  int missed = 0;  ///< places at which the corrector found none: beside singular points
};

/// The points at which the arc length s is a multiple of `spacing`, where no accepted point or kink is.
///
/// A step that the engine has accepted and looked into is a smooth piece of one curve. Between its
/// ends the curve is interpolated: by the polynomial through them and up to seven accepted points around,
/// with their tangents, where its last two orders show that it is exact; otherwise by a quintic through three
/// points, whose intervals are halved until points corrected between them show an error below 1e-13, so that
/// ten points or ten thousand on one step need the same few corrections. Every point is checked against the residual
/// tolerance, and corrected where it fails. The count of negative eigenvalues is that of the ends where
/// these agree and no special point lies between; otherwise it is counted at the point.
/// @param curve    what trace() or davidenko() returned for this problem
/// @param spacing  > 0, arc length
/// @throws std::invalid_argument where sizes do not fit together, or the spacing is not positive
Between points_between(ProblemView problem, const Curve& curve, double spacing,
                       const TraceOptions& options);

}  // namespace springfold::continuation
