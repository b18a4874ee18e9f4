#include "morse.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "one_freedom.hpp"
#include "springfold/core/decompositions.hpp"

namespace springfold::analysis {
namespace {

using model::TaskSpace;

MorseCount does_not_apply(const std::string& why) { return {.why = why}; }

/// (-1)^index over the equilibria; nothing if one is degenerate.
std::optional<int> signed_count(const std::vector<CountedEquilibrium>& equilibria) {
  int sum = 0;
  for (const CountedEquilibrium& e : equilibria) {
    if (!e.index) return std::nullopt;
    sum += *e.index % 2 == 0 ? 1 : -1;
  }
  return sum;
}

const statics::CoordinateSpring* spring_of(const statics::System& system, Index coordinate) {
  for (const statics::CoordinateSpring& spring : system.springs)
    if (spring.coordinate == coordinate) return &spring;
  return nullptr;
}

/// Does a coupled spring act on the coordinate, and does it pull back in all its directions?
std::optional<bool> coupled_pull(const statics::System& system, Index coordinate) {
  for (const statics::CoordinateGroup& group : system.coupled)
    if (std::find(group.coordinates.begin(), group.coordinates.end(), coordinate) !=
        group.coordinates.end())
      return model::problem_in(group.stiffness, model::Definiteness::definite).empty();
  return std::nullopt;
}

bool pulls_back(const statics::CoordinateSpring& spring) {
  return model::holds_both_ways(spring.law);
}

/// One chain to one body: the configurations are all values of its coordinates.
MorseCount of_open_chain(const PathProblem& problem, const std::vector<CountedEquilibrium>& raw) {
  const statics::System& system = problem.system(0);
  const TaskSpace space = system.mechanism.bodies.front().task_space;
  const Vector W = problem.inputs(0).W;
  const bool has_moment = !W.tail(W.size() - translations(space)).isZero(0);
  bool turns_freely = false;
  for (Index i = 0; i < system.first_pose; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (system.is_wrench[k]) continue;
    const auto* spring = spring_of(system, i);
    const auto coupled = coupled_pull(system, i);
    if ((spring && pulls_back(*spring)) || coupled.value_or(false)) continue;
    const std::string& name = system.coordinate_names[k];
    if (spring || coupled || system.is_length[k])
      return does_not_apply(name +
                            " has no spring that holds it on both sides: the energy need "
                            "not grow without bound");
    if (has_moment)
      return does_not_apply("a moment turns " + name +
                            ", which has no spring: the energy has no "
                            "unique value");
    turns_freely = true;
  }
  const auto sum = signed_count(raw);
  if (!sum) return does_not_apply("an equilibrium is degenerate");
  return {.applies = true, .expected = turns_freely ? 0 : 1, .found = *sum};
}

/// A bar of the kind that the second rule knows: joints that turn freely about one foot, then one
/// spring along the line from the foot to the point.
struct Bar {
  model::Vec3<double> foot = model::Vec3<double>::Zero();
  Index coordinate = 0;
  double offset = 0;  ///< length = offset + sign * coordinate
  double sign = 1;
  const statics::CoordinateSpring* spring = nullptr;  ///< none: a line spring
  double stiffness = 0, free = 0;                     ///< of a line spring
  /// A line spring's is positive everywhere but at its foot.
  bool has_length(const Vector& z) const {
    return spring == nullptr || offset + sign * z[coordinate] > 1e-9;
  }
  /// Pull of the spring at this length.
  double pull(double at) const {
    if (spring == nullptr) return stiffness * (at - free);
    if (!spring->law.is_straight(0)) return sign * spring->law.torque(0, sign * (at - offset));
    return sign * spring->law.segments.front().torque +
           spring->law.segments.front().stiffness *
               (at - offset - sign * spring->law.segments.front().anchor);
  }
};

std::optional<Bar> bar_of(const statics::System& system, std::size_t number) {
  const model::CompiledChain& chain = system.chains[number];
  const statics::ChainSlice& slice = system.chain_slices[number];
  const auto turning = static_cast<std::size_t>(std::max<Index>(0, chain.joint_count() - 1));
  const std::size_t least = chain.space == TaskSpace::xy ? 1 : 2;
  if (chain.from_moves || slice.x_count != chain.joint_count() || turning < least ||
      turning > (least == 1 ? 1u : 3u) || chain.joints.back().revolute ||
      !chain.to_attachment.p.isZero(0))
    return std::nullopt;
  const auto& joints = chain.joints;
  for (std::size_t j = 0; j < turning; ++j)
    if (!joints[j].revolute || (j > 0 && !joints[j].before.p.isZero(0)) ||
        spring_of(system, slice.x + static_cast<Index>(j)))
      return std::nullopt;
  const auto& slide = joints.back();
  Bar bar;
  bar.foot = joints.front().before.p;
  bar.coordinate = slice.x + static_cast<Index>(turning);
  bar.spring = spring_of(system, bar.coordinate);
  // The point lies at before + (slide + last) of the sliding frame: all along the sliding axis.
  const model::Vec3<double> rest = slide.before.R.transpose() * slide.before.p + chain.last.p;
  bar.offset = rest.dot(slide.axis);
  const bool is_straight = (rest - bar.offset * slide.axis).norm() < 1e-12;
  if (!is_straight || !bar.spring || bar.spring->law.segments.size() != 1 ||
      !pulls_back(*bar.spring))
    return std::nullopt;
  return bar;
}

/// Force on a point at `p` of all bars but one, and of the load: minus the gradient of the energy.
model::Vec3<double> force_of_others(const std::vector<Bar>& bars, std::size_t without,
                                    const model::Vec3<double>& p, const Vector& W) {
  model::Vec3<double> force = model::Vec3<double>::Zero();
  force.head(W.size()) = W;
  for (std::size_t i = 0; i < bars.size(); ++i) {
    if (i == without) continue;
    const model::Vec3<double> line = p - bars[i].foot;
    force -= bars[i].pull(line.norm()) * line.normalized();
  }
  return force;
}

MorseCount of_bars(const PathProblem& problem, const std::vector<Bar>& bars,
                   const std::vector<CountedEquilibrium>& distinct) {
  const bool in_space = problem.system(0).mechanism.bodies.front().task_space == TaskSpace::xyz;
  const Vector W = problem.inputs(0).W;
  int expected = 1;
  for (std::size_t i = 0; i < bars.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k)
      if ((bars[i].foot - bars[k].foot).norm() < 1e-9)
        return does_not_apply("two bars have the same foot");
    const double pull = bars[i].pull(0);
    if (bars[i].spring == nullptr && pull == 0) continue;  // smooth at its foot too
    const double others = force_of_others(bars, i, bars[i].foot, W).norm();
    if (std::abs(std::abs(pull) - others) < 1e-9)
      return does_not_apply("the forces at a foot are balanced");
    if (others > std::abs(pull)) continue;  // no stationary point of the energy
    // A peak of the energy where the bar is pressed there, a pit where it pulls.
    expected -= in_space && pull < 0 ? -1 : 1;
  }
  std::vector<CountedEquilibrium> positive;
  std::copy_if(distinct.begin(), distinct.end(), std::back_inserter(positive),
               [&](const CountedEquilibrium& e) {
                 return !e.is_locked && std::all_of(bars.begin(), bars.end(), [&](const Bar& bar) {
                   return bar.has_length(e.z);
                 });
               });
  const auto sum = signed_count(positive);
  if (!sum) return does_not_apply("an equilibrium is degenerate");
  return {.applies = true, .expected = expected, .found = *sum};
}

/// A line spring between the base and the body's point.
std::optional<Bar> line_bar(const PathProblem& problem, const statics::PointSpring& spring) {
  const statics::System& system = problem.system(0);
  std::size_t foot = spring.from, end = spring.to;
  if (system.points[foot].body != 0) std::swap(foot, end);
  const statics::PointSlice &a = system.points[foot], &b = system.points[end];
  const Index d = system.body_slices.front().count;
  const bool fits = a.z.empty() && b.body == 1 && std::ssize(b.z) == d && spring.stiffness > 0;
  if (!fits) return std::nullopt;
  Bar bar;
  bar.foot = statics::position_of(system, foot, Vector::Zero(system.size), problem.inputs(0).rho);
  if (d == 2 && bar.foot[2] != 0) return std::nullopt;  // its length is never zero
  bar.stiffness = spring.stiffness;
  bar.free = spring.free;
  return bar;
}

/// A chain of passive slides that carries the point anywhere and holds it nowhere.
bool is_free_guide(const statics::System& system, std::size_t number) {
  const model::CompiledChain& chain = system.chains[number];
  const Index d = dimension(chain.space);
  if (chain.from_moves || chain.joint_count() != d || system.chain_slices[number].x_count != d)
    return false;
  Matrix axes(3, d);
  model::Mat3<double> R = model::Mat3<double>::Identity();
  for (Index j = 0; j < d; ++j) {
    const auto& joint = chain.joints[static_cast<std::size_t>(j)];
    if (joint.revolute || spring_of(system, system.chain_slices[number].x + j) ||
        coupled_pull(system, system.chain_slices[number].x + j))
      return false;
    R = R * joint.before.R;
    axes.col(j) = R * joint.axis;
  }
  return std::abs(Lu(axes.topRows(d)).determinant()) > 1e-9;
}

/// A point that bars and line springs hold, and nothing else; slides may guide it anywhere.
std::optional<std::vector<Bar>> holders_of(const PathProblem& problem) {
  const statics::System& system = problem.system(0);
  std::vector<Bar> bars;
  for (std::size_t i = 0; i < system.chains.size(); ++i) {
    if (const auto bar = bar_of(system, i))
      bars.push_back(*bar);
    else if (!is_free_guide(system, i))
      return std::nullopt;
  }
  for (const statics::PointSpring& spring : system.line_springs) {
    const auto bar = line_bar(problem, spring);
    if (!bar) return std::nullopt;
    bars.push_back(*bar);
  }
  return bars.empty() ? std::nullopt : std::optional{bars};
}

/// Joints that turn about one freedom, and springs between points: the energy is continuously differentiable and the
/// configurations are closed curves, on each of which minima and maxima alternate.
/// @returns nothing for other mechanisms
std::optional<MorseCount> of_one_freedom(const PathProblem& problem,
                                         const std::vector<CountedEquilibrium>& raw) {
  const statics::System& system = problem.system(0);
  const bool has_paths_only =
      std::all_of(system.shapes.begin(), system.shapes.end(), [](const statics::PointShape& shape) {
        return !shape.is_pressure() && shape.shape.kind == model::ShapeKind::path;
      });
  if (!has_one_bounded_freedom(system) || !has_paths_only || !system.springs.empty() ||
      !system.coupled.empty() || !system.loads.empty())
    return std::nullopt;
  const Vector W = problem.inputs(0).W;
  for (std::size_t b = 0; b < system.body_slices.size(); ++b) {
    const statics::BodySlice& body = system.body_slices[b];
    const Index forces = translations(system.mechanism.bodies[b].task_space);
    if (!W.segment(body.W + forces, body.count - forces).isZero(0)) return std::nullopt;
  }
  if (raw.empty()) return does_not_apply("no equilibrium shows what the configurations are");
  for (const CountedEquilibrium& e : raw)
    if (!is_closed_curve(problem, e.z))
      return does_not_apply("the configurations are no closed curves without singular points");
  const auto sum = signed_count(raw);
  if (!sum) return does_not_apply("an equilibrium is degenerate");
  return MorseCount{.applies = true, .expected = 0, .found = *sum};
}

/// Why springs of shapes are not counted: what they are called in the case.
std::string shapes_in_words(const statics::System& system) {
  const auto other = std::find_if(
      system.shapes.begin(), system.shapes.end(), [](const statics::PointShape& shape) {
        return shape.is_pressure() || shape.shape.kind != model::ShapeKind::path ||
               shape.points.size() != 2;
      });
  if (other != system.shapes.end()) return "springs of shapes and pressures are not counted";
  return "line springs are counted where their law is a straight line, and that of " +
         system.shapes.front().name + " is not";
}

}  // namespace

bool is_bar(const statics::System& system, std::size_t chain) {
  return bar_of(system, chain).has_value();
}

MorseCount morse_count(const PathProblem& problem, const std::vector<CountedEquilibrium>& raw,
                       const std::vector<CountedEquilibrium>& distinct) {
  const statics::System& system = problem.system(0);
  if (!problem.symmetric()) return does_not_apply("the load has no potential");
  if (const auto count = of_one_freedom(problem, raw)) return *count;
  if (!system.shapes.empty()) return does_not_apply(shapes_in_words(system));
  if (!system.loads.empty()) return does_not_apply("weights and loads at points are not counted");
  if (system.mechanism.bodies.size() != 1)
    return does_not_apply(
        "there are several bodies: the Euler characteristic of their "
        "configurations is not known here");
  const TaskSpace space = system.mechanism.bodies.front().task_space;
  const bool is_point = space == TaskSpace::xy || space == TaskSpace::xyz;
  if (!system.line_springs.empty()) {
    if (const auto bars = is_point ? holders_of(problem) : std::nullopt)
      return of_bars(problem, *bars, distinct);
    return does_not_apply(
        "line springs are counted only where they and bars hold a point and nothing else does");
  }
  if (system.chains.size() == 1) return of_open_chain(problem, raw);
  if (const auto bars = is_point ? holders_of(problem) : std::nullopt)
    return of_bars(problem, *bars, distinct);
  return does_not_apply(
      "the chains close: the Euler characteristic of their configurations is not "
      "known here");
}

}  // namespace springfold::analysis
