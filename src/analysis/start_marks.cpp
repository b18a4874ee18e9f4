#include "start_marks.hpp"

#include <algorithm>
#include <cmath>

namespace springfold::analysis {

void add_marks_at_start(const Study& study, const Evaluator& evaluator,
                        const std::vector<QuantityDefinition>& quantities,
                        const continuation::CurvePoint& start, BranchRows& rows) {
  constexpr double same = 1e-10;  // starts are solved to 1e-12
  Branch& branch = rows.branch;
  const std::size_t row = branch.start_row;
  for (const Mark& mark : study.marks) {
    const QuantityDefinition* q = find_quantity(quantities, mark.quantity);
    if (q == nullptr) continue;
    const auto column = static_cast<std::size_t>(q - quantities.data());
    const double value = branch.samples[row].values[column] / q->scale;
    const double wanted = mark.value / q->scale;
    if (!(std::abs(value - wanted) <= same * std::max(1.0, std::abs(wanted)))) continue;
    const bool known =
        std::any_of(branch.events.begin(), branch.events.end(), [&](const Event& event) {
          return event.kind == EventKind::user_value && event.detail == mark.quantity &&
                 std::abs(branch.samples[event.row].values.front()) <= same;
        });
    if (known) continue;
    Event event{.kind = EventKind::user_value, .detail = mark.quantity, .row = row};
    event.stiffness = evaluator.platform_stiffness(start);
    event.compliance = evaluator.rigid_compliance(start);
    event.rates_after = evaluator.rates(quantities, start);
    event.rates_before = event.rates_after;
    const auto behind = std::find_if(branch.events.begin(), branch.events.end(),
                                     [row](const Event& e) { return e.row > row; });
    rows.junctions.insert(rows.junctions.begin() + (behind - branch.events.begin()), -1);
    branch.events.insert(behind, std::move(event));
  }
}

}  // namespace springfold::analysis
