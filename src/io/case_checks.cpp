#include "case_draft.hpp"

namespace springfold::io {
namespace {

model::TaskSpace space_of(const CaseDraft& draft, const StudyDraft& study) {
  return draft.mechanism.bodies[static_cast<std::size_t>(study.body - 1)].task_space;
}

/// A number that is wrong already without a study is not reported again for each run.
void check_runs(const CaseDraft& draft, const StudyDraft& study, std::vector<bool> reported,
                Problems& problems) {
  std::vector<bool> reported_of_study;
  for (int run = 1; run <= study.runs(); ++run) {
    const std::string when = study.when(run);
    const Values parameters =
        evaluate(draft.parameters, study.changes(run), draft.book, when, problems);
    draft.mechanism.numbers.check(draft.mechanism.numbers.values(draft.book, parameters), when,
                                  problems, reported);
    const Values numbers = study.numbers.values(draft.book, parameters);
    study.numbers.check(numbers, when, problems, reported_of_study);
    const auto body = static_cast<std::size_t>(study.body);
    if (body <= draft.mechanism.bodies.size())
      check_direction(study, space_of(draft, study), numbers, when, problems);
    if (study.vary)
      for (const ExpectedDraft& column : study.vary->columns) {
        std::vector<bool> none;
        column.numbers.check(column.numbers.values(draft.book, parameters), when, problems, none);
      }
    for (const ExpectedDraft& value : draft.expected) {
      const bool compared = value.study && &draft.studies[*value.study] == &study;
      if (!compared || value.value.run != run) continue;
      std::vector<bool> none;
      value.numbers.check(value.numbers.values(draft.book, parameters), when, problems, none);
    }
  }
}

}  // namespace

void check_numbers(const CaseDraft& draft, Problems& problems) {
  const Values parameters = evaluate(draft.parameters, {}, draft.book, "", problems);
  std::vector<bool> reported;
  const NumberTable& numbers = draft.mechanism.numbers;
  numbers.check(numbers.values(draft.book, parameters), "", problems, reported);
  const auto check_all = [&](const auto& figures) {
    for (const auto& figure : figures) {
      std::vector<bool> none;
      figure.numbers.check(figure.numbers.values(draft.book, parameters), "", problems, none);
    }
  };
  check_all(draft.plots);
  check_all(draft.map_plots);
  check_all(draft.tornados);
  for (const StudyDraft& study : draft.studies) check_runs(draft, study, reported, problems);
}

}  // namespace springfold::io
