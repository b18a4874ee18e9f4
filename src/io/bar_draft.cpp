#include "bar_draft.hpp"

#include <cmath>

#include "springfold/model/point.hpp"
#include "text.hpp"

namespace springfold::io {
namespace {

using Numbers = std::vector<double>;

/// Coordinates of the chain's joints as they are guessed, commands included.
void add_guesses(const model::Chain& chain, std::size_t joints, std::vector<double>& variables) {
  for (const model::Element& element : chain.elements) {
    const auto* joint = std::get_if<model::Joint>(&element);
    if (joint == nullptr) continue;
    if (joints-- == 0) return;
    const bool actuated = joint->role == model::JointRole::actuated;
    variables.push_back((actuated ? joint->command : 0) +
                        (has_coordinate(*joint) ? joint->initial : 0));
  }
}

model::Vec3<double> drawn(const model::Mechanism& mechanism, const model::Anchor& anchor) {
  const model::CompiledPoint point = compile(mechanism, anchor);
  const model::Chain* chain =
      anchor.chain >= 0 ? &mechanism.chains[static_cast<std::size_t>(anchor.chain)] : nullptr;
  const Index body = chain != nullptr ? chain->from : anchor.body;
  std::vector<double> variables;
  if (point.body_moves) {
    const Vector& pose = mechanism.bodies[static_cast<std::size_t>(body - 1)].pose;
    variables.assign(pose.begin(), pose.end());
  }
  if (chain != nullptr) add_guesses(*chain, point.joints.size(), variables);
  model::PointMotion<double> motion;
  model::evaluate_point<double>(
      point, Eigen::Map<const Vector>(variables.data(), static_cast<Index>(variables.size())),
      motion);
  return motion.pose.p;
}

double drawn_length(const model::Mechanism& mechanism, const model::LineSpring& bar) {
  return (drawn(mechanism, bar.to) - drawn(mechanism, bar.from)).norm();
}

double free_length(const BarDraft& draft, double length, const Numbers& numbers) {
  if (!draft.pretension) return length;
  const double tension = numbers[*draft.pretension];
  return draft.EA ? length / (1 + tension / numbers[*draft.EA])
                  : length - tension / numbers[*draft.stiffness];
}

/// What is wrong with a bar whose numbers are each what they must be; empty when usable.
std::string problem_in(const BarDraft& draft, const model::LineSpring& bar,
                       const model::Mechanism& mechanism, const Numbers& numbers) {
  if (draft.free)
    return draft.EA && bar.free == 0
               ? "free: got 0, need a number > 0: EA is stiffness times free length"
               : "";
  const double length = drawn_length(mechanism, bar);
  if (length == 0)
    return "the ends of the bar lie on each other as drawn, need other ends, or free with "
           "stiffness";
  if (!draft.pretension ||
      (bar.free >= 0 && std::isfinite(bar.free) && std::isfinite(bar.stiffness)))
    return "";
  const double T = numbers[*draft.pretension];
  return "pretension: got " + shortest(T) +
         (draft.EA ? ", need a tension > -EA = " + shortest(-numbers[*draft.EA])
                   : ", need at most stiffness times length as drawn, " +
                         shortest(numbers[*draft.stiffness] * length) +
                         ", and a stiffness > 0: the free length would be negative");
}

}  // namespace

model::LineSpring bar_of(const BarDraft& draft, const model::Anchor& from, const model::Anchor& to,
                         const model::Mechanism& mechanism, const Numbers& numbers) {
  model::LineSpring bar{.name = draft.name, .from = from, .to = to};
  bar.free =
      draft.free ? numbers[*draft.free] : free_length(draft, drawn_length(mechanism, bar), numbers);
  bar.stiffness = draft.EA ? numbers[*draft.EA] / bar.free : numbers[*draft.stiffness];
  return bar;
}

void check_bars(const MechanismDraft& draft, const Numbers& numbers,
                const model::Mechanism& mechanism, const std::string& when, Problems& problems) {
  for (std::size_t i = 0; i < draft.bars.size(); ++i) {
    const BarDraft& bar = draft.bars[i];
    const std::string problem =
        problem_in(bar, mechanism.line_springs[draft.springs.size() + i], mechanism, numbers);
    if (!problem.empty()) problems.add(bar.place, bar.key, problem, when);
  }
}

void list_nodes(const MechanismDraft& draft, Case& the_case) {
  for (const SupportDraft& node : draft.supports) the_case.nodes.push_back({node.name, false, {}});
  for (const BodyDraft& body : draft.bodies)
    if (body.is_node) the_case.nodes.push_back({body.name, true, body.fixed});
  for (const BarDraft& bar : draft.bars) the_case.bars.push_back(bar.name);
}

}  // namespace springfold::io
