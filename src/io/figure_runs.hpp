// Figures over many runs: one special point per run joined to curves, stable regions, colours by a parameter.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "figure.hpp"

namespace springfold::io {

/// Where a point with these values of x and y stands in the figure.
using PlacePoint = std::function<PlotPoint(double x, double y)>;

/// Joins the special point `at` of neighbouring runs, in the order of the case. A piece ends where a run has no such
/// point and where what happens there is called otherwise: of thresholds, by what decides. Every piece has a colour and its
/// name. x and y are columns, or parameters of the runs.
void add_over_runs(Figure& figure, const Case& the_case, const PlotSpec& spec,
                   const std::string& at, const std::vector<const analysis::StudyResult*>& runs,
                   const PlacePoint& place);

/// Fills what lies between zero load and the first critical load; between the ends of its curves, where there is no
/// critical load, up to the frame. @pre the axes are fitted
void shade_stable(Figure& figure, const PlotSpec& spec,
                  const std::vector<const analysis::StudyResult*>& runs, const PlacePoint& place);

/// Colours the curves by the value of a parameter: `values` has one per curve.
void colour_by(Figure& figure, const std::string& parameter, const std::vector<double>& values);

}  // namespace springfold::io
