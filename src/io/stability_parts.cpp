#include "stability_parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "result_access.hpp"

namespace springfold::io {

namespace {

using analysis::EventKind;

/// How far the index of a row can be believed.
enum class Trust { none, little, one_sided, full };

struct RowIndex {
  double index = 0;                                                ///< under the study's control
  double index_force = 0;                                          ///< under dead load
  double index_driven = std::numeric_limits<double>::quiet_NaN();  ///< load control: if driven
  Trust trust = Trust::full;
};

Trust trust_at(EventKind kind) {
  switch (kind) {
    case EventKind::user_value:
    case EventKind::end_of_range:
      return Trust::full;
    case EventKind::switching:
    case EventKind::corner_limit_point:
    case EventKind::branching_kink:
      return Trust::one_sided;  // two rows, each with the index of its own side
    case EventKind::limit_point:
    case EventKind::branch_point:
    case EventKind::kinematic_singularity:
    case EventKind::touch:
    case EventKind::family:
    case EventKind::stability_change:
    case EventKind::unresolved:
    case EventKind::cusp:
    case EventKind::isola_centre:
    case EventKind::crossing:
    case EventKind::hilltop:
    case EventKind::branch_points_merge:
    case EventKind::more_modes:
    case EventKind::fold_meets_activation:
    case EventKind::corner_loses_reversal:
    case EventKind::touches_activation:
    case EventKind::two_activations:
    case EventKind::bends_other_way:
    case EventKind::parameter_turns:
    case EventKind::extremum:
    case EventKind::threshold:
    case EventKind::jump:
      return Trust::little;
  }
  return Trust::none;
}

std::vector<RowIndex> indices_of_rows(const analysis::StudyResult& result,
                                      const analysis::Branch& branch) {
  std::vector<RowIndex> rows(branch.samples.size());
  for (std::size_t row = 0; row < rows.size(); ++row) {
    rows[row].index = value_at(result, branch, row, "index");
    rows[row].index_force = value_at(result, branch, row, "index_force");
    rows[row].index_driven = value_at(result, branch, row, "index_driven");
  }
  const auto limit_trust = [&](std::size_t row, Trust trust) {
    if (row < rows.size()) rows[row].trust = std::min(rows[row].trust, trust);
  };
  for (const auto& event : branch.events) {
    limit_trust(event.row, trust_at(event.kind));
    if (has_two_rows(branch, event)) limit_trust(event.row + 1, trust_at(event.kind));
  }
  for (auto& row : rows)
    if (std::isnan(row.index)) row.trust = Trust::none;
  return rows;
}

Stability stability_of(const RowIndex& row) {
  if (row.index > 0 && row.index_driven == 0) return Stability::driven;
  if (std::isnan(row.index)) return Stability::unknown;
  if (row.index != 0) return Stability::unstable;
  return row.index_force > 0 ? Stability::driven : Stability::stable;
}

}  // namespace

std::vector<Stability> stability_of_steps(const analysis::StudyResult& result,
                                          const analysis::Branch& branch) {
  const auto rows = indices_of_rows(result, branch);
  std::vector<Stability> steps;
  for (std::size_t row = 0; row + 1 < rows.size(); ++row) {
    const RowIndex &a = rows[row], &b = rows[row + 1];
    // Where both say as much, the worse one counts.
    steps.push_back(a.trust > b.trust   ? stability_of(a)
                    : b.trust > a.trust ? stability_of(b)
                                        : std::max(stability_of(a), stability_of(b)));
  }
  return steps;
}

Passage passage_at(const std::vector<Stability>& steps, const analysis::Branch& branch,
                   const analysis::Event& event) {
  const std::size_t last = event.row + (has_two_rows(branch, event) ? 1 : 0);
  Passage passage;
  if (event.row > 0 && event.row <= steps.size()) passage.before = steps[event.row - 1];
  if (last < steps.size()) passage.behind = steps[last];
  if (event.row < branch.start_row) std::swap(passage.before, passage.behind);
  return passage;
}

bool stands(Stability stability, bool is_load) {
  return stability == Stability::stable || (!is_load && stability == Stability::driven);
}

bool loses_hold(EventKind kind, Stability from, Stability to, bool is_load) {
  const bool turns = kind == EventKind::limit_point || kind == EventKind::corner_limit_point;
  return turns && stands(from, is_load) && to != Stability::unknown && !stands(to, is_load);
}

bool is_finite(const PlotPoint& at) { return std::isfinite(at.first) && std::isfinite(at.second); }

std::vector<CurvePart> parts_of(const std::vector<PlotPoint>& points,
                                const std::vector<Stability>& steps) {
  std::vector<CurvePart> parts;
  bool goes_on = false;  // the last part ends at points[i]
  for (std::size_t i = 0; i + 1 < points.size() && i < steps.size(); ++i) {
    if (!is_finite(points[i]) || !is_finite(points[i + 1])) {
      goes_on = false;
      continue;
    }
    if (points[i] == points[i + 1]) continue;  // both sides of a switching spring
    if (!goes_on || parts.back().stability != steps[i]) parts.push_back({steps[i], {points[i]}});
    parts.back().line.push_back(points[i + 1]);
    goes_on = true;
  }
  return parts;
}

}  // namespace springfold::io
