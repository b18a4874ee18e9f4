#include "command_draft.hpp"

#include "mechanism_draft.hpp"

namespace springfold::io {
namespace {

using analysis::StudyKind;

analysis::FactorBounds bounds_of(const std::vector<NumberId>& ids,
                                 const std::vector<double>& numbers) {
  if (ids.empty()) return {};
  return {numbers[ids[0]], numbers[ids[1]]};
}

std::vector<Vector> vectors_of(const std::vector<std::vector<NumberId>>& lists,
                               const std::vector<double>& numbers) {
  std::vector<Vector> vectors;
  for (const auto& list : lists) vectors.push_back(vector_of(list, numbers));
  return vectors;
}

void build_path(const CommandDraft& draft, const std::vector<double>& numbers,
                analysis::ControlPath& path) {
  path.targets = vectors_of(draft.targets, numbers);
  path.loads = vectors_of(draft.loads, numbers);
  if (draft.line) {
    const Vector from = vector_of(draft.line->from, numbers),
                 to = vector_of(draft.line->to, numbers);
    const int count = static_cast<int>(numbers[draft.line->points]);
    for (int k = 0; k < count; ++k)
      path.targets.push_back(
          k == count - 1 ? to
                         : Vector(from + (to - from) * (static_cast<double>(k) / (count - 1))));
    if (path.loads.size() == 2 && count != 2) {
      const Vector first = path.loads[0], change = path.loads[1] - path.loads[0];
      path.loads.clear();
      for (int k = 0; k < count; ++k)
        path.loads.push_back(first + change * (static_cast<double>(k) / (count - 1)));
    }
  }
  if (!draft.circle) return;
  const CircleDraft& c = *draft.circle;
  path.circle = {.centre = vector_of(c.centre, numbers),
                 .radius = numbers[c.radius],
                 .first = c.first,
                 .second = c.second,
                 .from = numbers[c.from],
                 .to = numbers[c.to]};
  path.circle_points = static_cast<int>(numbers[c.points]);
}

void build_map(const CommandDraft& draft, model::TaskSpace space,
               const std::vector<double>& numbers, analysis::MapSettings& map) {
  for (const MapAxisDraft& axis : draft.axes)
    map.axes.push_back({.name = axis.name,
                        .pose = axis.pose,
                        .from = numbers[axis.from],
                        .to = numbers[axis.to],
                        .points = static_cast<int>(numbers[axis.points])});
  map.command = draft.command;
  map.pose = vector_of(draft.pose, numbers);
  for (const Vector& direction : vectors_of(draft.directions, numbers))
    map.directions.push_back(normalised(direction, space));
  if (draft.critical)
    map.critical = {normalised(vector_of(draft.critical->direction, numbers), space),
                    numbers[draft.critical->up_to]};
}

}  // namespace

Vector normalised(const Vector& v, model::TaskSpace space) {
  if (v.size() == 0) return v;
  const Index lengths = model::translations(space);
  const double head = v.head(lengths).stableNorm();
  return v / (head > 0 ? head : v.tail(v.size() - lengths).stableNorm());
}

void build_commands(const CommandDraft& draft, model::TaskSpace space,
                    const std::vector<double>& numbers, analysis::Study& study) {
  study.command = {draft.prescribed, draft.commands, draft.method};
  if (study.kind == StudyKind::control) build_path(draft, numbers, study.targets);
  if (study.kind == StudyKind::map) build_map(draft, space, numbers, study.map);
  if (study.kind == StudyKind::workspace)
    study.workspace = {.shape = draft.shape,
                       .centre = vector_of(draft.centre, numbers),
                       .velocity = bounds_of(draft.velocity, numbers),
                       .force = bounds_of(draft.force, numbers),
                       .up_to = draft.up_to ? numbers[*draft.up_to] : 0};
}

}  // namespace springfold::io
