#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

#include "case_draft.hpp"
#include "hold_draft.hpp"

namespace springfold::io {
namespace {

/// Formulas to be evaluated again, in order, where one parameter has another value.
struct MovedFormulas {
  std::vector<Update> parameters{}, mechanism{}, study{};
};

/// All numbers of a case, of which most stay where one parameter has another value.
class CaseNumbers {
 public:
  CaseNumbers(std::shared_ptr<const CaseDraft> draft, std::size_t study, int run,
              const Values& parameters)
      : draft_{std::move(draft)}, study_{study}, run_{run}, parameters_{parameters} {
    mechanism_ = draft_->mechanism.numbers.values(draft_->book, parameters_).values;
    own_ = from().numbers.values(draft_->book, parameters_).values;
    all_usable_ =
        std::all_of(parameters_.usable.begin(), parameters_.usable.end(), [](bool u) { return u; });
  }

  analysis::Variant at(const std::vector<std::pair<std::size_t, double>>& values) const {
    std::vector<double> numbers = mechanism_, own = own_;
    std::vector<double> variables = parameters_.values;
    if (values.size() == 1 && all_usable_ && put(values.front(), variables, numbers, own))
      return built(numbers, own, std::move(variables));
    Redefinitions changes = from().changes(run_);
    for (const auto& [number, value] : values) changes[number] = Definition{.constant = value};
    Problems ignored;  // what has no value becomes NaN, and the curve ends there
    Values all = evaluate(draft_->parameters, changes, draft_->book, "", ignored);
    const auto mechanism = draft_->mechanism.numbers.values(draft_->book, all).values;
    own = from().numbers.values(draft_->book, all).values;
    return built(mechanism, own, std::move(all.values));
  }

 private:
  const StudyDraft& from() const { return draft_->studies[study_]; }

  const MovedFormulas& moved_by(std::size_t parameter) const {
    const std::scoped_lock lock{busy_};
    const auto known = moved_.find(parameter);
    if (known != moved_.end()) return known->second;
    MovedFormulas moved;
    moved.parameters =
        dependents_of(parameter, draft_->parameters, from().changes(run_), draft_->book);
    std::vector<bool> moves(parameters_.values.size(), false);
    moves[parameter] = true;
    for (const Update& update : moved.parameters) moves[update.target] = true;
    moved.mechanism = draft_->mechanism.numbers.updates_for(moves, draft_->book);
    moved.study = from().numbers.updates_for(moves, draft_->book);
    return moved_.emplace(parameter, std::move(moved)).first->second;
  }

  /// False where a parameter has no value: nothing that needs it has one then, whatever its formula gives.
  bool put(const std::pair<std::size_t, double>& value, std::vector<double>& variables,
           std::vector<double>& numbers, std::vector<double>& own) const {
    const MovedFormulas& moved = moved_by(value.first);
    variables[value.first] = value.second;
    if (!std::isfinite(value.second)) return false;
    for (const Update& update : moved.parameters) {
      variables[update.target] = draft_->book.value(update.formula, variables);
      if (!std::isfinite(variables[update.target])) return false;
    }
    for (const Update& update : moved.mechanism)
      numbers[update.target] = draft_->book.value(update.formula, variables);
    for (const Update& update : moved.study)
      own[update.target] = draft_->book.value(update.formula, variables);
    return true;
  }

  analysis::Variant built(const std::vector<double>& numbers, const std::vector<double>& own,
                          std::vector<double> parameters) const {
    const auto body = static_cast<std::size_t>(from().body - 1);
    analysis::Variant variant{
        build_mechanism(draft_->mechanism, numbers),
        build_study(from(), draft_->mechanism.bodies[body].task_space, own, draft_->parameters),
        std::move(parameters)};
    for (model::Load& load : build_loads(from().loads, own))
      variant.mechanism.loads.push_back(std::move(load));
    add_holds(from().history, variant.mechanism);
    return variant;
  }

  std::shared_ptr<const CaseDraft> draft_;
  std::size_t study_ = 0;
  int run_ = 0;
  Values parameters_;
  std::vector<double> mechanism_{}, own_{};
  bool all_usable_ = false;
  mutable std::mutex busy_{};
  mutable std::map<std::size_t, MovedFormulas> moved_{};
};

}  // namespace

std::shared_ptr<const analysis::CaseFamily> cases_of(std::shared_ptr<const CaseDraft> draft,
                                                     std::size_t study, int run,
                                                     const Values& parameters) {
  auto family = std::make_shared<analysis::CaseFamily>();
  for (const Parameter& parameter : draft->parameters) family->names.push_back(parameter.name);
  family->values = parameters.values;
  const auto cases = std::make_shared<const CaseNumbers>(std::move(draft), study, run, parameters);
  family->at = [cases](const std::vector<std::pair<std::size_t, double>>& values) {
    return cases->at(values);
  };
  return family;
}

}  // namespace springfold::io
