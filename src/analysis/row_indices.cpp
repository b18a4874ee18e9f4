#include "row_indices.hpp"

#include <algorithm>
#include <cmath>

namespace springfold::analysis {
namespace {

/// Rows at which an eigenvalue passes zero, so that every count of a matrix there is one of rounding.
std::vector<bool> critical_rows(const Branch& branch) {
  std::vector<bool> critical(branch.samples.size(), false);
  for (const Event& event : branch.events)
    critical[event.row] = event.kind == EventKind::limit_point ||
                          event.kind == EventKind::branch_point || event.kind == EventKind::touch ||
                          event.kind == EventKind::kinematic_singularity;
  return critical;
}

}  // namespace

void fill_indices(Branch& branch, const std::vector<QuantityDefinition>& quantities) {
  const std::vector<bool> critical = critical_rows(branch);
  std::vector<bool> critical_driven = critical;
  for (const Event& event : branch.events)
    if (event.kind == EventKind::stability_change) critical_driven[event.row] = true;
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    const auto kind = quantities[q].kind;
    if (kind != QuantityDefinition::Kind::index && kind != QuantityDefinition::Kind::index_force &&
        kind != QuantityDefinition::Kind::index_pose &&
        kind != QuantityDefinition::Kind::index_driven)
      continue;
    const std::vector<bool>& at_zero =
        kind == QuantityDefinition::Kind::index_driven ? critical_driven : critical;
    for (std::size_t i = 0; i < branch.samples.size(); ++i) {
      double& value = branch.samples[i].values[q];
      const bool unknown = std::isnan(value) && !branch.samples[i].event.empty();
      if (!unknown && !at_zero[i]) continue;
      value = i > 0 ? branch.samples[i - 1].values[q] : std::nan("");
      for (std::size_t k = i + 1; k < branch.samples.size(); ++k) {
        const double next = branch.samples[k].values[q];
        if (std::isnan(next)) continue;
        value = std::isnan(value) ? next : std::min(value, next);
        break;
      }
    }
  }
}

}  // namespace springfold::analysis
