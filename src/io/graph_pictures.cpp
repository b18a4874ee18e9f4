#include "graph_pictures.hpp"

#include <system_error>

#include "atomic_file.hpp"
#include "gnuplot_process.hpp"
#include "manifest.hpp"
#include "sha256.hpp"
#include "transition_access.hpp"
#include "work_folder.hpp"

namespace springfold::io {

namespace fs = std::filesystem;

void draw_graphs(const fs::path& folder, const std::vector<analysis::StudyResult>& results,
                 const PlotOptions& options, PlotOutcome& outcome) {
  const auto names = graph_names(results);
  const auto dot = find_executable("dot");
  for (std::size_t i = 0; i < results.size() && dot; ++i) {
    if (names[i].empty() || (options.stop_requested && options.stop_requested())) continue;
    make_folder(folder / "plots");
    const WorkFolder work{folder / "plots"};
    const std::string picture = names[i] + "-graph.svg";
    write_file(work.path() / "graph.gv", transitions_dot(results[i]));
    const auto failure = run_gnuplot({.executable = *dot,
                                      .folder = work.path(),
                                      .timeout_seconds = options.timeout_seconds,
                                      .stop_requested = options.stop_requested,
                                      .words = {"dot", "-Tsvg", "-ograph.svg", "graph.gv"}});
    std::error_code error;
    if (failure || !fs::is_regular_file(work.path() / "graph.svg", error)) {
      outcome.warnings.push_back("figure '" + picture + "': Graphviz drew nothing; graphs/" +
                                 names[i] + ".gv has the graph");
      continue;
    }
    const std::string bytes = read_file(work.path() / "graph.svg");
    list_in_manifest(folder, {{"plots/" + picture, sha256(bytes), bytes.size()}});
    publish_file(work.path() / "graph.svg", folder / "plots" / picture);
    outcome.files.push_back(folder / "plots" / picture);
  }
}

}  // namespace springfold::io
