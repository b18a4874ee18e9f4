// What a figure shows, before anything is drawn.
#pragma once

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
  driven,    ///< under the study's control only: let go, the mechanism would jump
  unstable,  ///< under the study's control, or not known
};

struct CurvePart {
  Stability stability = Stability::stable;
  Polyline line{};
};

/// One branch, cut where its stability changes and where it is not defined.
struct FigureCurve {
  FigureText label{};              ///< empty: not labelled
  std::vector<CurvePart> parts{};  ///< in the order of the branch
  int hue = 0;  ///< n: colour of the n-th branch of a diagram; 0: colours tell stability
};

/// A special point, or the start of a curve (code "start", no label).
struct FigureMark {
  std::string code{};
  std::string label{};
  PlotPoint at{};
};

struct Figure {
  std::string name{};  ///< file name without ending, unique in its folder
  FigureText title{}, x_title{}, y_title{};
  PlotPoint low{}, high{};  ///< corners of the axes
  std::vector<FigureCurve> curves{};
  std::vector<FigureMark> marks{};
  std::vector<std::pair<PlotPoint, PlotPoint>> arrows{};  ///< jumps, from the state that is left
};

/// The figures that the case asks for, otherwise one per study that has a curve. Curves whose runs
/// are not in `results` are left out. What cannot be drawn is said in `problems`.
std::vector<Figure> figures_of(const Case& the_case,
                               const std::vector<analysis::StudyResult>& results,
                               std::vector<std::string>& problems);

}  // namespace springfold::io
