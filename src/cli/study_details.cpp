#include "study_details.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "springfold/io/shown_text.hpp"

namespace springfold::cli {
namespace {

std::string detail_line(const std::string& text) {
  return fmt::format("            {}\n", io::shown(text));
}

const model::Body& body_at(const model::Mechanism& mechanism, Index body) {
  return mechanism.bodies[static_cast<std::size_t>(body - 1)];
}

/// "a.x, a.y": the coordinates along which the chain that holds a point does not let it slide.
std::string held_text(const model::Mechanism& mechanism, const model::Chain& chain) {
  const model::Body& body = body_at(mechanism, chain.to);
  std::string text;
  for (Index i = 0; i < model::translations(body.task_space); ++i) {
    const std::string axis(1, "xyz"[i]);
    const bool slides = std::any_of(chain.elements.begin(), chain.elements.end(),
                                    [&axis](const model::Element& element) {
                                      const auto* joint = std::get_if<model::Joint>(&element);
                                      return joint != nullptr && joint->name == axis;
                                    });
    if (!slides) text += (text.empty() ? "" : ", ") + body.name + "." + axis;
  }
  return text;
}

}  // namespace

std::string study_details(const io::PlannedRun& planned) {
  const analysis::Study& study = planned.plan;
  std::string text;
  if (study.constant_load.size() > 0 && !study.constant_load.isZero(0)) {
    std::vector<double> load(study.constant_load.begin(), study.constant_load.end());
    text += detail_line(fmt::format("load: [{:.6g}] on {}, constant", fmt::join(load, ", "),
                                    body_at(planned.mechanism, study.body).name));
  }
  std::string held;
  for (const model::Chain& chain : planned.mechanism.chains)
    if (const auto& names = planned.history.held;
        std::find(names.begin(), names.end(), chain.name) != names.end())
      held += (held.empty() ? "" : ", ") + held_text(planned.mechanism, chain);
  return held.empty() ? text : text + detail_line("hold: " + held);
}

}  // namespace springfold::cli
