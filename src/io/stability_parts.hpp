// A curve cut into parts of one stability.
#pragma once

#include <optional>
#include <vector>

#include "figure.hpp"

namespace springfold::io {

/// Stability between row i and row i + 1, one entry less than rows. The indices of ordinary rows
/// decide; at a limit or branch point itself an eigenvalue is zero and they mean little.
std::vector<Stability> stability_of_steps(const analysis::StudyResult& result,
                                          const analysis::Branch& branch);

/// How the mechanism stands on both sides of a special point, as it is passed on the way from the start of the branch:
/// rows above the start are passed upwards, those below it downwards. Nothing beyond an end of the branch.
struct Passage {
  std::optional<Stability> before{}, behind{};
};
/// @param steps  of the branch: stability_of_steps
Passage passage_at(const std::vector<Stability>& steps, const analysis::Branch& branch,
                   const analysis::Event& event);

/// Does it stand as the study holds it? @param is_load  under a dead load, otherwise driven
bool stands(Stability stability, bool is_load);

/// Does the control lose the mechanism where it turns back between two such stretches? Then it jumps.
/// @param is_load  as in stands()
bool loses_hold(analysis::EventKind kind, Stability from, Stability to, bool is_load);

/// Neither NaN nor infinite: can be drawn.
bool is_finite(const PlotPoint& at);

/// Polylines of one stability each; neighbours share the point between them. A point that is not
/// finite ends a line, so that no false line crosses the gap. @param steps  one less than points
std::vector<CurvePart> parts_of(const std::vector<PlotPoint>& points,
                                const std::vector<Stability>& steps);

}  // namespace springfold::io
