// A curve cut into its stable and unstable parts.
#pragma once

#include <utility>
#include <vector>

#include "figure.hpp"

namespace springfold::io {

/// Is the curve stable between row i and row i + 1? One entry less than rows. The index of ordinary
/// rows decides; at a limit or branch point itself an eigenvalue is zero and the index means little.
/// What is not known counts as unstable.
std::vector<bool> stability_of_steps(const analysis::StudyResult& result,
                                     const analysis::Branch& branch);

/// Neither NaN nor infinite: can be drawn.
bool is_finite(const PlotPoint& at);

/// Stable and unstable polylines; neighbours share the point between them. A point that is not
/// finite ends a line, so that no false line crosses the gap.
std::pair<std::vector<Polyline>, std::vector<Polyline>> stability_parts(
    const std::vector<PlotPoint>& points, const std::vector<bool>& step_is_stable);

}  // namespace springfold::io
