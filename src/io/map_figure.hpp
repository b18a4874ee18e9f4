// Figures of maps: panels with one colour scale, contour lines, edges of the workspace, lines at
// which springs switch.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "figure.hpp"
#include "springfold/analysis/result.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {

/// Values over a grid of nodes: value of node (i, j) at j * xs.size() + i; NaN where there is none,
/// infinity where it is beyond all bounds.
struct GridField {
  std::vector<double> xs{}, ys{};
  std::vector<double> values{};
};

using Segment = std::pair<std::pair<double, double>, std::pair<double, double>>;

/// Pieces of the line on which the field has this value, by linear interpolation along the edges of
/// the cells (marching squares; a saddle is decided by the mean of its corners). Cells with a
/// corner without value have none, nor have cells whose corners differ in `pieces` (one per node, or
/// empty).
std::vector<Segment> contour(const GridField& field, double level,
                             const std::vector<std::string>& pieces = {});

/// Takes lines out of cells through which more of them lead than can be told apart: there the quantity does not grow
/// but jumps, and many white lines side by side look like nodes without value.
/// @param lines  pieces of the lines, by level
/// @param most  lines in a cell that can be told apart, at least 1
void drop_crowded(std::vector<std::vector<Segment>>& lines, const GridField& field,
                  std::size_t most);

/// The number of a contour line, in the middle of a piece of it.
struct LineNumber {
  std::pair<double, double> at{};  ///< in the units of the axes
  double level = 0;
};

/// At most one number for every level, as far from each other and from the frame as their lines allow;
/// lines too short or too near have none.
std::vector<LineNumber> numbers_of(const std::vector<std::vector<Segment>>& lines,
                                   const std::vector<double>& levels, const GridField& field);

struct MapPanel {
  FigureText title{};
  GridField field{};  ///< the quantity, in the units of the figure
  std::vector<Segment> contours{};
  std::vector<LineNumber> numbers{};  ///< of contour lines
  std::vector<Segment> edge{};        ///< of the workspace
  std::vector<Segment> activation{};  ///< where a spring switches
  std::vector<Segment> unstable{};    ///< where stability is lost
};

struct MapFigure {
  std::string name{};
  FigureText title{}, x_title{}, y_title{}, value_title{};
  double low = 0, high = 1;  ///< of the colours
  std::vector<double> levels{};
  std::vector<MapPanel> panels{};
  SheetLook look{};
  bool has_gaps = false;      ///< nodes without value
  bool has_infinite = false;  ///< values beyond all bounds
  int clipped = 0;            ///< finite values beyond the colours
};

/// What a map was asked for, before what every map has: the quantity that its figure shows.
std::string quantity_of(const analysis::MapSettings& map);

/// The figures that the case asks for; without any, and without any [[plot]], one per map of two
/// axes. What cannot be drawn is said in `problems`.
std::vector<MapFigure> map_figures_of(const Case& the_case,
                                      const std::vector<analysis::StudyResult>& results,
                                      std::vector<std::string>& problems);

/// The whole script of a figure. @param style, figure  the templates style.gp and map.gp
std::string map_script(const MapFigure& figure, const std::string& style,
                       const std::string& drawing);

}  // namespace springfold::io
