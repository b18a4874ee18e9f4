// Lines through the rows of a branch that bend as the branch does.
#pragma once

#include <string>
#include <vector>

#include "figure.hpp"
#include "log_line.hpp"
#include "springfold/analysis/study.hpp"

namespace springfold::io {

/// The quantity over which the rows of a study lie on smooth curves: "s"; of commands "path", if it has no corners,
/// that is for a circle and for even steps along a straight line; empty: none.
std::string smooth_along(const analysis::Study& study);

/// A row of a branch in a figure.
struct LineRow {
  PlotPoint at{};
  double s = 0;   ///< along the branch: arc length, or what smooth_along says
  int piece = 0;  ///< rows of different pieces lie on different smooth curves
  bool is_special =
      false;  ///< a located special point: what has an extremum at it there turns exactly there
};

/// For each step from row i to row i + 1 the points in between, without its ends: on the cubic whose
/// slopes at both rows are those of the parabola through the row and its neighbours of the same piece,
/// over s (Bessel's tangents; C. de Boor, A Practical Guide to Splines, chapter IV). Its error is of
/// third order in the step. Steps without a curve of their own (s does not grow, another piece, points
/// that are not finite) have none: they are straight. On logarithmic axes curves and straight steps have as
/// many points as add_points_between gives them: straight is what is straight in the values. Where values change
/// little from row to row, less than by a factor of three, the cubic is one of their logarithms.
std::vector<Polyline> points_between(const std::vector<LineRow>& rows,
                                     const AxisScales& scales = {});

/// How the axes show these rows.
AxisScales scales_of(const std::vector<LineRow>& rows, bool x_log, bool y_log);

}  // namespace springfold::io
