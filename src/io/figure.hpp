// What a figure shows, before anything is drawn.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "springfold/analysis/result.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {

using PlotPoint = std::pair<double, double>;  // in the units of the axes
using Polyline = std::vector<PlotPoint>;

/// A text of a figure. In gnuplot's markup "K_v" has a subscript; otherwise all characters stand for themselves.
struct FigureText {
  std::string text{};
  bool is_markup = false;
};

/// What a part of a curve is worth.
enum class Stability {
  stable,    ///< under the study's control and under dead load
  unknown,   ///< unstable modes are not counted: loads without potential, springs at rest
  driven,    ///< under the study's control only: let go, the mechanism would jump
  unstable,  ///< under the study's control
};

struct CurvePart {
  Stability stability = Stability::stable;
  Polyline line{};
};

/// One branch, cut where its stability changes and where it is not defined.
struct FigureCurve {
  FigureText label{};              ///< empty: not labelled
  std::vector<CurvePart> parts{};  ///< in the order of the branch
  int hue = 0;           ///< n: colour of the n-th branch of a diagram; 0: colours tell stability
  std::string colour{};  ///< "#RRGGBB": of the value of its run; empty: as `hue` says
};

/// A special point, or the start of a curve (code "start", no label).
struct FigureMark {
  std::string code{};
  std::string label{};
  PlotPoint at{};
};

/// A shaded part of the plane, behind everything else.
struct FigureRegion {
  std::string name{};  ///< as the key calls it; regions of one name have one entry
  bool is_wanted = true;
  std::vector<Polyline> parts{};  ///< closed outlines; corners may lie beyond the axes
};

/// What the colours of the runs of a sweep mean.
struct ColourBar {
  std::string title{};
  double low = 0, high = 1;
};

struct Figure {
  std::string name{};  ///< file name without ending, unique in its folder
  FigureText title{}, x_title{}, y_title{};
  PlotPoint low{}, high{};  ///< corners of the axes
  std::vector<FigureCurve> curves{};
  std::vector<FigureMark> marks{};
  std::vector<std::pair<PlotPoint, PlotPoint>> arrows{};  ///< jumps, from the state that is left
  std::vector<FigureRegion> regions{};
  PlotLook look{};
  std::vector<std::string> quantities{};  ///< several over one x: the n-th has the n-th colour
  PlotPoint least{};  ///< what lies below it on a logarithmic axis does not widen that
  /// False: its lines are no equilibria, and the key has none of them.
  bool tells_stability = true;
  bool is_of_points =
      false;  ///< its lines are critical points: they tell whether another mode is unstable
  std::optional<ColourBar> bar{};  ///< none: the curves' labels say enough
};

/// The figures that the case asks for, otherwise one per study that has a curve. Curves whose runs
/// are not in `results` are left out. What cannot be drawn is said in `problems`.
std::vector<Figure> figures_of(const Case& the_case,
                               const std::vector<analysis::StudyResult>& results,
                               std::vector<std::string>& problems);

/// Quantities of a figure of a study without [[plot]].
std::vector<PlotSpec> plots_of(const Case& the_case,
                               const std::vector<analysis::StudyResult>& results);

/// Sets the corners; false if there is nothing to see.
/// @param polar  the origin is seen, and angles are right
bool fit_axes(Figure& figure, bool polar);

/// Are its rows critical points over a parameter? Their lines are no equilibria of one mechanism.
bool is_curve_of_points(analysis::StudyKind kind);

/// Is it a figure of special points over a parameter, x = "parameter.Kv"?
bool is_over_parameter(const PlotSpec& spec);

/// The special points of all runs that the figure shows over this parameter, a line for each label.
/// @pre is_over_parameter(spec)
void add_sweep_points(const Case& the_case, const PlotSpec& spec,
                      const std::vector<analysis::StudyResult>& results, Figure& figure);

/// Is it a figure in the plane of two parameters, x = "parameter.a0", y = "parameter.Kv"?
bool is_in_plane(const PlotSpec& spec);

/// Thresholds of all runs and degeneracies of critical curves in the plane of two parameters: lines for the pieces of
/// the boundary, each named by what decides there, and the regions beside them. @pre is_in_plane(spec)
void add_boundary(const Case& the_case, const PlotSpec& spec,
                  const std::vector<analysis::StudyResult>& results, Figure& figure);

/// Regions reach to the edges of the axes, which are known when all else is. After fit_axes.
void fit_regions(Figure& figure);

/// Do two curves show the same line? Mirrored branches do where the figure does not show the mirror.
bool look_alike(const FigureCurve& a, const FigureCurve& b);

/// "2 · ": before the name of what is multiplied.
std::string factor_text(double factor);

/// What stands along the y axis: the text that the case gives, or quantities and units.
/// @param planned  of the result; may be null
FigureText ordinate_title(const PlotSpec& spec, const analysis::StudyResult& result,
                          const PlannedRun* planned, const UnitLabels& units);

/// The curves of one run of a figure.
struct RunCurves {
  const PlannedRun* planned = nullptr;
  std::size_t first = 0, count = 0;
  bool is_named = false;  ///< by a label of the figure itself
};

/// Shades what lies below the first critical load, from lambda at the start on: loads that the path from the start
/// reaches without the loss that the study looks for. Of runs of kind critical_load; others are left out.
/// @param runs  whose curves the figure has, lambda over the parameter
void shade_held_loads(const std::vector<RunCurves>& runs, const PlotSpec& spec,
                      const std::vector<analysis::StudyResult>& results, Figure& figure);

/// Colour of a value between the smallest (0) and the largest (1), "#RRGGBB".
std::string sweep_colour(double part);

/// Gives the runs of one study, three or more, colours by the value that it varies; of several values by the first that
/// differs in all runs, or where none does by the runs' numbers. Where they are many, numbers of runs stand for labels
/// that the figure does not give itself, and a colour bar says the values.
void colour_by_value(const std::vector<RunCurves>& runs, const UnitLabels& units, Figure& figure);

}  // namespace springfold::io
