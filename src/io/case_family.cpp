#include "case_draft.hpp"
#include "hold_draft.hpp"

namespace springfold::io {

std::shared_ptr<const analysis::CaseFamily> cases_of(std::shared_ptr<const CaseDraft> draft,
                                                     std::size_t study, int run,
                                                     const Values& parameters) {
  auto family = std::make_shared<analysis::CaseFamily>();
  for (const Parameter& parameter : draft->parameters) family->names.push_back(parameter.name);
  family->values = parameters.values;
  family->at = [draft = std::move(draft), study,
                run](const std::vector<std::pair<std::size_t, double>>& values) {
    const StudyDraft& from = draft->studies[study];
    Redefinitions changes = from.changes(run);
    for (const auto& [number, value] : values) changes[number] = Definition{.constant = value};
    Problems ignored;  // what has no value becomes NaN, and the curve ends there
    const Values all = evaluate(draft->parameters, changes, draft->book, "", ignored);
    const auto numbers = draft->mechanism.numbers.values(draft->book, all).values;
    const auto own = from.numbers.values(draft->book, all).values;
    const auto body = static_cast<std::size_t>(from.body - 1);
    analysis::Variant variant{
        build_mechanism(draft->mechanism, numbers),
        build_study(from, draft->mechanism.bodies[body].task_space, own, draft->parameters)};
    for (model::Load& load : build_loads(from.loads, own))
      variant.mechanism.loads.push_back(std::move(load));
    add_holds(from.history, variant.mechanism);
    return variant;
  };
  return family;
}

}  // namespace springfold::io
