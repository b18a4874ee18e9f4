#include <mutex>

#include "case_draft.hpp"

namespace springfold::io {

std::function<analysis::Situation(const std::vector<double>&)> situations_of(
    std::shared_ptr<const CaseDraft> draft, std::size_t study, int run) {
  std::vector<std::size_t> parameters;
  for (const MapAxisDraft& axis : draft->studies[study].commands.axes)
    if (axis.parameter) parameters.push_back(*axis.parameter);
  if (parameters.empty()) return {};
  // Formulas keep their variables: one evaluation at a time.
  const auto one_at_a_time = std::make_shared<std::mutex>();
  return [=](const std::vector<double>& values) {
    const std::lock_guard lock{*one_at_a_time};
    const StudyDraft& from = draft->studies[study];
    Redefinitions changes = from.changes(run);
    for (std::size_t k = 0; k < parameters.size(); ++k)
      changes[parameters[k]] = Definition{.constant = values[k]};
    Problems ignored;  // what has no value becomes NaN, and the node says so
    const Values all = evaluate(draft->parameters, changes, draft->book, "", ignored);
    const auto numbers = draft->mechanism.numbers.values(draft->book, all).values;
    const auto own = from.numbers.values(draft->book, all).values;
    return analysis::Situation{build_mechanism(draft->mechanism, numbers),
                               vector_of(from.load, own), vector_of(from.commands.pose, own)};
  };
}

}  // namespace springfold::io
