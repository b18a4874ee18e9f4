// A curve cut into parts of one stability.
#pragma once

#include <vector>

#include "figure.hpp"

namespace springfold::io {

/// Stability between row i and row i + 1, one entry less than rows. The indices of ordinary rows
/// decide; at a limit or branch point itself an eigenvalue is zero and they mean little.
std::vector<Stability> stability_of_steps(const analysis::StudyResult& result,
                                          const analysis::Branch& branch);

/// Neither NaN nor infinite: can be drawn.
bool is_finite(const PlotPoint& at);

/// Polylines of one stability each; neighbours share the point between them. A point that is not
/// finite ends a line, so that no false line crosses the gap. @param steps  one less than points
std::vector<CurvePart> parts_of(const std::vector<PlotPoint>& points,
                                const std::vector<Stability>& steps);

}  // namespace springfold::io
