// Figures of relative sensitivities: one bar for every parameter, the largest at the top.
#pragma once

#include <string>
#include <vector>

#include "figure.hpp"
#include "springfold/analysis/result.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {

/// d(ln q)/d(ln p): by how many per cent q grows when p grows by one.
struct TornadoBar {
  std::string parameter{};
  double value = 0;
};

struct TornadoFigure {
  std::string name{};
  FigureText title{}, x_title{};
  std::vector<TornadoBar> bars{};  ///< sorted by size, the largest first; equal ones by name
  std::string left_out{};          ///< parameters without a bar, with the reason; empty: none
  SheetLook look{};
};

/// The figures that the case asks for. What cannot be drawn is said in `problems`.
std::vector<TornadoFigure> tornado_figures_of(const Case& the_case,
                                              const std::vector<analysis::StudyResult>& results,
                                              std::vector<std::string>& problems);

/// The whole script of a figure. @param style, drawing  the templates style.gp and tornado.gp
std::string tornado_script(const TornadoFigure& figure, const std::string& style,
                           const std::string& drawing);

}  // namespace springfold::io
