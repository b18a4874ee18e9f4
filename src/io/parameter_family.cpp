#include "case_draft.hpp"
#include "hold_draft.hpp"

namespace springfold::io {
namespace {

/// All that is needed to have the numbers of one run for another value of its parameter: the
/// values as they are, and the formulas to be evaluated again, in order.
struct Family {
  std::shared_ptr<const CaseDraft> draft{};
  std::size_t study = 0;
  std::size_t parameter = 0;
  std::vector<double> parameters{}, mechanism{}, load{};  ///< load: all numbers of the study
  std::vector<Update> parameter_updates{}, mechanism_updates{}, load_updates{};

  void update(const std::vector<Update>& updates, const std::vector<double>& variables,
              std::vector<double>& values) const {
    for (const auto& [target, formula] : updates)
      values[target] = draft->book.value(formula, variables);
  }

  analysis::Situation at(double value) const {
    std::vector<double> variables = parameters, numbers = mechanism, study_numbers = load;
    variables[parameter] = value;
    update(parameter_updates, variables, variables);
    update(mechanism_updates, variables, numbers);
    update(load_updates, variables, study_numbers);
    model::Mechanism built = build_mechanism(draft->mechanism, numbers);
    for (model::Load& own : build_loads(draft->studies[study].loads, study_numbers))
      built.loads.push_back(std::move(own));
    add_holds(draft->studies[study].history, built);
    return {std::move(built), vector_of(draft->studies[study].load, study_numbers)};
  }
};

}  // namespace

analysis::ParameterFamily family_of(std::shared_ptr<const CaseDraft> draft, std::size_t study,
                                    int run, const Values& parameters) {
  const StudyDraft& from = draft->studies[study];
  const FormulaBook& book = draft->book;
  Family family{.study = study, .parameter = *from.parameter, .parameters = parameters.values};
  family.mechanism = draft->mechanism.numbers.values(book, parameters).values;
  family.load = from.numbers.values(book, parameters).values;
  family.parameter_updates =
      dependents_of(family.parameter, draft->parameters, from.changes(run), book);
  std::vector<bool> moves(parameters.values.size(), false);
  moves[family.parameter] = true;
  for (const Update& update : family.parameter_updates) moves[update.target] = true;
  family.mechanism_updates = draft->mechanism.numbers.updates_for(moves, book);
  family.load_updates = from.numbers.updates_for(moves, book);
  const double value = parameters.values[family.parameter];
  family.draft = std::move(draft);
  return {[family = std::move(family)](double v) { return family.at(v); }, value};
}

}  // namespace springfold::io
