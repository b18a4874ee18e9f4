#include "springfold/continuation/diagram.hpp"

#include <utility>

#include "continuation/branches/tracer.hpp"
#include "continuation/points/normalised.hpp"
#include "springfold/continuation/entry_checks.hpp"
#include "springfold/continuation/interrupted.hpp"

namespace springfold::continuation {
namespace {

Diagram diagram_inside(ProblemView problem, const std::vector<DiagramStart>& starts,
                       const std::vector<Event>& events, const DiagramOptions& options,
                       const StepObserver& observer) {
  const Walker walker{problem, problem.metric(), options.trace};
  Tracer tracer(walker, events, options, observer);
  for (std::size_t i = 0; i < starts.size(); ++i) tracer.trace_from(starts[i], static_cast<int>(i));
  return tracer.take();
}

}  // namespace

Diagram trace_diagram(ProblemView problem, const std::vector<DiagramStart>& starts,
                      const std::vector<Event>& events, const DiagramOptions& options,
                      const StepObserver& observer) {
  if (starts.empty()) return {};
  check_diagram(options);
  check_events(events);
  try {
    for (const DiagramStart& start : starts)
      check_entry(problem, start.x, start.lambda, start.piece, options.trace);
    const Normalised own(problem, starts.front().x, starts.front().lambda, starts.front().piece);
    std::vector<DiagramStart> inside = starts;
    for (DiagramStart& start : inside) {
      CurvePoint at = own.inside(start.x, start.lambda);
      start = {std::move(at.x), at.lambda, start.piece};
    }
    return own.outside(
        diagram_inside(own, inside, own.inside(events), own.inside(options), own.inside(observer)));
  } catch (const Interrupted&) {  // before anything was traced
    return {};
  }
}

}  // namespace springfold::continuation
