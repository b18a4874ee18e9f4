#include "model_problem.hpp"

#include <string_view>
#include <utility>

#include "bar_draft.hpp"
#include "numbered_place.hpp"
#include "text.hpp"

namespace springfold::io {
namespace {

/// Anchors of bars that are springs of a shape are called by their keys.
/// @returns whether there is such a bar
bool add_bar_problem(std::string what, const std::vector<const BarDraft*>& bars, std::size_t i,
                     const std::string& when, Problems& problems) {
  if (i >= bars.size()) return false;
  for (const auto& [of, end] : {std::pair{"of[1]: ", "from: "}, {"of[2]: ", "to: "}})
    if (what.starts_with(of)) what.replace(0, std::string_view{of}.size(), end);
  problems.add(bars[i]->place, bars[i]->key, what, when);
  return true;
}

}  // namespace

void add_model_problem(const std::string& text, const MechanismDraft& draft,
                       const std::vector<double>& numbers, const StudyDraft& study, int run,
                       Problems& problems) {
  const std::string_view view{text};
  const std::string when = study.when(run);
  const auto body = numbered(view, "body");
  if (body && body->number <= draft.bodies.size()) {
    const BodyDraft& at = draft.bodies[body->number - 1];
    return problems.add(at.place, at.key, rest_of(view.substr(body->length)), when);
  }
  const auto load = numbered(view, "load");  // the mechanism's first, then the study's own
  if (load && load->number <= draft.loads.size() + study.loads.size()) {
    const bool own = load->number > draft.loads.size();
    const LoadDraft& at =
        own ? study.loads[load->number - 1 - draft.loads.size()] : draft.loads[load->number - 1];
    return problems.add(at.place, at.key, rest_of(view.substr(load->length)), when);
  }
  const auto spring = numbered(view, "spring");
  if (spring && spring->number <= draft.springs.size()) {
    const LineSpringDraft& at = draft.springs[spring->number - 1];
    return problems.add(at.place, at.key, rest_of(view.substr(spring->length)), when);
  }
  const auto add_bar = [&](bool line, std::size_t i, std::size_t length) {
    return add_bar_problem(rest_of(view.substr(length)), bars_of(draft, line), i, when, problems);
  };
  if (spring && add_bar(true, spring->number - 1 - draft.springs.size(), spring->length)) return;
  const auto shape = numbered(view, "shape");
  if (shape && shape->number <= draft.shape_springs.size()) {
    const ShapeSpringDraft& at = draft.shape_springs[shape->number - 1];
    return problems.add(at.place, at.key, rest_of(view.substr(shape->length)), when);
  }
  if (shape && add_bar(false, shape->number - 1 - draft.shape_springs.size(), shape->length))
    return;
  const auto chain = numbered(view, "chain");
  if (!chain || chain->number > draft.chains.size())
    return problems.add(study.place, study.key, text, when);
  const ChainDraft& at = draft.chains[chain->number - 1];
  const std::string_view behind = view.substr(chain->length);
  const auto element = numbered(behind, ".elements");
  const std::vector<std::size_t> origins = origins_of(at, numbers);
  if (!element || element->number > origins.size())
    return problems.add(at.place, at.key, rest_of(behind), when);
  const ElementDraft& part = at.elements[origins[element->number - 1]];
  problems.add(part.place, part.key, rest_of(behind.substr(element->length)), when);
}

}  // namespace springfold::io
