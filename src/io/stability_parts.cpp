#include "stability_parts.hpp"

#include <algorithm>
#include <cmath>

#include "result_access.hpp"

namespace springfold::io {

namespace {

using analysis::EventKind;

/// How far the index of a row can be believed.
enum class Trust { none, little, one_sided, full };

struct RowIndex {
  double index = 0;
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
    case EventKind::unresolved:
      return Trust::little;
  }
  return Trust::none;
}

std::vector<RowIndex> indices_of_rows(const analysis::StudyResult& result,
                                      const analysis::Branch& branch) {
  std::vector<RowIndex> rows(branch.samples.size());
  for (std::size_t row = 0; row < rows.size(); ++row)
    rows[row].index = value_at(result, branch, row, "index");
  const auto limit_trust = [&](std::size_t row, Trust trust) {
    if (row < rows.size()) rows[row].trust = std::min(rows[row].trust, trust);
  };
  for (const auto& event : branch.events) {
    limit_trust(event.row, trust_at(event.kind));
    if (has_two_sides(event)) limit_trust(event.row + 1, trust_at(event.kind));
  }
  for (auto& row : rows)
    if (std::isnan(row.index)) row.trust = Trust::none;
  return rows;
}

}  // namespace

std::vector<bool> stability_of_steps(const analysis::StudyResult& result,
                                     const analysis::Branch& branch) {
  const auto rows = indices_of_rows(result, branch);
  std::vector<bool> stable;
  for (std::size_t row = 0; row + 1 < rows.size(); ++row) {
    const RowIndex &a = rows[row], &b = rows[row + 1];
    if (a.trust == Trust::none && b.trust == Trust::none)
      stable.push_back(false);
    else if (a.trust != b.trust)
      stable.push_back((a.trust > b.trust ? a : b).index == 0);
    else
      stable.push_back(a.index == 0 && b.index == 0);
  }
  return stable;
}

bool is_finite(const PlotPoint& at) { return std::isfinite(at.first) && std::isfinite(at.second); }

std::pair<std::vector<Polyline>, std::vector<Polyline>> stability_parts(
    const std::vector<PlotPoint>& points, const std::vector<bool>& step_is_stable) {
  std::pair<std::vector<Polyline>, std::vector<Polyline>> parts;
  std::vector<Polyline>* open = nullptr;  // the kind of the line that the last step went on with
  for (std::size_t i = 0; i + 1 < points.size() && i < step_is_stable.size(); ++i) {
    const bool is_gap = !is_finite(points[i]) || !is_finite(points[i + 1]);
    if (is_gap) {
      open = nullptr;
      continue;
    }
    if (points[i] == points[i + 1]) continue;  // both sides of a switching spring
    auto& kind = step_is_stable[i] ? parts.first : parts.second;
    if (open != &kind) kind.push_back({points[i]});
    kind.back().push_back(points[i + 1]);
    open = &kind;
  }
  return parts;
}

}  // namespace springfold::io
