#include "study_draft.hpp"

#include <algorithm>

namespace springfold::io {

Redefinitions StudyDraft::changes(int run) const {
  Redefinitions changes = set;
  if (!vary) return changes;
  const std::vector<Definition>& values = vary->values[static_cast<std::size_t>(run - 1)];
  for (std::size_t k = 0; k < values.size(); ++k) changes[vary->parameters[k]] = values[k];
  return changes;
}

std::string StudyDraft::when(int run) const {
  const std::string study = " (study \"" + name + "\"";
  return vary ? study + ", run " + std::to_string(run) + ")" : study + ")";
}

void check_direction(const StudyDraft& draft, model::TaskSpace space, const Values& numbers,
                     const std::string& when, Problems& problems) {
  if (draft.control != analysis::ControlMode::mixed || draft.direction.empty() ||
      !draft.prescribed.empty())
    return;
  const auto lengths = static_cast<std::size_t>(model::translations(space));
  bool translates = false, rotates = false, varies = false;
  for (std::size_t i = 0; i < draft.direction.size(); ++i) {
    if (!numbers.usable[draft.direction[i]]) return;
    varies |= draft.numbers.definition(draft.direction[i]).formula.has_value();
    const bool moves = numbers.values[draft.direction[i]] != 0;
    (i < lengths ? translates : rotates) |= moves;
  }
  if (!translates || !rotates) return;
  problems.add(draft.numbers.definition(draft.direction[0]).place, draft.key + ".direction",
               "got a translation and a rotation together, need one of them alone in control = "
               "\"mixed\": the force-free complement of a mixture would depend on the unit of "
               "length",
               varies ? when : "");
}

namespace {

/// Default steps give way to those of the case: minimum <= initial <= maximum.
analysis::TraceSettings trace_of(const StudyDraft& draft, const std::vector<double>& numbers) {
  analysis::TraceSettings trace;
  const auto given = [&](const std::optional<NumberId>& id, double otherwise) {
    return id ? numbers[*id] : otherwise;
  };
  trace.initial_step = given(draft.initial_step, trace.initial_step);
  trace.minimum_step = given(draft.minimum_step, trace.minimum_step);
  trace.maximum_step = given(draft.maximum_step, trace.maximum_step);
  if (!draft.maximum_step)
    trace.maximum_step =
        std::max({trace.maximum_step, given(draft.initial_step, 0), given(draft.minimum_step, 0)});
  if (!draft.initial_step)
    trace.initial_step =
        std::max(std::min(trace.initial_step, trace.maximum_step), given(draft.minimum_step, 0));
  if (!draft.minimum_step) trace.minimum_step = std::min(trace.minimum_step, trace.initial_step);
  trace.maximum_points = static_cast<int>(numbers[draft.maximum_points]);
  trace.spacing = numbers[draft.spacing];
  trace.verify_arcs = draft.verify_arcs;
  return trace;
}

}  // namespace

analysis::Study build_study(const StudyDraft& draft, model::TaskSpace space,
                            const std::vector<double>& numbers,
                            const std::vector<Parameter>& parameters) {
  analysis::Study study{
      .name = draft.name, .kind = draft.kind, .control = draft.control, .body = draft.body};
  if (!draft.direction.empty())
    study.direction = normalised(vector_of(draft.direction, numbers), space);
  study.prescribed = draft.prescribed;
  study.constant_load = vector_of(draft.load, numbers);
  for (const RateDraft& rate : draft.actuators)
    study.actuators.push_back({rate.actuator, numbers[rate.rate]});
  if (draft.parameter) study.parameter = parameters[*draft.parameter].name;
  study.start.solve = draft.start_solve;
  study.start.solver = draft.start_solver;
  study.start.pose = vector_of(draft.start_pose, numbers);
  study.start.attempts = static_cast<int>(numbers[draft.attempts]);
  study.start.seed = static_cast<std::uint64_t>(numbers[draft.seed]);
  study.start.maximum_move = numbers[draft.maximum_move];
  for (const LimitDraft& limit : draft.until)
    study.until.push_back({limit.quantity.name, numbers[limit.low], numbers[limit.high]});
  for (const MarkDraft& mark : draft.marks)
    study.marks.push_back({mark.quantity.name, numbers[mark.value]});
  for (const NamedPlace& quantity : draft.extrema) study.extrema.push_back(quantity.name);
  study.path = draft.path;
  study.trace = trace_of(draft, numbers);
  study.branches = {.depth = static_cast<int>(numbers[draft.depth]),
                    .maximum = static_cast<int>(numbers[draft.maximum_branches]),
                    .search_at = {},
                    .starts = static_cast<int>(numbers[draft.search_starts]),
                    .seed = static_cast<std::uint64_t>(numbers[draft.search_seed])};
  for (const NumberId lambda : draft.search_at) study.branches.search_at.push_back(numbers[lambda]);
  study.search.starts = static_cast<int>(numbers[draft.equilibria_starts]);
  study.search.seed = static_cast<std::uint64_t>(numbers[draft.equilibria_seed]);
  study.search.maximum = static_cast<int>(numbers[draft.equilibria_maximum]);
  for (const LimitDraft& limit : draft.box)
    study.search.box.push_back({limit.quantity.name, numbers[limit.low], numbers[limit.high]});
  build_critical(draft.critical, numbers, study.critical);
  build_design(draft.design, numbers, study.design);
  study.snap = build_snap(draft.snap, numbers);
  build_commands(draft.commands, space, numbers, study);
  return study;
}

}  // namespace springfold::io
