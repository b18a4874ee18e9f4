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

/// What a bar comes to with its numbers.
struct Bar {
  model::Anchor from{}, to{};
  double length = 0;     ///< as drawn
  double free = 0;       ///< length without force
  double stiffness = 0;  ///< of one without a law [force/length]
};

Bar bar_of(const BarDraft& draft, const model::Mechanism& mechanism, const Numbers& numbers) {
  Bar bar{.from = anchor_of(draft.from, numbers), .to = anchor_of(draft.to, numbers)};
  bar.length = (drawn(mechanism, bar.to) - drawn(mechanism, bar.from)).norm();
  bar.free = draft.free ? numbers[*draft.free] : bar.length;
  if (draft.pretension) {
    const double tension = numbers[*draft.pretension];
    bar.free = draft.EA ? bar.length / (1 + tension / numbers[*draft.EA])
                        : bar.length - tension / numbers[*draft.stiffness];
  }
  if (draft.EA) bar.stiffness = numbers[*draft.EA] / bar.free;
  if (draft.stiffness) bar.stiffness = numbers[*draft.stiffness];
  return bar;
}

bool is_line(const BarDraft& draft) {
  return !draft.law && !draft.series && draft.acts == BarDraft::Acts::both_ways;
}

/// The bar's force as a law of its length.
model::SpringLaw law_of_length(const BarDraft& draft, const Bar& bar, const Numbers& numbers) {
  if (!draft.law)
    return model::OneSidedSpring{bar.stiffness, bar.free,
                                 draft.acts == BarDraft::Acts::in_tension
                                     ? model::OneSidedSpring::Side::above
                                     : model::OneSidedSpring::Side::below};
  return model::moved(law_of(*draft.law, numbers, bar.free), bar.free);
}

/// A pretension that the bar cannot have; empty: it can.
std::string pretension_problem(const BarDraft& draft, const Bar& bar, const Numbers& numbers) {
  const double tension = numbers[*draft.pretension];
  const std::string got = "pretension: got " + shortest(tension);
  if (draft.acts == BarDraft::Acts::in_tension && tension < 0)
    return got + ", need a number >= 0: the bar has tension_only = true";
  if (draft.acts == BarDraft::Acts::in_compression && tension > 0)
    return got + ", need a number <= 0: the bar has compression_only = true";
  if (bar.free >= 0 && std::isfinite(bar.free) && std::isfinite(bar.stiffness)) return "";
  return got + (draft.EA ? ", need a tension > -EA = " + shortest(-numbers[*draft.EA])
                         : ", need at most stiffness times length as drawn, " +
                               shortest(bar.stiffness * bar.length) +
                               ", and a stiffness > 0: the free length would be negative");
}

bool stands(const AnchorDraft& anchor) { return anchor.chain < 0 && anchor.body == 0; }

/// What is wrong with a bar whose numbers are each what they must be; empty when usable.
std::string problem_in(const BarDraft& draft, const model::Mechanism& mechanism,
                       const Numbers& numbers) {
  const Bar bar = bar_of(draft, mechanism, numbers);
  if (!is_line(draft) && stands(draft.from) && stands(draft.to))
    return "from, to: one of both must be able to move";
  if (draft.free)
    return draft.EA && bar.free == 0
               ? "free: got 0, need a number > 0: EA is stiffness times free length"
               : "";
  if (bar.length == 0)
    return "the ends of the bar lie on each other as drawn, need other ends, or free" +
           std::string{draft.law || draft.series ? "" : " with stiffness"};
  return draft.pretension ? pretension_problem(draft, bar, numbers) : "";
}

}  // namespace

void add_bars(const MechanismDraft& draft, const Numbers& numbers, model::Mechanism& mechanism) {
  for (const BarDraft& own : draft.bars) {
    const Bar bar = bar_of(own, mechanism, numbers);
    if (is_line(own)) {
      mechanism.line_springs.push_back({own.name, bar.from, bar.to, bar.stiffness, bar.free});
      continue;
    }
    model::ShapeSpring spring{.name = own.name};
    spring.shape.points = {bar.from, bar.to};
    if (own.series) {
      put_series(*own.series, numbers, bar.free, spring);
      spring.offset = bar.free;
    } else {
      spring.law = law_of_length(own, bar, numbers);
    }
    mechanism.shape_springs.push_back(std::move(spring));
  }
}

std::vector<const BarDraft*> bars_of(const MechanismDraft& draft, bool line) {
  std::vector<const BarDraft*> list;
  for (const BarDraft& bar : draft.bars)
    if (is_line(bar) == line) list.push_back(&bar);
  return list;
}

void check_bars(const MechanismDraft& draft, const Numbers& numbers,
                const model::Mechanism& mechanism, const std::string& when, Problems& problems) {
  for (const BarDraft& bar : draft.bars)
    if (const std::string problem = problem_in(bar, mechanism, numbers); !problem.empty())
      problems.add(bar.place, bar.key, problem, when);
}

std::map<std::string, drawing::Member> members_of(const MechanismDraft& draft) {
  using drawing::Member;
  std::map<std::string, Member> members;
  for (const BarDraft& bar : draft.bars)
    members[bar.name] = bar.acts == BarDraft::Acts::in_tension       ? Member::cable
                        : bar.acts == BarDraft::Acts::in_compression ? Member::strut
                                                                     : Member::bar;
  return members;
}

void list_nodes(const MechanismDraft& draft, Case& the_case) {
  for (const SupportDraft& node : draft.supports) the_case.nodes.push_back({node.name, false, {}});
  for (const BodyDraft& body : draft.bodies)
    if (body.is_node) the_case.nodes.push_back({body.name, true, body.fixed});
  for (const BarDraft& bar : draft.bars) the_case.bars.push_back(bar.name);
}

}  // namespace springfold::io
