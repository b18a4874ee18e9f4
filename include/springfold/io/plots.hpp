// Figures by gnuplot. Curves are safe on disk before this is called.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "springfold/analysis/result.hpp"
#include "springfold/io/case_file.hpp"

namespace springfold::io {

struct PlotOutcome {
  std::vector<std::filesystem::path> files{};  ///< pictures written (.png and .svg)
  std::vector<std::string> warnings{};         ///< one per figure that failed, with the reason
  std::vector<std::string> missing{};  ///< pictures wanted that are not there, "plots/a.png"
};

struct PlotOptions {
  std::string gnuplot = "gnuplot";         ///< executable, looked up in PATH unless it has a slash
  double timeout_seconds = 60;             ///< for one figure
  std::filesystem::path templates{};       ///< folder with style.gp and force-deflection.gp; empty:
                                           ///< the installed or the source tree's plots/
  std::function<bool()> stop_requested{};  ///< asked several times a second; true ends drawing
};

/// Draws every figure of the case in its formats. Never throws for a gnuplot that is missing, fails
/// or hangs: that becomes a warning. Where it is missing SVG files are drawn without it, more plainly.
PlotOutcome draw_plots(const std::filesystem::path& folder, const Case& the_case,
                       const std::vector<analysis::StudyResult>& results,
                       const PlotOptions& options = {});

/// Draws the figures of an earlier run again, from the scripts that its manifest lists: nothing is run, and
/// no table is read. Never throws, as draw_plots.
/// @param with_changed  also scripts that were changed since they were written. A script may run other
///                      programs: only its author's word says what it does
PlotOutcome redraw_plots(const std::filesystem::path& folder, bool with_changed,
                         const PlotOptions& options = {});

}  // namespace springfold::io
