#include "row_indices.hpp"

#include <algorithm>
#include <cmath>

#include "springfold/analysis/event_rows.hpp"

namespace springfold::analysis {
namespace {

/// Rows at which an eigenvalue passes zero, so that every count of a matrix there is one of rounding.
struct CriticalRows {
  std::vector<bool> here{};
  std::vector<bool> first_of_two{}, second_of_two{};  ///< rows of one place
};

/// Beside a spring that rests an eigenvalue of one of the pieces vanishes where half-branches leave.
bool is_critical(EventKind kind) {
  return kind == EventKind::limit_point || is_meeting_of_branches(kind);
}

CriticalRows critical_rows(const Branch& branch) {
  const std::vector<bool> none(branch.samples.size(), false);
  CriticalRows rows{none, none, none};
  for (const Event& event : branch.events) {
    if (!is_critical(event.kind)) continue;
    rows.here[event.row] = true;
    if (!has_two_rows(branch, event)) continue;
    rows.here[event.row + 1] = true;
    rows.first_of_two[event.row] = rows.second_of_two[event.row + 1] = true;
  }
  return rows;
}

/// The smaller of the counts before and behind a row.
double smaller_beside(const Branch& branch, const CriticalRows& rows, std::size_t row,
                      std::size_t quantity) {
  const std::size_t before = rows.second_of_two[row] ? row - 1 : row;
  double value = before > 0 ? branch.samples[before - 1].values[quantity] : std::nan("");
  for (std::size_t k = row + (rows.first_of_two[row] ? 2 : 1); k < branch.samples.size(); ++k) {
    const double next = branch.samples[k].values[quantity];
    if (std::isnan(next)) continue;
    return std::isnan(value) ? next : std::min(value, next);
  }
  return value;
}

}  // namespace

void fill_indices(Branch& branch, const std::vector<QuantityDefinition>& quantities) {
  const CriticalRows critical = critical_rows(branch);
  const bool has_driven = std::any_of(quantities.begin(), quantities.end(), [](const auto& q) {
    return q.kind == QuantityDefinition::Kind::index_driven;
  });
  // The count that a change of stability is about: that of the driven load if there is one, else that under dead load.
  std::vector<bool> changes = critical.here;
  for (const Event& event : branch.events)
    if (event.kind == EventKind::stability_change) changes[event.row] = true;
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    const auto kind = quantities[q].kind;
    if (kind != QuantityDefinition::Kind::index && kind != QuantityDefinition::Kind::index_force &&
        kind != QuantityDefinition::Kind::index_pose &&
        kind != QuantityDefinition::Kind::index_driven)
      continue;
    const auto of_changes =
        has_driven ? QuantityDefinition::Kind::index_driven : QuantityDefinition::Kind::index_force;
    const std::vector<bool>& at_zero = kind == of_changes ? changes : critical.here;
    for (std::size_t i = 0; i < branch.samples.size(); ++i) {
      double& value = branch.samples[i].values[q];
      const bool unknown = std::isnan(value) && !branch.samples[i].event.empty();
      if (unknown || at_zero[i]) value = smaller_beside(branch, critical, i, q);
    }
  }
}

}  // namespace springfold::analysis
