// Graphs of stable states as pictures.
#pragma once

#include <filesystem>
#include <vector>

#include "springfold/analysis/result.hpp"
#include "springfold/io/plots.hpp"

namespace springfold::io {

/// Draws them by Graphviz into plots/, where it is installed: nobody misses them otherwise. What fails is
/// a warning of the outcome.
void draw_graphs(const std::filesystem::path& folder,
                 const std::vector<analysis::StudyResult>& results, const PlotOptions& options,
                 PlotOutcome& outcome);

}  // namespace springfold::io
