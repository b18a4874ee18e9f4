// Motions after a loss of stability, as a table.
#include <algorithm>

#include "jump_access.hpp"
#include "result_access.hpp"
#include "springfold/analysis/snap.hpp"
#include "text.hpp"

namespace springfold::io {
namespace {

using analysis::StudyResult;

bool has_jumps(const StudyResult& result) { return result.snap != nullptr; }

bool has_motions(const StudyResult& result) {
  return result.snap && std::any_of(result.snap->jumps.begin(), result.snap->jumps.end(),
                                    [](const auto& jump) { return !jump.motion.empty(); });
}

}  // namespace

std::string motions_csv(const std::vector<StudyResult>& results) {
  if (std::none_of(results.begin(), results.end(), has_motions)) return "";
  const std::vector<std::string> names = columns_where(results, has_jumps);
  std::string csv = "study,run,label,jump,time,way,potential";
  for (const auto& name : names) csv += "," + csv_text(name);
  csv += "\n";
  for (const StudyResult& result : results) {
    if (!has_motions(result)) continue;
    const std::string run = csv_text(result.study) + "," + std::to_string(result.run) + "," +
                            csv_text(result.label) + ",";
    std::vector<std::optional<std::size_t>> columns;
    for (const auto& name : names) columns.push_back(column_of(result, name));
    for (const analysis::Jump& jump : result.snap->jumps)
      for (const analysis::SnapMoment& moment : jump.motion) {
        csv += run + jump.label + "," + csv_number(moment.time) + "," + csv_number(moment.way) +
               "," + csv_number(moment.state.energy);
        for (const auto& column : columns)
          csv += "," + (column ? csv_number(moment.state.values[*column]) : std::string{});
        csv += "\n";
      }
  }
  return csv;
}

}  // namespace springfold::io
