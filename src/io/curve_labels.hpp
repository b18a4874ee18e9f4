// Names of curves beside the curves that they name.
#pragma once

#include <vector>

#include "label_scene.hpp"

namespace springfold::io {

/// For each curve the first one that lies on it all along, itself where there is none.
using CurveTwins = std::vector<std::size_t>;
CurveTwins twins_of(const LabelScene& scene);

/// "a, b": the labels of all curves that lie on this one; empty if an earlier one has said them.
FigureText shared_curve_label(const Figure& figure, const CurveTwins& twins, std::size_t curve);

/// Is the text too far from its point to be understood without a line?
bool needs_leader(const LabelBox& box, const PlotPoint& anchor);

/// Where nobody takes the text for that of another curve: nearer to its own than to all others, or else at a line to a
/// point of its own curve that is clear of the others. @pre the curve has points
LabelCandidate place_on_curve(const LabelScene& scene, const CurveTwins& twins, const LabelBox& box,
                              std::size_t own);

}  // namespace springfold::io
