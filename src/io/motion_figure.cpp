#include "motion_figure.hpp"

#include "result_access.hpp"
#include "springfold/analysis/snap.hpp"
#include "text.hpp"

namespace springfold::io {

Figure motion_figure(const Case& the_case, const analysis::StudyResult& result) {
  Figure figure{.name = safe_file_name(result.study) + "-" + std::to_string(result.run) + "-energy",
                .tells_stability = false};
  if (!result.snap) return figure;
  const std::string unit = unit_label(analysis::Unit::energy, result.lambda_unit, the_case.units);
  figure.title.text = heading_of(result) + ": energy along the jumps";
  figure.x_title.text = "length of way (radians, sizes of the mechanism)";
  figure.y_title.text = "energy" + (unit.empty() ? "" : " [" + unit + "]");
  for (const analysis::Jump& jump : result.snap->jumps) {
    Polyline line;
    for (const analysis::SnapMoment& moment : jump.motion)
      line.emplace_back(moment.way, moment.state.energy);
    if (line.size() < 2) continue;
    figure.curves.push_back({.label = {jump.label},
                             .parts = {{Stability::stable, std::move(line)}},
                             .hue = static_cast<int>(figure.curves.size()) + 1});
  }
  return figure;
}

}  // namespace springfold::io
